#pragma once

#include <QString>
#include <QWidget>
#include <vector>

#include "emca/client/dataset.h"
#include "emca/client/selection.h"

namespace emca::explorer {

class FilterPanel;
class HistoryView;
class ImageView;
class OutlierPanel;
class ParallelPlot;
class PathPlot;
class PathTree;
class RegionPanel;
class SceneView;
class SurfacePanel;
class Theme;
class VertexTable;

/// Every view of the window, made once; the docks own them.
struct Views {
    struct Plot {
        QString title, name;      ///< for people; for the saved layout
        PathPlot* widget;
    };
    ImageView* image = nullptr;
    SceneView* scene = nullptr;
    QWidget* sceneOptions = nullptr;
    SurfacePanel* surfaces = nullptr;     ///< inside surfaceScroll
    QWidget* surfaceScroll = nullptr;
    PathTree* paths = nullptr;
    VertexTable* vertex = nullptr;
    HistoryView* history = nullptr;
    OutlierPanel* outliers = nullptr;
    FilterPanel* filter = nullptr;
    RegionPanel* region = nullptr;
    std::vector<Plot> plots;
    ParallelPlot* parallel = nullptr;

    static Views make(client::Dataset& dataset, client::Selection& selection, Theme& theme);
};

}  // namespace emca::explorer
