#pragma once

#include <QWidget>

class QVBoxLayout;

namespace emca::explorer {

class PluginManager;
class Theme;
struct PluginRecord;

/// The page "Plugins": every plugin that was found, whether it runs, why not, a switch for each, and a way to add one.
class PluginsPanel : public QWidget {
    Q_OBJECT
  public:
    PluginsPanel(PluginManager& plugins, Theme& theme, QWidget* parent = nullptr);

  signals:
    /// Bring this plugin's dock to the front. \param id  of the plugin
    void showWanted(const QString& id);

  private:
    void reload();
    QWidget* card(const PluginRecord& record);
    void askForFile();

    PluginManager& plugins_;
    Theme& theme_;
    QWidget* list_;
    QVBoxLayout* cards_;
    bool reloading_ = false;
};

}  // namespace emca::explorer
