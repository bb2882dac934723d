#pragma once

#include <QColor>
#include <QString>

#include <optional>
#include <string>
#include <vector>

#include "emca/analysis/color_map.h"
#include "emca/core/path_set.h"
#include "surface_style.h"

namespace emca::explorer {

/// By what paths are coloured. A plain value.
struct PathColorStyle {
    std::string quantity;                  ///< expression of the query language; empty: colours say what a segment is
    analysis::ColorMapId map = analysis::ColorMapId::turbo;
    bool log = false;
    std::optional<SurfaceLimits> limits;   ///< nothing: most of the values
    friend bool operator==(const PathColorStyle&, const PathColorStyle&) = default;
};

/// A colour per vertex, for the segment that leads to it and its dot: by a number of the vertex or of its path. Colours
/// count by their luminance, vectors by their length, conditions as 0 and 1, texts as categories. Knows no OpenGL.
class PathColoring {
  public:
    /// Evaluates the quantity if it or the paths are others than before.
    /// \param ground  of the picture: colours of the map are made to be seen on it; invalid: as they are
    void update(const PathSet& paths, const PathColorStyle& style, const QColor& ground = {});

    const PathColorStyle& style() const { return style_; }
    bool isOn() const { return !colors_.empty(); }
    /// Why there are no colours although a quantity is given; empty if there are.
    const QString& error() const { return error_; }
    QString title() const;                       ///< the quantity, and its unit if that is known
    const analysis::ValueRange& range() const { return range_; }
    bool isIntegral() const { return integral_; }   ///< all values are whole numbers
    /// Of texts those that occur, in the order of the alphabet; empty for numbers.
    const std::vector<std::string>& categories() const { return categories_; }
    QColor categoryColor(std::size_t category) const;
    /// Nothing where the vertex has no value.
    std::optional<double> value(Index vertex) const;
    std::string text(Index vertex) const;        ///< the value as words, with nothing for none
    /// Grey and translucent where there is no value. NaN has a colour of its own.
    QColor color(Index vertex, const QColor& otherwise) const;

  private:
    void evaluate(const PathSet& paths);
    void recolor();

    PathColorStyle style_;
    PathSet paths_;                              ///< shares its columns
    std::vector<double> values_;                 ///< per vertex
    std::vector<std::uint8_t> known_;
    std::vector<std::string> categories_;
    std::vector<analysis::Color8> colors_;
    analysis::ValueRange range_;
    QColor ground_;
    bool integral_ = false;
    QString error_;
};

/// What can be chosen: expressions that give one number, colour, vector, condition or text per vertex or path of these
/// paths, core quantities first.
std::vector<std::string> colorableQuantities(const PathSet& paths);

}  // namespace emca::explorer
