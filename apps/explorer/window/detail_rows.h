#pragma once

#include <QString>
#include <optional>
#include <span>
#include <vector>

#include "emca/core/color.h"
#include "emca/core/mesh.h"
#include "emca/core/path_set.h"

namespace emca::explorer {

/// A line of the detail table. Rows without a value are headings.
struct DetailRow {
    QString name;
    QString value;                  ///< as it is shown
    QString full;                   ///< as it is copied: all digits
    std::optional<Color> swatch;    ///< linear Rec. 709
    bool warning = false;           ///< NaN, infinite or missing light
    bool heading() const { return value.isEmpty() && full.isEmpty(); }
};

/// Everything that is recorded of a vertex: core quantities first, then light, then the renderer's own data.
/// \param meshes  for the names of surfaces; may be empty
std::vector<DetailRow> vertexRows(const PathSet& paths, Index vertex, std::span<const Mesh> meshes);
/// The same of a path.
std::vector<DetailRow> pathRows(const PathSet& paths, Index path);

}  // namespace emca::explorer
