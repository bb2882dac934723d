// Menus, toolbar and keys of MainWindow.
#include <QActionGroup>
#include <QApplication>
#include <QLabel>
#include <QMenuBar>
#include <QSignalBlocker>
#include <QToolBar>
#include <QToolButton>

#include "base/theme.h"
#include "image/image_view.h"
#include "image/region_panel.h"
#include "image/region_tool.h"
#include "parallel/parallel_plot.h"
#include "plots/path_plot.h"
#include "scene/scene_view.h"
#include "scene/surface_panel.h"
#include "window/connect_panel.h"
#include "window/file_menu.h"
#include "window/layouts.h"
#include "window/main_window.h"
#include "window/panel_dock.h"
#include "window/plot_links.h"
#include "window/sample_box.h"
#include "window/selection_steps.h"
#include "window/shortcut_panel.h"

namespace emca::explorer {

QAction* MainWindow::addAction(QMenu* menu, const QString& name, const QString& text, const QKeySequence& keys,
                               std::function<void()> run) {
    auto* made = new QAction(text, this);
    made->setObjectName(name);
    made->setShortcut(keys);
    made->setShortcutContext(Qt::WindowShortcut);
    made->setToolTip(keys.isEmpty() ? text : QStringLiteral("%1 (%2)").arg(text, keys.toString(QKeySequence::NativeText)));
    connect(made, &QAction::triggered, this, [run = std::move(run)] { run(); });
    menu->addAction(made);
    actions_[name] = made;
    return made;
}

void MainWindow::addMenus() {
    QMenu* file = menuBar()->addMenu(tr("&File"));
    for (QAction* made : files_->addTo(*file)) actions_[made->objectName()] = made;
    file->addSeparator();
    addAction(file, "quit", tr("Quit"), QKeySequence::Quit, [this] { close(); });

    QMenu* renderer = menuBar()->addMenu(tr("&Renderer"));
    addAction(renderer, "connect", tr("Connect…"), QKeySequence("Ctrl+K"), [this] { connectPanel_->openBelow(connectButton_); });
    addAction(renderer, "disconnect", tr("Disconnect"), {}, [this] { session_.disconnectFromRenderer(); });
    renderer->addSeparator();
    addAction(renderer, "render", tr("Render"), QKeySequence("Ctrl+R"), [this] { render(); });
    addAction(renderer, "cancel", tr("Cancel render"), QKeySequence("Ctrl+."), [this] { session_.cancelRender(); });
    QAction* automatic = addAction(renderer, "renderOnConnect", tr("Render when connected"), {}, [] {});
    automatic->setCheckable(true);
    connect(automatic, &QAction::toggled, this, [this](bool on) { session_.setRenderOnConnect(on); });
    renderer->addSeparator();
    addAction(renderer, "traceAgain", tr("Trace the pixel or region again"), QKeySequence("T"), [this] { session_.traceAgain(); });
    addAction(renderer, "reloadScene", tr("Reload the scene"), {}, [this] { session_.reloadScene(); });

    QMenu* selection = menuBar()->addMenu(tr("&Selection"));
    addAction(selection, "previousPath", tr("Previous path"), QKeySequence("["), [this] { stepPath(dataset_, selection_, -1); });
    addAction(selection, "nextPath", tr("Next path"), QKeySequence("]"), [this] { stepPath(dataset_, selection_, +1); });
    addAction(selection, "previousVertex", tr("Previous vertex"), QKeySequence(","), [this] { stepVertex(dataset_, selection_, -1); });
    addAction(selection, "nextVertex", tr("Next vertex"), QKeySequence("."), [this] { stepVertex(dataset_, selection_, +1); });
    selection->addSeparator();
    addAction(selection, "focus", tr("Focus on the selection"), QKeySequence("F"), [this] { focusSelection(); });
    QAction* rectangle = addAction(selection, "rectangle", tr("Select in a rectangle"), QKeySequence("R"), [this] {
        const bool on = action("rectangle")->isChecked();
        // Pixels of the image where it has the focus, else paths and vertices of the scene.
        if (on && views_.image->isAncestorOf(QApplication::focusWidget())) return views_.image->regionTool().setRectangleMode(true);
        views_.scene->setRectangleMode(on);
        if (!on) views_.image->regionTool().setRectangleMode(false);
    });
    rectangle->setCheckable(true);
    connect(views_.scene, &SceneView::rectangleModeChanged, rectangle, &QAction::setChecked);
    connect(&views_.image->regionTool(), &RegionTool::rectangleModeChanged, rectangle, &QAction::setChecked);
    addAction(selection, "clear", tr("Clear"), QKeySequence("Esc"), [this] {
        // One step back at a time: the mode, the vertex, the paths, the region.
        if (action("rectangle")->isChecked()) {
            views_.scene->setRectangleMode(false);
            views_.image->regionTool().setRectangleMode(false);
        } else if (selection_.state().vertex) {
            selection_.clearVertex();
        } else if (!selection_.state().paths.empty()) {
            selection_.clearPaths();
        } else if (!selection_.state().region.empty()) {
            selection_.setRegion({});
        }
    });
    addAction(selection, "undo", tr("Undo"), QKeySequence::Undo, [this] { history_.undo(); });
    addAction(selection, "redo", tr("Redo"), QKeySequence("Ctrl+Shift+Z"), [this] { history_.redo(); });

    QMenu* view = menuBar()->addMenu(tr("&View"));
    addAction(view, "log", tr("Logarithmic scale"), QKeySequence("L"), [this] { toggleLog(); });
    addAction(view, "exportPlot", tr("Export plot…"), QKeySequence("Ctrl+Shift+P"), [this] { exportPlot(views_); });
    QMenu* image = view->addMenu(tr("Image"));
    for (QAction* made : views_.image->actions()) {
        image->addAction(made);
        actions_[made->objectName()] = made;
    }
    view->addSeparator();
    for (const char* name : {"image", "scene", "paths", "vertex", "outliers", "filter", "region", "history", "surfaces", "sceneOptions", "notes"})
        if (PanelDock* made = dock(name)) view->addAction(made->toggleViewAction());
    for (const Views::Plot& plot : views_.plots) view->addAction(dock(plot.name)->toggleViewAction());
    view->addAction(dock("plots-parallel")->toggleViewAction());
    panelsEnd_ = view->addSeparator();
    QMenu* layout = view->addMenu(tr("Layout"));
    layouts_->addTo(*layout);
    for (QAction* made : layout->actions())
        if (!made->objectName().isEmpty()) actions_[made->objectName()] = made;
    addAction(view, "theme", tr("Light theme"), QKeySequence("Ctrl+T"), [this] { setTheme(theme_.isDark() ? ThemeKind::light : ThemeKind::dark); });

    QMenu* help = menuBar()->addMenu(tr("&Help"));
    addAction(help, "keys", tr("Keys and commands"), QKeySequence("F1"), [this] { shortcuts_->toggle(); });
}

void MainWindow::addToolBar() {
    QToolBar* bar = QMainWindow::addToolBar(tr("Renderer"));
    bar->setObjectName("toolBar");
    bar->setMovable(false);
    bar->setContextMenuPolicy(Qt::PreventContextMenu);
    connectButton_ = new QToolButton;
    connectButton_->setObjectName("connectButton");
    connectButton_->setText(tr("Connect…"));
    connectButton_->setToolTip(tr("Another renderer (Ctrl+K)"));
    connect(connectButton_, &QToolButton::clicked, this, [this] { connectPanel_->openBelow(connectButton_); });
    connectButton_->setToolButtonStyle(Qt::ToolButtonTextBesideIcon);
    bar->setToolButtonStyle(Qt::ToolButtonTextBesideIcon);
    bar->setIconSize(QSize(16, 16));
    bar->addWidget(connectButton_);
    bar->addSeparator();
    bar->addAction(action("render"));
    samples_->setFont(theme_.numberFont());
    samples_->setFixedWidth(104);
    samples_->setFocusPolicy(Qt::ClickFocus);
    bar->addWidget(samples_);
    bar->addAction(action("cancel"));
    bar->addSeparator();
    bar->addAction(action("open"));
    bar->addAction(action("saveSession"));
    bar->addSeparator();
    const auto stepper = [&](const QString& label, const char* previous, const char* next) {
        for (const char* name : {previous, next}) {
            bar->addAction(action(name));
            auto* button = qobject_cast<QToolButton*>(bar->widgetForAction(action(name)));
            button->setToolButtonStyle(Qt::ToolButtonIconOnly);
            button->setToolTip(QStringLiteral("%1 (%2)").arg(action(name)->text(), action(name)->shortcut().toString()));
            if (name == previous) bar->addWidget(new QLabel(label));
        }
    };
    stepper(tr("Path"), "previousPath", "nextPath");
    stepper(tr("Vertex"), "previousVertex", "nextVertex");
    bar->addAction(action("focus"));
    auto* space = new QWidget;
    space->setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Preferred);
    bar->addWidget(space);
    bar->addAction(action("theme"));
    connect(connectPanel_, &ConnectPanel::connectWanted, this, &MainWindow::connectTo);
    connect(samples_, qOverload<int>(&QSpinBox::valueChanged), this, [this] { samplesChosen_ = samples_->hasFocus() || samplesChosen_; });
    icons_ = {{action("render"), Icon::render}, {action("cancel"), Icon::cancel}, {action("open"), Icon::open},
              {action("saveSession"), Icon::save}, {action("previousPath"), Icon::previous}, {action("nextPath"), Icon::next},
              {action("previousVertex"), Icon::previous}, {action("nextVertex"), Icon::next}, {action("focus"), Icon::focus}};
    // A leading space keeps the words off their symbols.
    for (const char* name : {"render", "cancel", "open", "saveSession", "focus"})
        action(name)->setIconText(' ' + action(name)->text().remove(QStringLiteral("…")).section(' ', 0, 0));
    setIcons();
    connect(&theme_, &Theme::themeChanged, this, &MainWindow::setIcons);
}

void MainWindow::setIcons() {
    for (const auto& [owner, symbol] : icons_) owner->setIcon(icon(symbol, theme_));
    action("theme")->setIcon(icon(theme_.isDark() ? Icon::sun : Icon::moon, theme_));
    connectButton_->setIcon(icon(Icon::link, theme_));
}

void MainWindow::setSamples(std::uint32_t samplesPerPixel) {
    samplesChosen_ = true;
    samples_->setValue(static_cast<int>(samplesPerPixel));
}

void MainWindow::updateActions() {
    const bool connected = session_.link() == LinkState::connected, paths = !dataset_.paths().empty();
    action("disconnect")->setEnabled(session_.link() != LinkState::offline);
    action("render")->setEnabled(connected);
    views_.surfaces->setCanRender(connected);
    action("cancel")->setEnabled(session_.isRendering());
    action("traceAgain")->setEnabled(connected && (selection_.state().pixel || !selection_.state().region.empty()));
    action("reloadScene")->setEnabled(connected);
    files_->updateActions();
    for (const char* name : {"previousPath", "nextPath", "previousVertex", "nextVertex"}) action(name)->setEnabled(paths);
    action("undo")->setEnabled(history_.canUndo());
    action("redo")->setEnabled(history_.canRedo());
    connectButton_->setText(' ' + (connected ? tr("Connected") : tr("Connect…")));
}

void MainWindow::toggleLog() {
    // The view that has the focus knows best; the visible plots are what a person means otherwise.
    if (views_.image->isAncestorOf(QApplication::focusWidget())) {
        views_.image->toggleLog();
        return;
    }
    if (views_.region->isAncestorOf(QApplication::focusWidget())) {
        views_.region->setLog(!views_.region->isLog());
        return;
    }
    if (!views_.parallel->visibleRegion().isEmpty()) views_.parallel->toggleLog();
    for (const Views::Plot& plot : views_.plots)
        if (!plot.widget->visibleRegion().isEmpty()) plot.widget->setLog(!plot.widget->isLog());
}

void MainWindow::focusSelection() {
    if (views_.image->isAncestorOf(QApplication::focusWidget())) views_.image->focusSelection();
    else views_.scene->focusSelection();
}

void MainWindow::setTheme(ThemeKind kind) {
    theme_.setKind(kind);
    action("theme")->setText(theme_.isDark() ? tr("Light theme") : tr("Dark theme"));
}

}  // namespace emca::explorer
