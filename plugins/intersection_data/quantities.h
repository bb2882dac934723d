#pragma once

#include <string>
#include <vector>

#include "emca/core/path_set.h"

namespace emca::intersection_data {

/// How a quantity is shown over the depth of its path.
enum class Kind {
    scalar,    ///< one number (bool, int, float, double)
    color,     ///< red, green, blue
    point,     ///< two numbers: a plot of one over the other
    vector,    ///< three numbers over depth
    text,      ///< words over depth
    spectrum,  ///< many numbers: over their index, one curve per vertex
};

/// A value that was recorded at a vertex.
struct Entry {
    Index vertex = 0;              ///< in the PathSet
    std::vector<double> numbers;   ///< as many as the kind says; of text: index into Quantity::words
};

/// Everything of one name and type along one path; a vertex may have several values, in call order, or none.
struct Quantity {
    std::string name;              ///< "BSDF pdf"; of core quantities as the rest of the explorer calls them
    std::string unit;              ///< or empty
    Kind kind = Kind::scalar;
    bool integral = false;         ///< whole numbers
    std::vector<Entry> entries;    ///< in the order of the path's vertices
    std::vector<std::string> words;  ///< of text and bool, in order of appearance (bool: "false", "true")

    /// In one line, of the last value at a vertex; empty if there is none.
    std::string valueAt(Index vertex) const;
};

/// All quantities that have a value at some vertex of a path: what the renderer added, by name, then the running
/// estimate, emission, contributions and their MIS weights.
std::vector<Quantity> quantitiesOf(const PathSet& paths, Index path);

}  // namespace emca::intersection_data
