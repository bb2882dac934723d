#include "plugin/host_context.h"

#include <QMetaObject>
#include <QRunnable>
#include <QTimer>
#include <algorithm>
#include <exception>

#include "base/state_overlay.h"
#include "plots/plot_widget.h"
#include "plugin/plugin_view.h"

namespace emca::explorer {
namespace {

constexpr int kThreads = 4;   // of each plugin: one that never comes back takes none from others

std::shared_ptr<std::atomic<bool>> cancelOf(const std::shared_ptr<TaskState>& state) { return {state, &state->cancelled}; }

Error timedOut(const std::string& tool, std::chrono::milliseconds limit) {
    return {ErrorCode::timedOut, "The renderer's tool \"" + tool + "\" did not answer within " + std::to_string(limit.count()) +
                                     " ms; ask again, or for less."};
}

}  // namespace

HostContext::HostContext(const Surroundings& around, const QString& id, PluginGuard::Slot slot, PluginView& view)
    : around_(around), group_(QStringLiteral("plugins/%1/").arg(id)), owner_(id.toStdString()), slot_(slot), view_(view),
      mailbox_(new QObject, [](QObject* box) { box->deleteLater(); }), pool_(std::make_shared<QThreadPool>()) {
    pool_->setMaxThreadCount(kThreads);
    connect(&around_.theme, &Theme::themeChanged, this, [this] { tell(lookListeners_); });
    connect(&around_.theme, &Theme::toneMapChanged, this, [this] { tell(lookListeners_); });
}

HostContext::~HostContext() {
    close();
    if (!waitForWork(0)) new std::shared_ptr<QThreadPool>(pool_);   // never ends: neither do its threads
}

void HostContext::close() {
    if (!*open_) return;
    *open_ = false;
    for (const auto& weak : tasks_)
        if (const auto task = weak.lock()) task->cancelled = true;
    around_.services.removeObjects(owner_);
}

bool HostContext::isWorking() const {
    return std::any_of(tasks_.begin(), tasks_.end(), [](const std::weak_ptr<TaskState>& weak) {
        const auto task = weak.lock();
        return task && !task->ended && !task->cancelled;
    });
}

bool HostContext::waitForWork(int milliseconds) {
    pool_->clear();
    return pool_->waitForDone(milliseconds);
}

// Models -----------------------------------------------------------------------------------------

Subscription HostContext::onDataset(std::function<void(std::uint32_t)> changed) {
    const auto id = around_.dataset.listen([this, open = open_, changed = std::move(changed)](std::uint32_t parts) {
        if (*open) call([&] { changed(parts); });
    });
    return Subscription([&dataset = around_.dataset, id] { dataset.unlisten(id); });
}

Subscription HostContext::onSelection(std::function<void(std::uint32_t)> changed) {
    const auto id = around_.selection.listen([this, open = open_, changed = std::move(changed)](std::uint32_t parts) {
        if (*open) call([&] { changed(parts); });
    });
    return Subscription([&selection = around_.selection, id] { selection.unlisten(id); });
}

void HostContext::selectPixel(Pixel pixel) {
    change([&] { around_.selection.setPixel(pixel); });
}
void HostContext::selectPaths(std::vector<client::PathId> paths) {
    change([&] { around_.selection.setPaths(std::move(paths)); });
}
void HostContext::selectPath(const client::PathId& path) {
    change([&] { around_.selection.setCurrentPath(path); });
}
void HostContext::selectVertex(const client::VertexId& vertex) {
    change([&] { around_.selection.setVertex(vertex); });
}
void HostContext::clearVertex() {
    change([&] { around_.selection.clearVertex(); });
}
void HostContext::hover(std::optional<client::VertexId> vertex) {
    change([&] { around_.selection.setHovered(vertex); });
}

// 3D view ----------------------------------------------------------------------------------------

Result<void> HostContext::setObject(const std::string& id, SceneObject object) {
    Result<void> done;
    change([&] { done = around_.services.setObject(owner_, id, std::move(object)); });
    return done;
}
void HostContext::removeObject(const std::string& id) {
    change([&] { around_.services.removeObject(owner_, id); });
}
void HostContext::removeObjects() {
    change([&] { around_.services.removeObjects(owner_); });
}
Subscription HostContext::onPick(std::function<void(const std::string&, std::size_t)> picked) {
    return around_.services.onPick(owner_, [this, open = open_, picked = std::move(picked)](const std::string& id, std::size_t element) {
        if (*open) call([&] { picked(id, element); });
    });
}

// Renderer and work ------------------------------------------------------------------------------

bool HostContext::isConnected() const { return around_.services.connection() != nullptr; }

bool HostContext::hasTool(const std::string& tool) const {
    const auto& info = around_.dataset.info();
    return isConnected() && info && std::find(info->tools.begin(), info->tools.end(), tool) != info->tools.end();
}

template <typename Call>
void HostContext::post(const std::shared_ptr<QObject>& mailbox, Call callee) {
    // The event keeps the mailbox: whoever is last, it ends in the GUI thread.
    QMetaObject::invokeMethod(mailbox.get(), [mailbox, callee = std::move(callee)]() mutable { callee(); }, Qt::QueuedConnection);
}

std::shared_ptr<TaskState> HostContext::newTask() {
    std::erase_if(tasks_, [](const auto& task) { return task.expired(); });
    auto state = std::make_shared<TaskState>();
    tasks_.push_back(state);
    return state;
}

Task HostContext::ask(const std::string& tool, std::vector<std::byte> request, AskOptions options,
                      std::function<void(Result<Bytes>)> answered) {
    auto state = newTask();
    const auto finish = [this, open = open_, state, answered = std::move(answered)](Result<Bytes> reply) {
        if (!*open || state->ended || state->cancelled) return;
        state->ended = true;
        call([&] { answered(std::move(reply)); });
    };
    auto connection = around_.services.connection();
    const bool there = connection && hasTool(tool);
    if (!there || !*open_) {
        const std::string why = connection ? "The renderer has no tool \"" + tool + "\"; start one that has it (ServerTool)."
                                           : "No renderer is connected that could answer; connect to one.";
        post(mailbox_, [finish, why] { finish(Error{ErrorCode::notSupported, why}); });
        return Task(state);
    }
    QTimer::singleShot(options.timeout, mailbox_.get(), [finish, state, tool, limit = options.timeout] {
        finish(timedOut(tool, limit));
        state->cancelled = true;   // the server is told
    });
    client::RequestObserver observer;
    observer.cancel = cancelOf(state);
    if (options.progress)
        observer.progress = [this, open = open_, mailbox = mailbox_, state, progress = std::move(options.progress)](double fraction) {
            post(mailbox, [this, open, state, progress, fraction] {
                if (*open && !state->ended && !state->cancelled) call([&] { progress(fraction); });
            });
        };
    pool_->start(QRunnable::create([connection, tool, request = std::move(request), observer = std::move(observer), mailbox = mailbox_, finish] {
        auto reply = std::make_shared<Result<Bytes>>(connection->askTool(tool, request, observer));
        post(mailbox, [finish, reply] { finish(std::move(*reply)); });
    }));
    return Task(state);
}

Task HostContext::start(std::function<std::shared_ptr<void>(const TaskState&)> work,
                        std::function<void(const std::shared_ptr<void>&, const Error&)> done) {
    auto state = newTask();
    const auto finish = [this, open = open_, state, done = std::move(done)](const std::shared_ptr<void>& result, const Error& error) {
        if (!*open || state->ended || state->cancelled) return;
        state->ended = true;
        call([&] { done(result, error); });
    };
    if (!*open_) return Task(state);
    pool_->start(QRunnable::create([state, work = std::move(work), finish, mailbox = mailbox_] {
        if (state->cancelled) return;
        std::shared_ptr<void> result;
        Error error;
        try {
            result = work(*state);
        } catch (const std::exception& thrown) {
            error.message = std::string("The plugin's work failed: ") + thrown.what();
        } catch (...) {
            error.message = "The plugin's work failed with something that is no std::exception.";
        }
        post(mailbox, [finish, result, error] { finish(result, error); });
    }));
    return Task(state);
}

// Look and words ---------------------------------------------------------------------------------

Subscription HostContext::listen(std::map<int, std::function<void()>>& listeners, std::function<void()> changed) {
    const int id = nextListener_++;
    listeners[id] = std::move(changed);
    return Subscription([&listeners, id, weak = std::weak_ptr(open_)] {
        if (!weak.expired()) listeners.erase(id);
    });
}

void HostContext::tell(std::map<int, std::function<void()>>& listeners) {
    // A copy: listeners come and go while they are called.
    const auto round = listeners;
    for (const auto& [id, changed] : round)
        if (listeners.count(id)) call(changed);
}

Subscription HostContext::onLook(std::function<void()> changed) { return listen(lookListeners_, std::move(changed)); }
Subscription HostContext::onSettings(std::function<void()> changed) { return listen(settingListeners_, std::move(changed)); }
void HostContext::settingsChanged() { tell(settingListeners_); }

Plot& HostContext::makePlot(QWidget* parent) {
    auto* plot = new PlotWidget(around_.theme, parent);
    connect(plot, &PlotWidget::message, this, &HostContext::say);
    return *plot;
}

std::function<void()> HostContext::guarded(std::function<void()> callback) {
    if (!callback) return {};
    return [this, open = open_, callback = std::move(callback)] {
        if (*open) call(callback);
    };
}

void HostContext::showEmpty(const QString& title, const QString& sentence) {
    change([&] { view_.overlay().showEmpty(title, sentence); });
}
void HostContext::showError(const QString& sentence, const QString& action, std::function<void()> onAction) {
    change([&] { view_.overlay().showError(sentence, action, guarded(std::move(onAction))); });
}
void HostContext::showBusy(const QString& sentence, double fraction, std::function<void()> onCancel) {
    const QString button = onCancel ? tr("Cancel") : QString();
    change([&] { view_.overlay().showBusy(sentence, fraction, button, guarded(std::move(onCancel))); });
}
void HostContext::showContent() {
    change([&] { view_.overlay().clear(); });
}
void HostContext::say(const QString& sentence) {
    change([&] { around_.services.say(sentence); });
}
void HostContext::sayError(const QString& sentence) {
    change([&] { around_.services.sayError(sentence); });
}

QVariant HostContext::setting(const QString& key, const QVariant& otherwise) const { return around_.settings.value(group_ + key, otherwise); }
void HostContext::setSetting(const QString& key, const QVariant& value) {
    change([&] { around_.settings.setValue(group_ + key, value); });
}

}  // namespace emca::explorer
