#include "plugin/plugin_host.h"

#include "base/state_overlay.h"

namespace emca::explorer {

PluginHost::PluginHost(PluginLibrary library, const HostContext::Surroundings& around, QObject* parent)
    : QObject(parent), library_(std::move(library)), around_(around), view_(new PluginView(around.theme, library_.title)),
      slot_(PluginGuard::instance().add(view_, library_.file, [this](const QString& what) { stop(tr("it threw \"%1\".").arg(what)); })) {
    // The window may go first.
    connect(view_, &QObject::destroyed, this, [this] {
        if (context_) context_->close();
        PluginGuard::instance().remove(slot_);
    });
}

PluginHost::~PluginHost() {
    end(0);
    if (view_ && !view_->parent()) delete view_;
}

void PluginHost::start() {
    if (isRunning() || !view_) return;
    if (slot_ == PluginGuard::kNobody) return stop(tr("there are too many plugins."));
    reason_.clear();
    view_->overlay().clear();
    context_ = std::make_unique<HostContext>(around_, library_.id, slot_, *view_);
    QWidget* content = nullptr;
    const bool made = PluginGuard::instance().run(slot_, [&] { content = library_.make(*context_); });
    if (!made) return;   // the guard has stopped it
    if (!content) return stop(tr("it made no widget."));
    PluginGuard::instance().run(slot_, [&] { view_->setContent(content); });
    emit changed();
}

void PluginHost::stop(const QString& reason) {
    if (!reason_.isEmpty()) return;
    reason_ = reason;
    if (context_) context_->close();
    // Later: its widget may be in the middle of an event, and is what is being painted.
    QMetaObject::invokeMethod(this, &PluginHost::retire, Qt::QueuedConnection);
}

void PluginHost::retire() {
    if (reason_.isEmpty()) return;   // started again meanwhile
    discard();
    if (view_) view_->showStopped(reason_, [this] { startAgain(); });
    emit changed();
}

void PluginHost::discard() {
    if (context_) retired_.push_back(std::shared_ptr<HostContext>(std::move(context_)));
    if (QWidget* content = view_ ? view_->takeContent() : nullptr) content->deleteLater();
}

void PluginHost::startAgain() {
    if (isRunning()) return;
    discard();
    reason_.clear();
    start();
}

bool PluginHost::end(int milliseconds) {
    if (context_) context_->close();
    if (view_) {
        if (QWidget* content = view_->takeContent()) PluginGuard::instance().run(slot_, [&] { delete content; });
    }
    PluginGuard::instance().remove(slot_);
    slot_ = PluginGuard::kNobody;
    bool ended = true;
    if (context_) retired_.push_back(std::move(context_));
    for (const auto& context : retired_) ended = context->waitForWork(milliseconds) && ended;
    return ended;
}

void PluginHost::settingsChanged() {
    if (context_) context_->settingsChanged();
}

}  // namespace emca::explorer
