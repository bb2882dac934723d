// From values of a chunk, or of all groups of a table, to results.
#include "path_values.h"

#include <limits>

namespace emca::query::detail {

void setType(Type type, int components, PathValues& out) {
    out.type = type;
    const bool isNumber = type == Type::number || type == Type::color || type == Type::vector;
    out.components = type == Type::text ? 0 : isNumber || type == Type::spectrum ? components : 1;
}

void append(const Values& values, std::size_t size, const Texts* texts, PathValues& out) {
    for (std::size_t row = 0; row < size; ++row) {
        const std::size_t i = values.constant ? 0 : row;
        const bool known = values.isKnown(row);
        out.known.push_back(known);
        if (values.type == Type::boolean) out.numbers.push_back(known && values.truth[i] == kTrue ? 1 : 0);
        else if (values.type == Type::text) out.texts.emplace_back(known ? texts->text(values.texts[i]) : std::string_view());
        else if (values.type == Type::missing) out.numbers.push_back(0);
        else if (values.type != Type::spectrum)
            for (std::size_t c = 0; c < static_cast<std::size_t>(values.components); ++c)
                out.numbers.push_back(known ? values.numbers[c][i] : std::numeric_limits<double>::quiet_NaN());
    }
}

}  // namespace emca::query::detail
