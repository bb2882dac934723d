#include "paths/vertex_table_model.h"

#include <algorithm>
#include <map>

#include "base/table_text.h"

namespace emca::explorer {
namespace {

using Key = std::pair<QString, int>;  ///< name, and which one of those of the same name

VertexTableModel::Cell cellOf(const PathSet& paths, const Entry& entry, std::span<const Mesh> meshes) {
    return {true, valueCells(paths, entry, meshes), fullValueText(paths, entry, meshes), colorOf(paths, entry), toneOf(paths, entry)};
}

VertexTableModel::Cell textCell(const QString& text) { return {true, {{}, text, {}}, text, {}, Tone::normal}; }

std::vector<std::pair<Key, Entry>> keyed(const PathSet& paths, Index vertex) {
    std::vector<Entry> entries;
    appendVertexEntries(paths, vertex, {}, entries);
    std::vector<std::pair<Key, Entry>> result;
    std::map<QString, int> seen;
    for (const Entry& entry : entries) {
        const QString key = keyText(paths, entry);
        result.push_back({{key, seen[key]++}, entry});
    }
    return result;
}

QString eventText(const PathSet& paths, Index vertex) {
    const QString text = vertexText(paths, vertex);
    const int dot = text.indexOf(QStringLiteral(" · "));
    return dot < 0 ? QString() : text.mid(dot + 3);
}

QString depthTitle(const PathSet& paths, Index vertex) {
    return QStringLiteral("vertex ") + vertexText(paths, vertex).section(QStringLiteral(" · "), 0, 0);
}

}  // namespace

void VertexTableModel::setVertex(const PathSet& paths, std::optional<Index> vertex, std::span<const Mesh> meshes) {
    std::array<QString, 3> titles;
    std::vector<Row> rows;
    vertex_ = vertex;
    neighbours_ = {};
    if (vertex) rows = rowsOf(paths, *vertex, meshes, titles);
    show(std::move(rows), std::move(titles));
}

std::vector<VertexTableModel::Row> VertexTableModel::rowsOf(const PathSet& paths, Index vertex, std::span<const Mesh> meshes,
                                                            std::array<QString, 3>& titles) {
    const IndexRange range = paths.vertices(paths.pathOf(vertex));
    const auto same = [&](Index other) { return paths.subpath(other) == paths.subpath(vertex); };
    if (vertex > range.first && same(vertex - 1)) neighbours_[0] = vertex - 1;
    if (vertex + 1 < range.last && same(vertex + 1)) neighbours_[1] = vertex + 1;
    const std::array<std::optional<Index>, 3> columns{neighbours_[0], vertex, neighbours_[1]};

    std::vector<Row> rows;
    std::array<std::map<Key, Entry>, 3> there;
    Row event{QStringLiteral("event"), {}};
    for (std::size_t c = 0; c < 3; ++c) {
        if (!columns[c]) continue;
        titles[c] = depthTitle(paths, *columns[c]);
        for (const auto& [key, entry] : keyed(paths, *columns[c])) there[c].emplace(key, entry);
        if (const QString text = eventText(paths, *columns[c]); !text.isEmpty()) event.cells[c] = textCell(text);
    }
    if (event.cells[1].present) rows.push_back(event);
    for (const auto& [key, entry] : keyed(paths, vertex)) {
        Row row{key.first, {}};
        for (std::size_t c = 0; c < 3; ++c)
            if (const auto at = there[c].find(key); at != there[c].end()) {
                row.cells[c] = cellOf(paths, at->second, meshes);
                row.entries[c] = at->second;
            }
        rows.push_back(std::move(row));
    }
    return rows;
}

// Without a reset: after one, a view lays its rows out a turn of the event loop later and paints a second time.
void VertexTableModel::show(std::vector<Row> rows, std::array<QString, 3> titles) {
    const int before = int(rows_.size()), now = int(rows.size());
    if (now < before) {
        beginRemoveRows({}, now, before - 1);
        rows_.resize(rows.size());
        endRemoveRows();
    } else if (now > before) {
        beginInsertRows({}, before, now - 1);
        rows_.insert(rows_.end(), rows.begin() + before, rows.end());
        endInsertRows();
    }
    for (int r = 0; r < std::min(before, now); ++r) {
        Row &old = rows_[std::size_t(r)], &fresh = rows[std::size_t(r)];
        const bool renamed = old.quantity != fresh.quantity;
        std::array<bool, kColumnCount> changed{renamed};
        for (std::size_t c = 0; c < 3; ++c) changed[kPrevious + c] = !(old.cells[c] == fresh.cells[c]);
        old = std::move(fresh);
        for (int c = 0; c < kColumnCount; ++c)
            if (changed[std::size_t(c)]) emit dataChanged(index(r, c), index(r, c));
    }
    if (titles == titles_) return;
    titles_ = std::move(titles);
    emit headerDataChanged(Qt::Horizontal, kPrevious, kNext);
}

const VertexTableModel::Cell& VertexTableModel::cell(int row, Column column) const {
    return rows_[static_cast<std::size_t>(row)].cells[static_cast<std::size_t>(column - kPrevious)];
}

std::optional<Entry> VertexTableModel::entry(int row, Column column) const {
    if (row < 0 || row >= rowCount() || column == kQuantity) return std::nullopt;
    return rows_[static_cast<std::size_t>(row)].entries[static_cast<std::size_t>(column - kPrevious)];
}

std::optional<Index> VertexTableModel::vertexOf(Column column) const {
    return column == kPrevious ? neighbours_[0] : column == kNext ? neighbours_[1] : vertex_;
}

QVariant VertexTableModel::data(const QModelIndex& index, int role) const {
    if (!index.isValid()) return {};
    if (index.column() == kQuantity) return role == Qt::DisplayRole ? QVariant(quantity(index.row())) : QVariant();
    const Cell& cell = this->cell(index.row(), Column(index.column()));
    if (!cell.present) return {};
    if (role == Qt::DisplayRole)
        return cell.value.numbers.isEmpty() ? cell.value.text : cell.value.numbers.join(QStringLiteral("  "));
    if (role == kCopyRole) return cell.full;
    if (role == Qt::ToolTipRole) return quantity(index.row()) + QStringLiteral(": ") + cell.full;
    return {};
}

QVariant VertexTableModel::headerData(int section, Qt::Orientation orientation, int role) const {
    if (orientation != Qt::Horizontal) return {};
    if (role == Qt::TextAlignmentRole) return int(Qt::AlignLeft | Qt::AlignVCenter);
    if (role == Qt::ToolTipRole)
        return section == kQuantity   ? tr("Radiance in W/(sr m²), positions in scene units, densities per steradian unless the name ends in “_area”")
               : section == kPrevious ? tr("The vertex before on the path")
               : section == kThis     ? tr("The selected vertex")
                                      : tr("The next vertex on the path");
    if (role != Qt::DisplayRole) return {};
    if (section == kQuantity) return QStringLiteral("Quantity");
    const QString& title = titles_[static_cast<std::size_t>(section - kPrevious)];
    if (!title.isEmpty()) return title;
    return section == kPrevious ? QStringLiteral("no vertex before")
           : section == kNext   ? QStringLiteral("no vertex after")
                                : QString();
}

}  // namespace emca::explorer
