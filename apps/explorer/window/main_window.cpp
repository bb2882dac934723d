#include "window/main_window.h"

#include <QAction>
#include <QCloseEvent>
#include <QDragEnterEvent>
#include <QMenu>
#include <QMenuBar>
#include <QMimeData>
#include <QScrollArea>
#include <QStatusBar>
#include <QTabBar>
#include <QTimer>
#include <QUrl>
#include <algorithm>

#include "base/qt_compat.h"
#include "base/state_overlay.h"
#include "base/theme.h"
#include "image/image_view.h"
#include "image/region_panel.h"
#include "parallel/parallel_plot.h"
#include "paths/filter_panel.h"
#include "paths/outlier_panel.h"
#include "paths/path_tree.h"
#include "paths/vertex_table.h"
#include "plots/path_plot.h"
#include "scene/scene_view.h"
#include "scene/surface_panel.h"
#include "window/connect_panel.h"
#include "window/file_menu.h"
#include "window/filter_settings.h"
#include "window/history_view.h"
#include "window/layout_plan.h"
#include "window/layouts.h"
#include "window/notes_panel.h"
#include "window/panel_dock.h"
#include "window/sample_box.h"
#include "window/shortcut_panel.h"
#include "window/status_strip.h"
#include "window/toast.h"
#include "window/view_options.h"

namespace emca::explorer {

MainWindow::MainWindow(client::Dataset& dataset, client::Selection& selection, SessionController& session, Theme& theme,
                       QSettings& settings)
    : dataset_(dataset), selection_(selection), session_(session), theme_(theme), settings_(settings),
      views_(Views::make(dataset, selection, theme)), history_(selection, *views_.filter),
      datasetListening_(dataset, [this](std::uint32_t parts) {
          if (parts & (client::DatasetPart::info | client::DatasetPart::images | client::DatasetPart::currentImage)) showStates();
          if (parts & (client::DatasetPart::info | client::DatasetPart::currentTrace)) status_->refresh();
          if ((parts & client::DatasetPart::info) && dataset_.info() && !samplesChosen_)
              samples_->setValue(static_cast<int>(dataset_.info()->samplesPerPixel));
          updateActions();
      }),
      selectionListening_(selection, [this](std::uint32_t parts) {
          if (parts & ~static_cast<std::uint32_t>(client::SelectionPart::hover)) updateActions();
      }) {
    setObjectName("mainWindow");
    setAcceptDrops(true);
    setDockOptions(AllowNestedDocks | AllowTabbedDocks | GroupedDragging);
    setTabPosition(Qt::AllDockWidgetAreas, QTabWidget::North);
    setDocumentMode(true);
    resize(1920, 1080);

    toast_ = new Toast(theme, this);
    files_ = new FileMenu(*this, dataset, session, theme, *toast_, settings);
    connectPanel_ = new ConnectPanel(theme, this);
    status_ = new StatusStrip(dataset, session, theme, this);
    samples_ = new SampleBox;
    statusBar()->setSizeGripEnabled(false);
    statusBar()->addWidget(status_, 1);
    addDocks();
    layouts_ = new Layouts(*this, settings, [this] {
        std::vector<PanelDock*> docks;
        for (const auto& [name, made] : docks_) docks.push_back(made);
        return docks;
    }, {[this] {
        QVariantMap options = viewOptions(views_);
        if (pluginHooks_.read) options["plugins"] = pluginHooks_.read();
        return options;
    }, [this](const QVariantMap& options) {
        setViewOptions(views_, options);
        if (pluginHooks_.write && options.contains("plugins")) pluginHooks_.write(options["plugins"].toMap());
    }}, this);
    connect(layouts_, &Layouts::arranged, this, &MainWindow::updateDockTitles);
    layouts_->apply("default");
    shortcuts_ = new ShortcutPanel(theme, this);
    addMenus();
    addToolBar();
    connectSession();
    readSettings();
    updateActions();
    showStates();
}

MainWindow::~MainWindow() = default;

PanelDock* MainWindow::dock(const QString& name) const {
    const auto found = docks_.find(name);
    return found == docks_.end() ? nullptr : found->second;
}

QAction* MainWindow::action(const QString& name) const {
    const auto found = actions_.find(name);
    return found == actions_.end() ? nullptr : found->second;
}

PanelDock* MainWindow::addDock(const QString& title, const QString& name, QWidget* widget) {
    auto* made = new PanelDock(title, name, widget, this);
    docks_[name] = made;
    connect(made, &QDockWidget::dockLocationChanged, this, &MainWindow::updateDockTitles);
    connect(made, &QDockWidget::topLevelChanged, this, &MainWindow::updateDockTitles);
    connect(made, &QDockWidget::visibilityChanged, this, &MainWindow::updateDockTitles);
    return made;
}

PanelDock* MainWindow::addPanel(const QString& title, const QString& name, QWidget* widget, const QStringList& beside, bool shown) {
    PanelDock* made = addDock(title, name, widget);
    made->setProperty("hiddenAtFirst", !shown);
    const auto menus = menuBar()->findChildren<QMenu*>(QString(), Qt::FindDirectChildrenOnly);
    for (QMenu* menu : menus)
        if (menu->actions().contains(panelsEnd_)) menu->insertAction(panelsEnd_, made->toggleViewAction());
    // Before the window is shown, its layout waits, and this dock with it.
    if (!arranged_ || restoreDockWidget(made)) return made;
    std::vector<PanelDock*> docks;
    for (const auto& [of, other] : docks_) docks.push_back(other);
    const auto there = std::find_if(beside.begin(), beside.end(), [this](const QString& other) { return dock(other) && dock(other)->isVisibleTo(this) && !dock(other)->isFloating(); });
    if (there != beside.end()) {
        tabifyDockWidget(dock(*there), made);
        dock(*there)->raise();
    } else {
        QWidget* front = nullptr;
        for (PanelDock* other : docks)
            if (other != made && !other->visibleRegion().isEmpty() && !tabifiedDockWidgets(other).isEmpty()) front = other;
        placeWithTools(*this, docks, *made);
        if (front) front->raise();
    }
    made->setVisible(shown);
    updateDockTitles();
    return made;
}

void MainWindow::addDocks() {
    addDock(tr("Image"), "image", views_.image);
    for (const Views::Plot& plot : views_.plots) addDock(plot.title, plot.name, plot.widget);
    addDock(tr("Parallel"), "plots-parallel", views_.parallel);
    addDock(tr("Scene"), "scene", views_.scene);
    addDock(tr("Paths"), "paths", views_.paths);
    addDock(tr("Intersection"), "vertex", views_.vertex);
    addDock(tr("Outliers"), "outliers", views_.outliers);
    addDock(tr("Filter"), "filter", views_.filter);
    addDock(tr("Region"), "region", views_.region);
    addDock(tr("History"), "history", views_.history);
    addDock(tr("Surfaces"), "surfaces", views_.surfaceScroll);
    addDock(tr("3D options"), "sceneOptions", views_.sceneOptions);
    addDock(tr("Notes"), "notes", notes_ = new NotesPanel(selection_, session_, theme_));
}

void MainWindow::resetLayout() { layouts_->apply("default"); }

void MainWindow::updateDockTitles() {
    // Docks report moves before the layout knows their new neighbours.
    QTimer::singleShot(0, this, [this] {
        for (const auto& [name, made] : docks_) made->updateTitle();
        // Many tools side by side: words of two letters say less than arrows that lead on.
        for (QTabBar* tabs : findChildren<QTabBar*>(QString(), Qt::FindDirectChildrenOnly)) {
            tabs->setElideMode(Qt::ElideNone);
            tabs->setUsesScrollButtons(true);
        }
    });
}

void MainWindow::showDock(const QString& name) {
    if (PanelDock* wanted = dock(name)) {
        wanted->show();
        wanted->raise();
    }
}

void MainWindow::showEvent(QShowEvent* event) {
    QMainWindow::showEvent(event);
    if (arranged_) return;
    arranged_ = true;
    // Sizes of docks hold only once the window has its own.
    if (!layouts_->restore()) layouts_->apply("default");
    updateDockTitles();
}

void MainWindow::readSettings() {
    setTheme(settings_.value("theme").toString() == "light" ? ThemeKind::light : ThemeKind::dark);
    connectPanel_->setHistory(settings_.value("connections").toStringList());
    if (const QByteArray geometry = settings_.value("window/geometry").toByteArray(); !geometry.isEmpty()) restoreGeometry(geometry);
    action("renderOnConnect")->setChecked(settings_.value("renderOnConnect", true).toBool());
    views_.filter->setState(readFilter(settings_));
    views_.parallel->setLayoutText(settings_.value("parallel/axes").toString());
    history_.clear();
}

void MainWindow::writeSettings() {
    settings_.setValue("theme", theme_.isDark() ? "dark" : "light");
    settings_.setValue("connections", connectPanel_->history());
    settings_.setValue("window/geometry", saveGeometry());
    layouts_->keep();
    writeFilter(settings_, views_.filter->state());
    settings_.setValue("parallel/axes", views_.parallel->layoutText());
    settings_.setValue("renderOnConnect", action("renderOnConnect")->isChecked());
}

void MainWindow::closeEvent(QCloseEvent* event) {
    writeSettings();
    if (files_->mayClose()) QMainWindow::closeEvent(event);
    else event->ignore();
}

void MainWindow::dragEnterEvent(QDragEnterEvent* event) {
    for (const QUrl& url : event->mimeData()->urls())
        if (url.isLocalFile()) return event->acceptProposedAction();
}

void MainWindow::dropEvent(QDropEvent* event) {
    QStringList files;
    for (const QUrl& url : event->mimeData()->urls())
        if (url.isLocalFile()) files << url.toLocalFile();
    files_->open(files);
    event->acceptProposedAction();
}

void MainWindow::connectTo(const client::Address& address, const QString& token) {
    connectPanel_->remember(address);
    toast_->clear();
    client::RenderOptions options;
    if (samplesChosen_) options.samplesPerPixel = static_cast<std::uint32_t>(samples_->value());
    options.layers = views_.surfaces->wantedLayers();
    session_.setRenderOptions(options);
    session_.connectTo(address, token);
}

void MainWindow::render() {
    client::RenderOptions options;
    options.samplesPerPixel = static_cast<std::uint32_t>(samples_->value());
    options.layers = views_.surfaces->wantedLayers();
    session_.render(options);
}

bool MainWindow::isSettled() const {
    return session_.isIdle() && views_.image->isSettled() && !views_.scene->isLoading() && !views_.scene->isMoving() &&
           views_.filter->isSettled() && views_.region->isSettled() && (!pluginHooks_.settled || pluginHooks_.settled());
}

}  // namespace emca::explorer
