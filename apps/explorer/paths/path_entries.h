#pragma once

#include <QString>
#include <QStringList>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "emca/client/dataset.h"
#include "emca/core/mesh.h"
#include "emca/core/path_set.h"

namespace emca::explorer {

/// One row of values below a path or below a vertex. What it says is read when it is shown.
struct Entry {
    enum class Kind : std::uint8_t {
        // of a path
        finalEstimate,
        luminance,
        depth,
        origin,
        splat,
        // of a vertex
        position,
        estimate,
        emission,
        surface,
        contribution,
        nextEvent,
        // of either: a value of user data
        data,
    };
    Kind kind = Kind::data;
    Index owner = 0;           ///< path or vertex
    std::uint32_t column = 0;  ///< data: which of PathSet::userColumns()
    Index item = 0;            ///< data: value of the column; splat, contribution, nextEvent: position in the PathSet
    friend bool operator==(const Entry&, const Entry&) = default;
};

/// How a row is coloured.
enum class Tone : std::uint8_t { normal, warning, visible, occluded };

/// Appends the rows of one owner whose key contains `filter` (any case; empty: all), in the order in which they are
/// shown. `out` is not cleared.
void appendPathInfo(const PathSet& paths, Index path, const QString& filter, std::vector<Entry>& out);
void appendPathData(const PathSet& paths, Index path, const QString& filter, std::vector<Entry>& out);
void appendVertexEntries(const PathSet& paths, Index vertex, const QString& filter, std::vector<Entry>& out);

/// Name of the quantity: "position", "light sampling", or the key of user data.
QString keyText(const PathSet& paths, const Entry& entry);
/// On one line, four significant digits. \param meshes  of the scene, for the names of surfaces; empty: not known
QString valueText(const PathSet& paths, const Entry& entry, std::span<const Mesh> meshes = {});
/// In full, for copying: what is read back has the same bits.
QString fullValueText(const PathSet& paths, const Entry& entry, std::span<const Mesh> meshes = {});
/// The same in parts, so that columns of numbers align: numbers of one to four components, or else a text; and a note
/// ("MIS 0.5000": the weight, "visible").
struct ValueCells {
    QStringList numbers;
    QString text, note;
    friend bool operator==(const ValueCells&, const ValueCells&) = default;
};
ValueCells valueCells(const PathSet& paths, const Entry& entry, std::span<const Mesh> meshes = {});
/// Cells of a value without a note.
ValueCells valueCells(const Value& value);
/// For a swatch; nothing if the value is no colour.
std::optional<Color> colorOf(const PathSet& paths, const Entry& entry);
Tone toneOf(const PathSet& paths, const Entry& entry);

/// "Path 417", with several pixels "Path 417 (12, 30)", of a split sample "Path 417.1".
QString pathText(const PathSet& paths, Index path, bool withPixel);
/// "3 · transmit specular · glass"; of light subpaths "light 2 · …".
QString vertexText(const PathSet& paths, Index vertex);
/// Whether any number of it is NaN or infinite.
bool hasNonFinite(const Value& value);
bool isNonFinite(Color color);

/// A path, its vertices and all their values as indented lines, with values in full.
QString pathAsText(const PathSet& paths, Index path, std::span<const Mesh> meshes = {});
QString vertexAsText(const PathSet& paths, Index vertex, std::span<const Mesh> meshes = {}, int indent = 0);

/// Those of the scene that is connected; none if it did not come.
std::span<const Mesh> meshesOf(const client::Dataset& dataset);

}  // namespace emca::explorer
