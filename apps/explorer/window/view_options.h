#pragma once

#include <QVariantMap>

namespace emca::explorer {

struct Views;

/// Options of views that belong to a layout: scales of plots, everything of the 3D view, widths of columns, splitters.
/// What is missing or not understood stays as it is.
QVariantMap viewOptions(const Views& views);
void setViewOptions(const Views& views, const QVariantMap& options);

}  // namespace emca::explorer
