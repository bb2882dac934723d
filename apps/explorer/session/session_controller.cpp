#include "session/session_controller.h"

#include <algorithm>
#include <cmath>

#include "base/qt_compat.h"
#include "emca/analysis/format.h"

namespace emca::explorer {
namespace {

/// While a person waits for a pixel, and during long work: tiles and progress then share their repaint.
constexpr int kTraceMilliseconds = 60, kRenderMilliseconds = 300;
constexpr int kRetryMilliseconds[] = {200, 400, 800, 1500, 3000, 5000};

}  // namespace

bool sameScene(const client::ServerInfo& a, const client::ServerInfo& b) {
    return a.renderer == b.renderer && a.scene == b.scene && a.width == b.width && a.height == b.height;
}

struct SessionController::Opened {
    std::shared_ptr<client::Connection> connection;
    client::ServerInfo info;
    std::optional<Camera> camera;   ///< a renderer may have none to show
};

SessionController::SessionController(client::Dataset& dataset, client::Selection& selection, QObject* parent)
    : QObject(parent), dataset_(dataset), selection_(selection), workers_(*this),
      datasetListening_(dataset, [this](std::uint32_t parts) {
          if ((parts & client::DatasetPart::currentImage) && !showing_) ensureTraced(true);
      }),
      selectionListening_(selection, [this](std::uint32_t parts) {
          if ((parts & (client::SelectionPart::pixel | client::SelectionPart::region)) && !showing_) ensureTraced(false);
      }) {
    qRegisterMetaType<FailedTask>();
    connect(&progress_, &QTimer::timeout, this, [this] {
        drainPreview();
        if (!render_ && !trace_ && !scene_ && !opening_ && !saving_) progress_.stop();
        else progress_.setInterval(trace_ ? kTraceMilliseconds : kRenderMilliseconds);
        // Each repaint of the status bar costs a frame of the whole window where GL is software.
        const double shown = std::round(renderFraction() * 100) + 1e3 * std::round(sceneFraction() * 20) + 1e6 * std::round(sessionFraction() * 20);
        if (shown == shownProgress_ && !trace_ && progress_.isActive()) return;
        shownProgress_ = shown;
        emit activityChanged();
    });
    retry_.setSingleShot(true);
    connect(&retry_, &QTimer::timeout, this, &SessionController::open);
}

SessionController::~SessionController() {
    if (opening_) *opening_->cancel = true;
    drop();   // a session that is being saved is saved: the workers are waited for
}

bool SessionController::isIdle() const {
    return !render_ && !trace_ && !scene_ && !layers_ && !opening_ && !saving_ && filesBeingRead_ == 0 && link_ != LinkState::connecting &&
           link_ != LinkState::reconnecting;
}

void SessionController::setLink(LinkState link) {
    if (link == link_) return;
    link_ = link;
    emit linkChanged();
}

void SessionController::fail(FailedTask task, const Error& error) { emit failed(task, toQString(error.message)); }

void SessionController::begin() {
    progress_.start(trace_ ? kTraceMilliseconds : kRenderMilliseconds);
    emit activityChanged();
}

// Connection -------------------------------------------------------------------------------------

void SessionController::connectTo(const client::Address& address, const QString& token) {
    drop();
    address_ = address;
    token_ = token;
    attempt_ = 0;
    setLink(LinkState::connecting);
    open();
}

void SessionController::disconnectFromRenderer() {
    drop();
    setLink(LinkState::offline);
}

void SessionController::retryNow() {
    if (link_ == LinkState::connected || link_ == LinkState::connecting) return;
    attempt_ = 0;
    setLink(link_ == LinkState::offline ? LinkState::connecting : LinkState::reconnecting);
    open();
}

/// Ends whatever is connected or under way. Closing may wait for a thread, so it happens elsewhere.
void SessionController::drop() {
    ++generation_;
    retry_.stop();
    for (auto* activity : {&render_, &trace_, &scene_, &layers_}) {
        if (*activity) *(*activity)->cancel = true;
        activity->reset();
    }
    tracing_ = {};
    if (const auto gone = std::move(connection_)) workers_.start([gone] { gone->close(); });
    connection_.reset();
    if (finished_) completeRender(std::nullopt);
    else if (preview_) abandonRender(Error{ErrorCode::cancelled, {}});
    emit activityChanged();
}

void SessionController::open() {
    retry_.stop();
    const std::uint64_t generation = ++generation_;
    client::Connection::Options options;
    options.token = token_.toStdString();
    options.lost = [this, generation](const Error& error) {
        QMetaObject::invokeMethod(this, [this, generation, error] { lost(generation, error); }, Qt::QueuedConnection);
    };
    workers_.run(
        [address = address_, options = std::move(options)]() -> Result<Opened> {
            auto connection = client::Connection::open(address, options);
            if (!connection) return connection.error();
            Opened opened{std::move(*connection), {}, std::nullopt};
            auto info = opened.connection->info();
            if (!info) return info.error();
            opened.info = std::move(*info);
            if (auto camera = opened.connection->camera()) opened.camera = std::move(*camera);
            return opened;
        },
        [this, generation](Result<Opened> result) { opened(generation, std::move(result)); });
}

void SessionController::opened(std::uint64_t generation, Result<Opened> result) {
    if (generation != generation_) {
        if (result) workers_.start([gone = result->connection] { gone->close(); });
        return;
    }
    if (!result) {
        if (link_ == LinkState::reconnecting) {
            scheduleRetry(toQString(result.error().message));
            return;
        }
        setLink(LinkState::offline);
        fail(FailedTask::connect, result.error());
        return;
    }
    adopt(std::move(*result));
}

void SessionController::adopt(Opened opened) {
    connection_ = opened.connection;
    attempt_ = 0;
    {
        const client::Dataset::Transaction together(dataset_);
        if (dataset_.info() && !sameScene(*dataset_.info(), opened.info)) {
            selection_.set({});
            known_.clear();
            dataset_.clearScene();
        }
        forgetRenderIds();
        dataset_.setInfo(opened.info);
        dataset_.setCamera(opened.camera);
    }
    setLink(LinkState::connected);
    const client::ImageEntry* image = dataset_.currentImage();
    const bool fits = image && image->image && image->image->color.width() == opened.info.width &&
                      image->image->color.height() == opened.info.height;
    if (renderOnConnect_ && !fits) {
        render(client::RenderOptions(renderOptions_));
        rendersUnasked_ = true;
    }
    loadScene();
    if (opened.info.surfaceRender != 0 && !render_) fetchLayers();
    ensureTraced(true);
}

/// The server keeps renders by number; another server knows none of ours, so their pixels are compared by value.
void SessionController::forgetRenderIds() {
    for (std::size_t i = 0; i < dataset_.images().size(); ++i) {
        client::ImageEntry entry = dataset_.images()[i];
        if (entry.renderId == 0) continue;
        entry.renderId = 0;
        dataset_.replaceImage(i, std::move(entry));
    }
}

void SessionController::lost(std::uint64_t generation, const Error& error) {
    if (generation != generation_ || link_ != LinkState::connected) return;
    const bool wasTracing = trace_ != nullptr;
    const QString sentence = toQString(error.message);
    drop();
    setLink(LinkState::reconnecting);
    emit failed(wasTracing ? FailedTask::trace : FailedTask::connect, sentence);
    scheduleRetry(sentence);
}

void SessionController::scheduleRetry(const QString&) {
    const auto last = static_cast<int>(std::size(kRetryMilliseconds)) - 1;
    retry_.start(kRetryMilliseconds[std::min(attempt_++, last)]);
    emit linkChanged();
}

// Scene ------------------------------------------------------------------------------------------

void SessionController::reloadScene() {
    if (connection_) loadScene();
}

void SessionController::loadScene() {
    if (scene_) *scene_->cancel = true;
    auto activity = std::make_shared<Activity>();
    scene_ = activity;
    begin();
    workers_.run(
        [connection = connection_, activity] { return connection->meshes(Activity::observer(activity)); },
        [this, activity](Result<std::vector<Mesh>> result) {
            if (activity != scene_) return;
            scene_.reset();
            if (result) dataset_.setMeshes(std::make_shared<const std::vector<Mesh>>(std::move(*result)));
            else if (result.error().code != ErrorCode::connectionLost) fail(FailedTask::scene, result.error());
            emit activityChanged();
        });
}

}  // namespace emca::explorer
