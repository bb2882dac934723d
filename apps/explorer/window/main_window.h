#pragma once

#include <QMainWindow>
#include <QSettings>
#include <functional>
#include <map>
#include <vector>

#include "base/icons.h"
#include "base/listeners.h"
#include "base/theme.h"
#include "session/session_controller.h"
#include "window/edit_history.h"
#include "window/views.h"

class QAction;
class QActionGroup;
class QToolButton;

namespace emca::explorer {

class ConnectPanel;
class FileMenu;
class Layouts;
class NotesPanel;
class PanelDock;
class SampleBox;
class ShortcutPanel;
class StateOverlay;
class StatusStrip;
class Toast;

/// The window: views in docks, menus, toolbar, status bar, keys, and the words for every state. It decides nothing about
/// data: that is SessionController, Dataset and Selection.
class MainWindow : public QMainWindow {
    Q_OBJECT
  public:
    /// All outlive the window. \param settings  layout, theme and addresses are read from and written to it
    MainWindow(client::Dataset& dataset, client::Selection& selection, SessionController& session, Theme& theme,
               QSettings& settings);
    ~MainWindow() override;

    Views& views() { return views_; }
    PanelDock* dock(const QString& name) const;
    const std::map<QString, PanelDock*>& docks() const { return docks_; }
    Toast& toast() { return *toast_; }
    FileMenu& files() { return *files_; }
    ConnectPanel& connectPanel() { return *connectPanel_; }
    Layouts& layouts() { return *layouts_; }
    NotesPanel& notes() { return *notes_; }
    ShortcutPanel& shortcuts() { return *shortcuts_; }
    /// Samples per pixel of the next render; a person's choice outlives the scene's.
    void setSamples(std::uint32_t samplesPerPixel);
    QAction* action(const QString& name) const;

    /// A dock that comes with a plugin: where a saved layout has it, else beside the first of `beside` that there is, else
    /// with the tools. It is in the menu View.
    PanelDock* addPanel(const QString& title, const QString& name, QWidget* widget, const QStringList& beside, bool shown);
    /// What plugins have to say to the window's states and layouts.
    struct PluginHooks {
        std::function<bool()> settled;                      ///< nothing is being loaded
        std::function<QVariantMap()> read;                  ///< their settings, for a layout
        std::function<void(const QVariantMap&)> write;
        std::function<bool()> working;                      ///< one of them waits for an answer
    };
    void setPluginHooks(PluginHooks hooks) { pluginHooks_ = std::move(hooks); }
    /// Brings a dock's tab to the front.
    void showDock(const QString& name);
    /// Nothing is under way and every view has drawn what it has.
    bool isSettled() const;
    /// A plugin waits for an answer or for work of its own; it may do so for as long as it likes.
    bool isPluginWorking() const { return pluginHooks_.working && pluginHooks_.working(); }

  public slots:
    void connectTo(const emca::client::Address& address, const QString& token = {});
    void render();
    void resetLayout();

  protected:
    void closeEvent(QCloseEvent* event) override;
    void dragEnterEvent(QDragEnterEvent* event) override;
    void dropEvent(QDropEvent* event) override;
    void showEvent(QShowEvent* event) override;

  private:
    // main_window.cpp
    PanelDock* addDock(const QString& title, const QString& name, QWidget* widget);
    void addDocks();
    void readSettings();
    void writeSettings();
    void updateDockTitles();
    // main_window_actions.cpp
    QAction* addAction(QMenu* menu, const QString& name, const QString& text, const QKeySequence& keys, std::function<void()> run);
    void addMenus();
    void addToolBar();
    void updateActions();
    void toggleLog();
    void focusSelection();
    void setTheme(ThemeKind kind);
    void setIcons();
    // main_window_states.cpp
    void connectSession();
    void showStates();
    void showBusy();
    void connectRegion();
    void showFailure(FailedTask task, const QString& sentence);

    client::Dataset& dataset_;
    client::Selection& selection_;
    SessionController& session_;
    Theme& theme_;
    QSettings& settings_;
    Views views_;
    std::map<QString, PanelDock*> docks_;
    std::map<QString, QAction*> actions_;
    std::vector<std::pair<QWidget*, StateOverlay*>> busy_;
    Toast* toast_ = nullptr;
    FileMenu* files_ = nullptr;
    ConnectPanel* connectPanel_ = nullptr;
    Layouts* layouts_ = nullptr;
    NotesPanel* notes_ = nullptr;
    ShortcutPanel* shortcuts_ = nullptr;
    StatusStrip* status_ = nullptr;
    SampleBox* samples_ = nullptr;
    QToolButton* connectButton_ = nullptr;
    QAction* panelsEnd_ = nullptr;     ///< in the menu View, after the docks
    PluginHooks pluginHooks_;
    std::vector<std::pair<QAction*, Icon>> icons_;
    bool arranged_ = false, samplesChosen_ = false, regionShown_ = false;
    EditHistory history_;
    DatasetListening datasetListening_;
    SelectionListening selectionListening_;
};

}  // namespace emca::explorer
