#pragma once

#include "plugin/plugin_manager.h"

namespace emca::explorer {

class MainWindow;
class SessionController;

/// Plugins in the main window: their docks and the page "Plugins", and what they may ask of the window.
class WindowPlugins : public QObject, public PluginServices {
    Q_OBJECT
  public:
    /// All outlive this object; the window may be gone when it ends.
    WindowPlugins(MainWindow& window, client::Dataset& dataset, client::Selection& selection, SessionController& session, Theme& theme,
                  QSettings& settings, PluginManager::Options options);
    ~WindowPlugins() override;

    PluginManager& manager() { return *manager_; }
    void start() { manager_->start(); }

    Result<void> setObject(const std::string& owner, const std::string& id, SceneObject object) override;
    void removeObject(const std::string& owner, const std::string& id) override;
    void removeObjects(const std::string& owner) override;
    Subscription onPick(const std::string& owner, std::function<void(const std::string&, std::size_t)> picked) override;
    std::shared_ptr<client::Connection> connection() override;
    void say(const QString& sentence) override;
    void sayError(const QString& sentence) override;

  private:
    void addPanel(PluginHost& host);
    QPointer<MainWindow> window_;
    SessionController& session_;
    std::unique_ptr<PluginManager> manager_;
};

}  // namespace emca::explorer
