#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace emca::cli {

/// Text in columns two blanks apart, as wide as their widest cell. Widths count code points, so that "²" is one wide.
class Table {
  public:
    enum class Align { left, right };
    struct Column {
        std::string header;
        Align align = Align::right;
    };
    explicit Table(std::vector<Column> columns) : columns_(std::move(columns)) {}
    /// As many cells as there are columns.
    void add(std::vector<std::string> row) { rows_.push_back(std::move(row)); }
    /// The header, then each row; every line ends with a line feed and without blanks. Control characters of cells
    /// (names come from elsewhere) become '?', so that they cannot command a terminal.
    std::string text() const;

  private:
    std::vector<Column> columns_;
    std::vector<std::vector<std::string>> rows_;
};

/// Text from a renderer without control characters.
std::string printable(std::string text);

}  // namespace emca::cli
