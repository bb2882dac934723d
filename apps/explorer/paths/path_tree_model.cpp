#include "paths/path_tree_model.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/qt_compat.h"
#include "base/table_text.h"
#include "emca/analysis/format.h"

namespace emca::explorer {
namespace {

using Node = PathTreeModel::Node;
using Kind = PathTreeModel::Node::Kind;

// Qt hashes a model index by the sum of its row and internal id. Ids that count up collide there, and a tree view's set
// of expanded rows becomes quadratic; so ids are mixed by a bijection (xor-shift, odd multiplier, xor-shift).
constexpr std::uint64_t kMultiplier = 0x9e3779b97f4a7c15ull;

constexpr std::uint64_t inverseOf(std::uint64_t odd) {
    std::uint64_t x = odd;  // Newton's iteration doubles the number of right bits: 3, 6, 12, 24, 48, 96
    for (int i = 0; i < 5; ++i) x *= 2 - odd * x;
    return x;
}
constexpr std::uint64_t kInverse = inverseOf(kMultiplier);
static_assert(kMultiplier * kInverse == 1);

constexpr std::uint64_t mix(std::uint64_t x) {
    x ^= x >> 33;
    x *= kMultiplier;
    return x ^ (x >> 33);
}
constexpr std::uint64_t unmix(std::uint64_t x) {
    x ^= x >> 33;
    x *= kInverse;
    return x ^ (x >> 33);
}
static_assert(unmix(mix(0x0123456789abcdefull)) == 0x0123456789abcdefull);
static_assert(sizeof(quintptr) == 8, "internal ids need 64 bits");

std::uint64_t pack(const Node& node) {
    return std::uint64_t(node.kind) | std::uint64_t(node.owner) << 3 | std::uint64_t(node.entry) << 35;
}
Node unpack(std::uint64_t id) {
    return {Kind(id & 7), static_cast<Index>(id >> 3 & 0xffffffffu), static_cast<std::uint32_t>(id >> 35)};
}

QString counted(std::size_t count, const char* one, const char* many) {
    return QStringLiteral("%1 %2").arg(count).arg(QLatin1String(count == 1 ? one : many));
}

/// What a path is ordered by: first whether it has a value, then the value.
double sortKey(const PathSet& paths, Index path, PathOrder order) {
    if (order == PathOrder::depth) return paths.depth(path);
    const std::optional<Color> estimate = paths.estimate(path);
    if (!estimate) return -std::numeric_limits<double>::infinity();
    const double y = double(luminance(*estimate));
    return std::isnan(y) ? std::numeric_limits<double>::infinity() : y;
}

}  // namespace

void PathTreeModel::setPaths(PathSet paths, std::optional<std::vector<Index>> shown) {
    beginResetModel();
    paths_ = std::move(paths);
    several_ = false;
    if (!paths_.empty()) several_ = !(paths_.pixel(0) == paths_.pixel(paths_.pathCount() - 1));
    if (shown) {
        shown_ = std::move(*shown);
    } else {
        shown_.resize(paths_.pathCount());
        for (Index i = 0; i < paths_.pathCount(); ++i) shown_[i] = i;
    }
    cache_.valid = false;
    arrange();
    endResetModel();
}

void PathTreeModel::setFilter(const QString& filter) {
    if (filter == filter_) return;
    beginResetModel();
    filter_ = filter;
    cache_.valid = false;
    endResetModel();
}

void PathTreeModel::setOrder(PathOrder order, bool descending) {
    if (order == order_ && descending == descending_) return;
    emit layoutAboutToBeChanged({}, VerticalSortHint);
    order_ = order;
    descending_ = descending;
    const QModelIndexList before = persistentIndexList();
    arrange();
    QModelIndexList after;
    after.reserve(before.size());
    for (const QModelIndex& index : before) {
        const Node n = node(index);
        after.append(n.kind == Kind::path ? pathIndex(n.owner, index.column()) : index);
    }
    changePersistentIndexList(before, after);
    emit layoutChanged({}, VerticalSortHint);
}

void PathTreeModel::arrange() {
    std::sort(shown_.begin(), shown_.end());
    if (order_ == PathOrder::sample) {
        if (descending_) std::reverse(shown_.begin(), shown_.end());
    } else {
        std::vector<std::pair<double, Index>> keyed;
        keyed.reserve(shown_.size());
        for (const Index path : shown_) keyed.emplace_back(sortKey(paths_, path, order_), path);
        // Equal ones stay in the order of samples, in both directions.
        const auto smaller = [](const auto& a, const auto& b) { return a.first < b.first; };
        const auto larger = [](const auto& a, const auto& b) { return a.first > b.first; };
        descending_ ? std::stable_sort(keyed.begin(), keyed.end(), larger)
                    : std::stable_sort(keyed.begin(), keyed.end(), smaller);
        for (std::size_t i = 0; i < keyed.size(); ++i) shown_[i] = keyed[i].second;
        if (order_ == PathOrder::luminance)
            std::stable_partition(shown_.begin(), shown_.end(),
                                  [this](Index path) { return paths_.estimate(path).has_value(); });
    }
    rowOfPath_.assign(paths_.pathCount(), -1);
    for (std::size_t row = 0; row < shown_.size(); ++row) rowOfPath_[shown_[row]] = static_cast<int>(row);
}

const std::vector<Entry>& PathTreeModel::entries(Kind parent, Index owner) const {
    if (cache_.valid && cache_.parent == parent && cache_.owner == owner) return cache_.entries;
    cache_ = {true, parent, owner, std::move(cache_.entries)};
    cache_.entries.clear();
    if (parent == Kind::infoGroup) appendPathInfo(paths_, owner, filter_, cache_.entries);
    if (parent == Kind::dataGroup) appendPathData(paths_, owner, filter_, cache_.entries);
    if (parent == Kind::vertex) appendVertexEntries(paths_, owner, filter_, cache_.entries);
    return cache_.entries;
}

PathTreeModel::Groups PathTreeModel::groups(Index path) const {
    Groups groups;
    if (filter_.isEmpty()) {
        groups.info = true;  // every path has a depth
        for (const emca::Column& column : paths_.userColumns())
            if (column.scope == Scope::path && !column.valuesOf(path).empty()) {
                groups.data = true;
                break;
            }
        return groups;
    }
    std::vector<Entry> entries;
    appendPathInfo(paths_, path, filter_, entries);
    groups.info = !entries.empty();
    entries.clear();
    appendPathData(paths_, path, filter_, entries);
    groups.data = !entries.empty();
    return groups;
}

QModelIndex PathTreeModel::create(int row, int column, const Node& node) const {
    return createIndex(row, column, static_cast<quintptr>(mix(pack(node))));
}

PathTreeModel::Node PathTreeModel::node(const QModelIndex& index) const { return unpack(unmix(index.internalId())); }

Index PathTreeModel::pathOf(const QModelIndex& index) const {
    const Node n = node(index);
    return n.kind == Kind::vertex || n.kind == Kind::vertexEntry ? paths_.pathOf(n.owner) : n.owner;
}

std::optional<Index> PathTreeModel::vertexOf(const QModelIndex& index) const {
    const Node n = node(index);
    if (n.kind == Kind::vertex || n.kind == Kind::vertexEntry) return n.owner;
    return std::nullopt;
}

std::optional<Entry> PathTreeModel::entryOf(const QModelIndex& index) const {
    const Node n = node(index);
    const auto from = [&](Kind parent) -> std::optional<Entry> {
        const std::vector<Entry>& list = entries(parent, n.owner);
        return n.entry < list.size() ? std::optional<Entry>(list[n.entry]) : std::nullopt;
    };
    switch (n.kind) {
        case Kind::infoEntry:
            return from(Kind::infoGroup);
        case Kind::dataEntry:
            return from(Kind::dataGroup);
        case Kind::vertexEntry:
            return from(Kind::vertex);
        default:
            return std::nullopt;
    }
}

QModelIndex PathTreeModel::pathIndex(Index path, int column) const {
    if (path >= rowOfPath_.size() || rowOfPath_[path] < 0) return {};
    return create(rowOfPath_[path], column, {Kind::path, path, 0});
}

QModelIndex PathTreeModel::vertexIndex(Index vertex, int column) const {
    if (vertex >= paths_.vertexCount()) return {};
    const Index path = paths_.pathOf(vertex);
    if (rowOfPath_[path] < 0) return {};
    const int row = groups(path).count() + static_cast<int>(vertex - paths_.vertices(path).first);
    return create(row, column, {Kind::vertex, vertex, 0});
}

QModelIndex PathTreeModel::groupIndex(Index path, bool data) const {
    if (path >= rowOfPath_.size() || rowOfPath_[path] < 0) return {};
    const Groups present = groups(path);
    if (data) return present.data ? create(int(present.info), 0, {Kind::dataGroup, path, 0}) : QModelIndex();
    return present.info ? create(0, 0, {Kind::infoGroup, path, 0}) : QModelIndex();
}

QModelIndex PathTreeModel::index(int row, int column, const QModelIndex& parent) const {
    if (row < 0 || column < 0 || column >= kColumnCount) return {};
    if (!parent.isValid()) {
        if (static_cast<std::size_t>(row) >= shown_.size()) return {};
        return create(row, column, {Kind::path, shown_[static_cast<std::size_t>(row)], 0});
    }
    if (parent.column() != 0 || row >= rowCount(parent)) return {};
    const Node n = node(parent);
    const auto entry = static_cast<std::uint32_t>(row);
    switch (n.kind) {
        case Kind::path: {
            const Groups present = groups(n.owner);
            if (row < present.count())
                return create(row, column, {row == 0 && present.info ? Kind::infoGroup : Kind::dataGroup, n.owner, 0});
            return create(row, column,
                          {Kind::vertex, paths_.vertices(n.owner).first + entry - Index(present.count()), 0});
        }
        case Kind::infoGroup:
            return create(row, column, {Kind::infoEntry, n.owner, entry});
        case Kind::dataGroup:
            return create(row, column, {Kind::dataEntry, n.owner, entry});
        case Kind::vertex:
            return create(row, column, {Kind::vertexEntry, n.owner, entry});
        default:
            return {};
    }
}

QModelIndex PathTreeModel::parent(const QModelIndex& child) const {
    if (!child.isValid()) return {};
    const Node n = node(child);
    switch (n.kind) {
        case Kind::infoGroup:
        case Kind::dataGroup:
            return pathIndex(n.owner);
        case Kind::vertex:
            return pathIndex(paths_.pathOf(n.owner));
        case Kind::infoEntry:
            return groupIndex(n.owner, false);
        case Kind::dataEntry:
            return groupIndex(n.owner, true);
        case Kind::vertexEntry:
            return vertexIndex(n.owner);
        case Kind::path:
            return {};
    }
    return {};
}

QModelIndex PathTreeModel::sibling(int row, int column, const QModelIndex& index) const {
    // Views ask for the other columns of a row all the time; the row's id is the same.
    if (index.isValid() && row == index.row() && column >= 0 && column < kColumnCount)
        return createIndex(row, column, index.internalId());
    return QAbstractItemModel::sibling(row, column, index);
}

int PathTreeModel::rowCount(const QModelIndex& parent) const {
    if (!parent.isValid()) return static_cast<int>(shown_.size());
    if (parent.column() != 0) return 0;
    const Node n = node(parent);
    switch (n.kind) {
        case Kind::path:
            return groups(n.owner).count() + static_cast<int>(paths_.vertices(n.owner).size());
        case Kind::infoGroup:
        case Kind::dataGroup:
        case Kind::vertex:
            return static_cast<int>(entries(n.kind, n.owner).size());
        default:
            return 0;
    }
}

bool PathTreeModel::hasChildren(const QModelIndex& parent) const { return rowCount(parent) > 0; }

Qt::ItemFlags PathTreeModel::flags(const QModelIndex& index) const {
    if (!index.isValid()) return Qt::NoItemFlags;
    const bool leaf = node(index).kind >= Kind::infoEntry;
    return Qt::ItemIsEnabled | Qt::ItemIsSelectable | (leaf ? Qt::ItemNeverHasChildren : Qt::NoItemFlags);
}

QVariant PathTreeModel::headerData(int section, Qt::Orientation orientation, int role) const {
    if (orientation != Qt::Horizontal) return {};
    if (role == Qt::TextAlignmentRole) return int(Qt::AlignLeft | Qt::AlignVCenter);
    if (role == Qt::ToolTipRole)
        return section == kItem    ? tr("Path, vertex or quantity")
               : section == kValue ? tr("Radiance in W/(sr m²), positions in scene units, densities per steradian unless the name ends in “_area”")
                                   : tr("Colours at the image's exposure; a corner marks what clips");
    if (role != Qt::DisplayRole) return {};
    switch (section) {
        case kItem:
            return QStringLiteral("Item");
        case kValue:
            return QStringLiteral("Value  (radiance in W/(sr m²))");
        default:
            return {};
    }
}

QVariant PathTreeModel::data(const QModelIndex& index, int role) const {
    if (!index.isValid()) return {};
    const Node n = node(index);
    if (role == kNodeKindRole) return int(n.kind);
    if (role == kCopyRole) {
        const QString full = index.column() == kValue ? data(index, kFullTextRole).toString() : QString();
        return full.isEmpty() ? QVariant() : QVariant(full);
    }
    switch (n.kind) {
        case Kind::path:
            return pathData(n.owner, index.column(), role);
        case Kind::vertex:
            return vertexData(n.owner, index.column(), role);
        case Kind::infoGroup:
        case Kind::dataGroup:
            return groupData(n, index.column(), role);
        default:
            break;
    }
    const std::optional<Entry> entry = entryOf(index);
    return entry ? entryData(*entry, index.column(), role) : QVariant();
}

namespace {

/// Text, colour and tone of a row that stands for a colour.
QVariant colorRow(const std::optional<Color>& color, int column, int role) {
    if (!color) return {};
    if (role == Qt::DisplayRole && column == PathTreeModel::kValue) return toQString(analysis::formatColor(*color));
    if (role == PathTreeModel::kFullTextRole) return toQString(analysis::formatValueFull(Value(*color)));
    if (role == PathTreeModel::kNumbersRole) return valueCells(Value(*color)).numbers;
    if (role == PathTreeModel::kColorRole) return QVariant::fromValue(*color);
    if (role == PathTreeModel::kToneRole) return int(isNonFinite(*color) ? Tone::warning : Tone::normal);
    return {};
}

}  // namespace

QVariant PathTreeModel::pathData(Index path, int column, int role) const {
    if (role == Qt::DisplayRole && column == kItem) {
        return pathText(paths_, path, several_);
    }
    if (role == kNoteRole) return column == kItem ? QStringLiteral("depth %1").arg(paths_.depth(path)) : QString();
    if (role == Qt::ToolTipRole)
        return QStringLiteral("%1 of pixel %2, depth %3")
            .arg(pathText(paths_, path, false), toQString(analysis::formatPixel(paths_.pixel(path))))
            .arg(paths_.depth(path));
    if (role == Qt::DisplayRole && column == kValue && !paths_.estimate(path))
        return QStringLiteral("no final estimate");
    return colorRow(paths_.estimate(path), column, role);
}

QVariant PathTreeModel::vertexData(Index vertex, int column, int role) const {
    if (role == Qt::DisplayRole && column == kItem) return vertexText(paths_, vertex);
    const std::optional<Color> estimate = paths_.vertexEstimate(vertex);
    return colorRow(estimate ? estimate : paths_.emission(vertex), column, role);
}

QVariant PathTreeModel::groupData(const Node& n, int column, int role) const {
    if (role != Qt::DisplayRole) return {};
    if (column == kItem) return n.kind == Kind::infoGroup ? QStringLiteral("info") : QStringLiteral("data");
    if (column != kValue) return {};
    const std::size_t count = entries(n.kind, n.owner).size();
    if (n.kind == Kind::dataGroup) return counted(count, "value", "values");
    return QStringLiteral("depth %1, %2")
        .arg(paths_.depth(n.owner))
        .arg(counted(paths_.vertices(n.owner).size(), "vertex", "vertices"));
}

QVariant PathTreeModel::entryData(const Entry& entry, int column, int role) const {
    switch (role) {
        case Qt::DisplayRole:
            if (column == kItem) return keyText(paths_, entry);
            if (column == kValue) return valueText(paths_, entry, meshes());
            return {};
        case Qt::ToolTipRole:
            return keyText(paths_, entry) + QStringLiteral(": ") + fullValueText(paths_, entry, meshes());
        case kFullTextRole:
            return fullValueText(paths_, entry, meshes());
        case kNumbersRole:
            return valueCells(paths_, entry, meshes()).numbers;
        case kNoteRole:
            return column == kValue ? valueCells(paths_, entry, meshes()).note : QString();
        case kToneRole:
            return int(toneOf(paths_, entry));
        case kColorRole: {
            const std::optional<Color> color = colorOf(paths_, entry);
            return color ? QVariant::fromValue(*color) : QVariant();
        }
        default:
            return {};
    }
}

}  // namespace emca::explorer
