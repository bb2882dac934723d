#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "emca/core/pixel.h"
#include "emca/core/value.h"

namespace emca::doctor {

/// How a check ended; ascending, so that the worst of several is the largest.
enum class Outcome : std::uint8_t {
    ok = 0,
    skipped = 1,  ///< nothing to check: the renderer does not offer it, or it was not asked for
    warning = 2,  ///< usable, but a person should know
    failed = 3,   ///< what views show would be wrong
};
/// "ok", "skipped", "warning", "failed".
const char* name(Outcome outcome);

/// A number behind a sentence, for scripts.
struct Figure {
    std::string name;  ///< camelCase, unique in its finding
    Value value;
};

/// A pixel that one should look at.
struct SuspectPixel {
    Pixel pixel;
    std::string why;  ///< short: "rendered (0.1, 0.2, 0.3), replayed (0.1, 0.2, 0.4)"
};

/// What one check found. A plain value.
struct Finding {
    std::string check;     ///< one of checkNames()
    Outcome outcome = Outcome::ok;
    std::string sentence;  ///< what was found, with figures; one or more sentences
    std::string advice;    ///< what to do; empty if there is nothing to do
    std::vector<Figure> figures;
    std::vector<SuspectPixel> pixels;  ///< worst first

    /// Adds a sentence. The outcome becomes the worse of the two; the same advice is given once.
    void complain(Outcome worse, const std::string& what, const std::string& whatToDo);
    void add(std::string figure, Value value) { figures.push_back({std::move(figure), std::move(value)}); }
    void count(std::string figure, std::uint64_t value) { add(std::move(figure), static_cast<std::int64_t>(value)); }
    /// The value of a figure, or null.
    const Value* find(std::string_view figure) const;
};

}  // namespace emca::doctor
