#include "window/window_plugins.h"

#include "plugin/plugins_panel.h"
#include "scene/scene_objects.h"
#include "scene/scene_view.h"
#include "session/session_controller.h"
#include "window/main_window.h"
#include "window/panel_dock.h"
#include "window/toast.h"

namespace emca::explorer {
namespace {

QString dockName(const QString& id) { return QStringLiteral("plugin-") + id; }

/// Docks beside which a plugin appears at first; the first one that is there.
QStringList neighbours(PluginPlace place) {
    switch (place) {
        case PluginPlace::details: return {"vertex", "paths"};
        case PluginPlace::plots: return {"plots-depth", "plots-luminance", "plots-rgb"};
        case PluginPlace::tools: break;
    }
    return {};
}

}  // namespace

WindowPlugins::WindowPlugins(MainWindow& window, client::Dataset& dataset, client::Selection& selection, SessionController& session,
                             Theme& theme, QSettings& settings, PluginManager::Options options)
    : window_(&window), session_(session),
      manager_(std::make_unique<PluginManager>(HostContext::Surroundings{dataset, selection, theme, *this, settings}, std::move(options))) {
    auto* page = new PluginsPanel(*manager_, theme);
    window.addPanel(tr("Plugins"), "plugins", page, {}, false);
    connect(page, &PluginsPanel::showWanted, &window, [&window](const QString& id) { window.showDock(dockName(id)); });
    connect(manager_.get(), &PluginManager::loaded, this, [this](PluginHost* host) { addPanel(*host); });
    connect(manager_.get(), &PluginManager::problem, this, [this](const QString& sentence) {
        if (window_) window_->toast().showError(sentence, tr("Plugins"), [this] { window_->showDock("plugins"); });
    });
    window.setPluginHooks({[this] { return manager_->isSettled(); }, [this] { return manager_->savedSettings(); },
                           [this](const QVariantMap& saved) { manager_->restoreSettings(saved); },
                           [this] { return manager_->isWorking(); }});
}

WindowPlugins::~WindowPlugins() {
    if (window_) window_->setPluginHooks({});
}

void WindowPlugins::addPanel(PluginHost& host) {
    if (!window_ || !host.view()) return;
    const PluginLibrary& library = host.library();
    PanelDock* dock = window_->addPanel(library.title, dockName(library.id), host.view(), neighbours(library.place), true);
    dock->setToolTip(library.summary);
}

Result<void> WindowPlugins::setObject(const std::string& owner, const std::string& id, SceneObject object) {
    return window_->views().scene->objects().set({owner, id}, std::move(object));
}

void WindowPlugins::removeObject(const std::string& owner, const std::string& id) {
    if (window_) window_->views().scene->objects().remove({owner, id});
}

void WindowPlugins::removeObjects(const std::string& owner) {
    if (window_) window_->views().scene->objects().removeAll(owner);
}

Subscription WindowPlugins::onPick(const std::string& owner, std::function<void(const std::string&, std::size_t)> picked) {
    SceneObjects& objects = window_->views().scene->objects();
    const auto listener = objects.listenPicks([owner, picked = std::move(picked)](const ObjectId& id, std::size_t element) {
        if (id.owner == owner) picked(id.id, element);
    });
    return Subscription([this, listener] {
        if (window_) window_->views().scene->objects().unlisten(listener);
    });
}

std::shared_ptr<client::Connection> WindowPlugins::connection() { return session_.connection(); }

void WindowPlugins::say(const QString& sentence) {
    if (window_) window_->toast().showRemark(sentence);
}

void WindowPlugins::sayError(const QString& sentence) {
    if (window_) window_->toast().showError(sentence);
}

}  // namespace emca::explorer
