#pragma once

#include <QString>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "emca/analysis/parallel_axes.h"
#include "emca/query/axis.h"

namespace emca::explorer {

/// What a person wants on an axis.
struct AxisWish {
    QString expression;   ///< docs/queries.md; one number, condition or text per path
    bool log = false, flipped = false;
    friend bool operator==(const AxisWish&, const AxisWish&) = default;
};

/// An axis, and what it shows of the paths at hand.
struct ParallelAxis {
    AxisWish wish;
    std::optional<query::Query> parsed;
    QString error;                        ///< why it shows nothing; empty: it does, or no path has it
    QString unit;                         ///< of core quantities that have one
    query::AxisValues values;             ///< as many as there are paths
    analysis::AxisScale scale;
    std::vector<query::Brush> brushes;    ///< paths have to lie in one of them

    /// No path has a value.
    bool isEmpty() const { return !error.isEmpty() || scale.missing == values.size(); }
    bool isText() const { return !values.categories.empty(); }
    /// A logarithmic axis was asked for, and its values have logarithms.
    bool isLog() const { return wish.log && !isText(); }
    /// As a person reads it: "0.1234", "12", "glass", "NaN", "not recorded".
    QString valueText(Index path) const;
};

/// Axes over paths, beside each other. No widget: what is shown, marked and saved.
class ParallelAxes {
  public:
    static constexpr std::size_t kMost = 24;
    /// Of any renderer's paths: sample index, depth, luminance and what led to it.
    static std::vector<AxisWish> defaults();

    void setPaths(const PathSet& paths);
    const PathSet& paths() const { return paths_; }
    /// Replaces all axes; brushes are gone. Wishes that are no expressions are left out.
    void setWishes(const std::vector<AxisWish>& wishes);
    std::vector<AxisWish> wishes() const;

    std::size_t size() const { return axes_.size(); }
    const ParallelAxis& operator[](std::size_t i) const { return axes_[i]; }
    const std::vector<ParallelAxis>& all() const { return axes_; }

    /// At the end. Errors: parseFailed (no expression, or several numbers); tooLarge (more axes than anybody can read).
    Result<void> add(const AxisWish& wish);
    void remove(std::size_t axis);
    void move(std::size_t from, std::size_t to);
    void setLog(std::size_t axis, bool log);
    void setFlipped(std::size_t axis, bool flipped);

    void setBrushes(std::size_t axis, std::vector<query::Brush> brushes);
    void clearBrushes();
    bool hasBrushes() const;
    /// Paths in a brush of every axis that has one; ascending.
    std::vector<Index> brushed() const;
    /// What the brushes of one axis ask for; of all axes with kAll.
    static constexpr std::size_t kAll = ~std::size_t(0);
    QString condition(std::size_t axis = kAll) const;
    /// The same as rules, if rules can say it.
    std::optional<std::vector<query::Rule>> rules(std::size_t axis = kAll) const;

    /// One line per path: pixel, sample, part and the values of all axes, numbers in full.
    QString csv() const;

  private:
    void evaluate(ParallelAxis& axis) const;
    void scale(ParallelAxis& axis) const;

    PathSet paths_;
    std::vector<ParallelAxis> axes_;
};

/// For settings, and back; what cannot be read is left out.
QString toText(const std::vector<AxisWish>& wishes);
std::vector<AxisWish> wishesFrom(const QString& text);

/// What could stand on an axis: quantities of paths as they are, those of vertices, contributions and shadow tests reduced
/// to one value per path; with a few words on each.
struct AxisSuggestion {
    QString expression, meaning;
};
std::vector<AxisSuggestion> axisSuggestions(const PathSet& paths);

}  // namespace emca::explorer
