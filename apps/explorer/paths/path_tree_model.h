#pragma once

#include <QAbstractItemModel>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "emca/core/path_set.h"
#include "paths/path_entries.h"

Q_DECLARE_METATYPE(emca::Color)

namespace emca::explorer {

/// What the top level of the tree is ordered by.
enum class PathOrder : std::uint8_t { sample = 0, luminance = 1, depth = 2 };

/// The paths of a set as a tree: path → "info", "data", vertices → values. Nothing is stored per row: a row's identity
/// is computed from its internal id, its children when they are asked for. So a set of any size is shown at once.
class PathTreeModel : public QAbstractItemModel {
    Q_OBJECT
  public:
    enum Column { kItem = 0, kValue = 1, kSwatch = 2, kColumnCount = 3 };
    enum Role {
        kColorRole = Qt::UserRole + 1,  ///< emca::Color of the swatch, if the row has one
        kToneRole,                      ///< int(Tone)
        kFullTextRole,                  ///< value in full, for copying
        kNumbersRole,                   ///< QStringList: components of the value, if they are numbers
        kNoteRole,                      ///< QString beside the item or the value: "depth 7", "visible"
        kNodeKindRole,                  ///< int(Node::Kind)
    };

    /// What a row is.
    struct Node {
        enum class Kind : std::uint8_t {
            path = 0,
            infoGroup = 1,
            dataGroup = 2,
            vertex = 3,
            infoEntry = 4,
            dataEntry = 5,
            vertexEntry = 6
        };
        Kind kind = Kind::path;
        Index owner = 0;          ///< path; of vertices and their entries: vertex
        std::uint32_t entry = 0;  ///< number of the entry below its parent
        friend bool operator==(const Node&, const Node&) = default;
    };

    explicit PathTreeModel(QObject* parent = nullptr) : QAbstractItemModel(parent) {}

    /// Shows paths of a set: all, or those at the positions given (any order, each once). Resets the model.
    void setPaths(PathSet paths, std::optional<std::vector<Index>> shown = std::nullopt);
    /// Those of the scene, for the names of surfaces; null: not known. Views have to be drawn again, no row changes.
    void setMeshes(std::shared_ptr<const std::vector<Mesh>> meshes) { meshes_ = std::move(meshes); }
    std::span<const Mesh> meshes() const { return meshes_ ? std::span<const Mesh>(*meshes_) : std::span<const Mesh>(); }
    /// Only rows of values whose key contains the text (any case); paths and vertices stay. Resets the model.
    void setFilter(const QString& filter);
    const QString& filter() const { return filter_; }
    /// Rows move, nothing is reset. Paths without final estimate come last, NaN counts as larger than everything.
    void setOrder(PathOrder order, bool descending);
    PathOrder order() const { return order_; }
    bool descending() const { return descending_; }

    const PathSet& paths() const { return paths_; }
    /// Positions of the shown paths, in the order of the rows.
    const std::vector<Index>& shown() const { return shown_; }
    bool showsAll() const { return shown_.size() == paths_.pathCount(); }

    /// index must be valid.
    Node node(const QModelIndex& index) const;
    /// The path that a row belongs to.
    Index pathOf(const QModelIndex& index) const;
    /// The vertex that a row is or belongs to.
    std::optional<Index> vertexOf(const QModelIndex& index) const;
    /// The value that a row shows, if it shows one.
    std::optional<Entry> entryOf(const QModelIndex& index) const;
    /// Row of a path, invalid if it is not shown.
    QModelIndex pathIndex(Index path, int column = 0) const;
    QModelIndex vertexIndex(Index vertex, int column = 0) const;
    QModelIndex groupIndex(Index path, bool data) const;

    QModelIndex index(int row, int column, const QModelIndex& parent = {}) const override;
    QModelIndex parent(const QModelIndex& child) const override;
    QModelIndex sibling(int row, int column, const QModelIndex& index) const override;
    int rowCount(const QModelIndex& parent = {}) const override;
    int columnCount(const QModelIndex& = {}) const override { return kColumnCount; }
    bool hasChildren(const QModelIndex& parent = {}) const override;
    QVariant data(const QModelIndex& index, int role) const override;
    QVariant headerData(int section, Qt::Orientation orientation, int role) const override;
    Qt::ItemFlags flags(const QModelIndex& index) const override;

  private:
    QModelIndex create(int row, int column, const Node& node) const;
    const std::vector<Entry>& entries(Node::Kind parent, Index owner) const;
    /// Which of the groups a path has; they come before its vertices.
    struct Groups {
        bool info = false, data = false;
        int count() const { return int(info) + int(data); }
    };
    Groups groups(Index path) const;
    void arrange();

    QVariant pathData(Index path, int column, int role) const;
    QVariant vertexData(Index vertex, int column, int role) const;
    QVariant groupData(const Node& node, int column, int role) const;
    QVariant entryData(const Entry& entry, int column, int role) const;

    PathSet paths_;
    std::shared_ptr<const std::vector<Mesh>> meshes_;
    std::vector<Index> shown_;
    std::vector<int> rowOfPath_;  ///< -1 if not shown
    bool several_ = false;
    QString filter_;
    PathOrder order_ = PathOrder::sample;
    bool descending_ = false;
    // Entries of the owner asked for last: views ask for row after row of the same one.
    struct Cache {
        bool valid = false;
        Node::Kind parent{};
        Index owner = 0;
        std::vector<Entry> entries;
    };
    mutable Cache cache_;
};

}  // namespace emca::explorer
