#pragma once

#include <QAbstractTableModel>
#include <array>
#include <optional>
#include <span>
#include <vector>

#include "emca/core/path_set.h"
#include "paths/path_entries.h"

namespace emca::explorer {

/// All quantities of one vertex, and the same ones at the vertices before and after it on its path.
class VertexTableModel : public QAbstractTableModel {
    Q_OBJECT
  public:
    enum Column { kQuantity = 0, kPrevious = 1, kThis = 2, kNext = 3, kColumnCount = 4 };
    struct Cell {
        bool present = false;
        ValueCells value;
        QString full;  ///< for copying
        std::optional<Color> color;
        Tone tone = Tone::normal;
        friend bool operator==(const Cell&, const Cell&) = default;
    };

    explicit VertexTableModel(QObject* parent = nullptr) : QAbstractTableModel(parent) {}
    /// Nothing: an empty table. Tells of what differs only; there is no reset.
    /// \param meshes  of the scene, for the names of surfaces
    void setVertex(const PathSet& paths, std::optional<Index> vertex, std::span<const Mesh> meshes = {});
    std::optional<Index> vertex() const { return vertex_; }
    /// Neighbours on the path: of the same subpath, in order of depth.
    std::optional<Index> previous() const { return neighbours_[0]; }
    std::optional<Index> next() const { return neighbours_[1]; }

    QString quantity(int row) const { return rows_[static_cast<std::size_t>(row)].quantity; }
    const Cell& cell(int row, Column column) const;
    /// The value that a cell shows; nothing where there is none, and of what happened at the vertex.
    std::optional<Entry> entry(int row, Column column) const;
    /// The vertex of a column.
    std::optional<Index> vertexOf(Column column) const;

    int rowCount(const QModelIndex& parent = {}) const override { return parent.isValid() ? 0 : int(rows_.size()); }
    int columnCount(const QModelIndex& parent = {}) const override { return parent.isValid() ? 0 : kColumnCount; }
    QVariant data(const QModelIndex& index, int role) const override;
    QVariant headerData(int section, Qt::Orientation orientation, int role) const override;

  private:
    struct Row {
        QString quantity;
        std::array<Cell, 3> cells;  ///< previous, this, next
        std::array<std::optional<Entry>, 3> entries = {};
    };
    std::vector<Row> rowsOf(const PathSet& paths, Index vertex, std::span<const Mesh> meshes, std::array<QString, 3>& titles);
    void show(std::vector<Row> rows, std::array<QString, 3> titles);
    std::vector<Row> rows_;
    std::optional<Index> vertex_;
    std::array<std::optional<Index>, 2> neighbours_;
    std::array<QString, 3> titles_;
};

}  // namespace emca::explorer
