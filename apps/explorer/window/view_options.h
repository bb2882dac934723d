#pragma once

#include <QVariantMap>

namespace emca::explorer {

struct SceneOptions;
struct Views;

/// Options of views that belong to a layout: scales of plots, everything of the 3D view, widths of columns, splitters.
/// What is missing or not understood stays as it is.
QVariantMap viewOptions(const Views& views);
void setViewOptions(const Views& views, const QVariantMap& options);

/// Those of the 3D view that say what is seen, as "scene/clipAxis"; not what serves a person or a machine (anti-aliasing,
/// flights, detail).
QVariantMap sceneSight(const SceneOptions& options);
/// What is missing or not understood stays as it is.
void setSceneSight(SceneOptions& options, const QVariantMap& sight);

}  // namespace emca::explorer
