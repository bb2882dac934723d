// What MainWindow says while there is nothing to show, while something runs, and when something failed.
#include "base/qt_compat.h"
#include "base/state_overlay.h"
#include "emca/analysis/format.h"
#include "image/image_files.h"
#include "image/image_view.h"
#include "image/image_model.h"
#include "image/region_panel.h"
#include "image/region_tool.h"
#include "paths/filter_panel.h"
#include "paths/outlier_panel.h"
#include "parallel/parallel_plot.h"
#include "paths/path_tree.h"
#include "paths/vertex_table.h"
#include "plots/path_plot.h"
#include "scene/scene_view.h"
#include "scene/surface_panel.h"
#include "window/connect_panel.h"
#include "window/file_menu.h"
#include "window/history_view.h"
#include "window/main_window.h"
#include "window/plot_links.h"
#include "window/saved_view.h"
#include "window/status_strip.h"
#include "window/toast.h"

#include <QToolButton>

namespace emca::explorer {
namespace {
constexpr double kBusyAfterSeconds = 0.4;  // quicker replies replace the views without a flicker
}

void MainWindow::connectSession() {
    connect(&session_, &SessionController::linkChanged, this, [this] {
        if (session_.link() == LinkState::connected) toast_->clear();
        showStates();
        updateActions();
    });
    connect(&session_, &SessionController::activityChanged, this, [this] {
        showBusy();
        if (!dataset_.currentImage()) showStates();   // a session is being opened, or is no longer
        if (session_.isLoadingScene()) views_.scene->showLoading(session_.sceneFraction());
        else views_.scene->endLoading();
        updateActions();
    });
    connect(&session_, &SessionController::failed, this, &MainWindow::showFailure);
    connect(views_.filter, &FilterPanel::edited, this, [this] { session_.setFilter(views_.filter->state()); });
    const auto filterBy = [this](const query::Rule& rule) {
        showDock("filter");
        views_.filter->addRule(rule);
    };
    const auto showOnly = [this](const client::PathId& path) {
        selection_.setPaths({path});
        views_.paths->inspectSelected();
        SceneOptions options = views_.scene->options();
        options.paths = PathChoice::selected;
        views_.scene->setOptions(options);
    };
    connect(views_.paths, &PathTree::filterWanted, this, filterBy);
    connect(views_.vertex, &VertexTable::filterWanted, this, filterBy);
    connect(views_.outliers, &OutlierPanel::filterWanted, this, filterBy);
    connect(views_.outliers, &OutlierPanel::showOnlyWanted, this, showOnly);
    for (const Views::Plot& plot : views_.plots) {
        connect(plot.widget, &PathPlot::filterWanted, this, filterBy);
        connect(plot.widget, &PathPlot::showOnlyWanted, this, showOnly);
    }
    connect(&history_, &EditHistory::changed, this, &MainWindow::updateActions);
    session_.setViewSource([this] { return savedView(views_, dataset_); });
    connect(&session_, &SessionController::sessionOpened, this, [this] {
        if (session_.view()) explorer::show(*session_.view(), views_, dataset_);
        if (session_.filter()) views_.filter->setState(*session_.filter());
        history_.clear();
        updateActions();
        status_->refresh();
    });
    connect(views_.history, &HistoryView::traceChosen, &session_, &SessionController::showTrace);
    connect(views_.history, &HistoryView::traceAgainWanted, &session_, &SessionController::traceAgain);
    connect(views_.image, &ImageView::traceAgainWanted, &session_, &SessionController::traceAgain);
    connect(views_.image, &ImageView::openWanted, this, [this](const QStringList& files) { files_->open(files); });
    connect(views_.image, &ImageView::openReferenceWanted, &session_, &SessionController::openReference);
    connect(&session_, &SessionController::referenceOpened, views_.image, [this](const std::shared_ptr<const RenderedImage>& reference) {
        views_.image->model().setReference(reference);
    });
    connect(&views_.image->files(), &ImageFiles::saved, this, [this](const QString& file) { toast_->showRemark(tr("Saved %1").arg(file)); });
    connect(&views_.image->files(), &ImageFiles::failed, this, [this](const QString& sentence) {
        toast_->showError(sentence, tr("Save elsewhere…"), [this] { views_.image->saveShown(); });
    });
    connect(views_.scene, &SceneView::reloadRequested, &session_, &SessionController::reloadScene);
    connect(views_.scene, &SceneView::connectRequested, this, [this] { connectPanel_->openBelow(connectButton_); });
    connect(views_.surfaces, &SurfacePanel::renderWanted, this, &MainWindow::render);
    connectRegion();
    linkPlots(*this, views_, *toast_);
    std::vector<QWidget*> pathViews{views_.paths, views_.scene, views_.parallel};
    for (const Views::Plot& plot : views_.plots) pathViews.push_back(plot.widget);
    for (QWidget* view : pathViews) busy_.push_back({view, new StateOverlay(theme_, view)});
}

void MainWindow::connectRegion() {
    const auto askFilter = [this] {
        const FilterModel& model = views_.filter->model();
        const bool asks = model.state() == FilterModel::State::done || model.state() == FilterModel::State::running;
        views_.region->setFilter(asks ? toQString(model.query()).trimmed() : QString());
    };
    connect(views_.filter, &FilterPanel::edited, this, askFilter);
    askFilter();
    connect(views_.region, &RegionPanel::queryWanted, this, [this](const QString& query) { session_.setRegionQuery(query.toStdString()); });
    connect(views_.region, &RegionPanel::traceWanted, &session_, &SessionController::traceAgain);
    const auto tellTracing = [this] {
        views_.region->setTracing({session_.link() == LinkState::connected, session_.isTracing(), session_.heldBack()});
    };
    connect(&session_, &SessionController::activityChanged, this, tellTracing);
    connect(&session_, &SessionController::linkChanged, this, tellTracing);
    connect(&views_.image->model(), &ImageModel::displayChanged, this, [this] {
        const ImageModel& image = views_.image->model();
        views_.region->setReference(image.reference(), toQString(image.referenceTitle()));
    });
    connect(&views_.image->regionTool(), &RegionTool::chosen, this, [this] {
        // The first region brings its numbers to the front; then the tabs are as a person wants them.
        if (!regionShown_ && !selection_.state().region.empty()) showDock("region");
        regionShown_ = regionShown_ || !selection_.state().region.empty();
    });
}

void MainWindow::showStates() {
    StateOverlay& overlay = views_.image->overlay();
    if (dataset_.currentImage()) {
        overlay.clear();
        return;
    }
    if (session_.isOpeningSession()) {
        overlay.showBusy(tr("Opening the session"), session_.sessionFraction(), tr("Cancel"), [this] { session_.cancelSession(); });
        return;
    }
    const auto openPanel = [this] { connectPanel_->openBelow(connectButton_); };
    switch (session_.link()) {
        case LinkState::offline:
            overlay.showEmpty(tr("No image yet"), tr("Connect to a renderer, or drop a session (.emca) or an image (EXR, PFM, HDR, PNG) here."), tr("Connect…"), openPanel);
            break;
        case LinkState::connecting:
            overlay.showBusy(tr("Connecting to %1").arg(toQString(session_.address().text())), -1, tr("Cancel"),
                             [this] { session_.disconnectFromRenderer(); });
            break;
        case LinkState::reconnecting:
            overlay.showError(tr("%1 went away. It will be connected again as soon as it answers.").arg(toQString(session_.address().text())),
                              tr("Try now"), [this] { session_.retryNow(); });
            break;
        case LinkState::connected:
            overlay.showEmpty(tr("Nothing rendered yet"), tr("Render the scene, or drop an image of it here."), tr("Render"), [this] { render(); });
    }
}

void MainWindow::showBusy() {
    const bool busy = session_.isTracing() && session_.traceSeconds() > kBusyAfterSeconds && !session_.tracedPixels().empty();
    for (const auto& [view, overlay] : busy_) {
        if (busy) {
            overlay->showBusy(tr("Tracing %1").arg(toQString(session_.tracedPixels().text())), session_.traceFraction(),
                              tr("Cancel"), [this] { session_.cancelTrace(); });
        } else if (overlay->isVisibleTo(view)) {
            overlay->clear();
        }
    }
}

void MainWindow::showFailure(FailedTask task, const QString& sentence) {
    if (files_->showFailure(task, sentence)) return showStates();
    switch (task) {
        case FailedTask::connect:
            toast_->showError(sentence, tr("Try again"), [this] { session_.retryNow(); });
            break;
        case FailedTask::trace:
            if (session_.link() == LinkState::offline) toast_->showError(sentence, tr("Connect…"), [this] { connectPanel_->openBelow(connectButton_); });
            else toast_->showError(sentence, tr("Trace again"), [this] { session_.traceAgain(); });
            break;
        case FailedTask::render: toast_->showError(sentence, tr("Render again"), [this] { render(); }); break;
        case FailedTask::scene:
            views_.scene->showLoadError(sentence);
            // With paths to show, the 3D view has no room for the sentence.
            if (dataset_.meshes() || !dataset_.paths().empty()) toast_->showError(sentence, tr("Load again"), [this] { session_.reloadScene(); });
            break;
        case FailedTask::surface: toast_->showError(tr("The layers did not come: %1").arg(sentence), tr("Render again"), [this] { render(); }); break;
        case FailedTask::openImage: case FailedTask::saveImage: case FailedTask::openSession: case FailedTask::saveSession: break;
    }
    showStates();
}

}  // namespace emca::explorer
