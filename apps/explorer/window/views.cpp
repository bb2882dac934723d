#include "window/views.h"

#include <QObject>
#include <QScrollArea>

#include "base/theme.h"
#include "image/image_view.h"
#include "image/region_panel.h"
#include "parallel/parallel_plot.h"
#include "paths/filter_panel.h"
#include "paths/outlier_panel.h"
#include "paths/path_tree.h"
#include "paths/vertex_table.h"
#include "plots/contribution_plot.h"
#include "plots/depth_plot.h"
#include "plots/luminance_plot.h"
#include "scene/scene_options_panel.h"
#include "scene/scene_view.h"
#include "scene/surface_panel.h"
#include "window/history_view.h"

namespace emca::explorer {
namespace {

QWidget* scrolled(QWidget* content) {
    auto* scroll = new QScrollArea;
    scroll->setWidgetResizable(true);
    scroll->setFrameShape(QFrame::NoFrame);
    scroll->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
    scroll->setWidget(content);
    return scroll;
}

}  // namespace

Views Views::make(client::Dataset& dataset, client::Selection& selection, Theme& theme) {
    Views views;
    views.image = new ImageView(dataset, selection, theme);
    views.scene = new SceneView(dataset, selection, theme);
    views.sceneOptions = scrolled(new SceneOptionsPanel(*views.scene, theme));
    views.surfaces = new SurfacePanel(dataset, views.scene->surfaces(), theme);
    views.surfaceScroll = scrolled(views.surfaces);
    views.paths = new PathTree(dataset, selection, theme);
    views.vertex = new VertexTable(dataset, selection, theme);
    views.outliers = new OutlierPanel(dataset, selection, theme);
    views.filter = new FilterPanel(dataset, selection, theme);
    views.region = new RegionPanel(dataset, selection, theme);
    views.history = new HistoryView(dataset, selection, theme);
    views.plots = {{QObject::tr("RGB"), "plots-rgb", new ContributionPlot(dataset, selection, theme)},
                   {QObject::tr("Luminance"), "plots-luminance", new LuminancePlot(dataset, selection, theme)},
                   {QObject::tr("Depth"), "plots-depth", new DepthPlot(dataset, selection, theme)}};
    views.parallel = new ParallelPlot(dataset, selection, theme);
    return views;
}

}  // namespace emca::explorer
