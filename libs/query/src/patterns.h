#pragma once

#include <re2/re2.h>

#include "emca/query/query.h"

namespace emca::query::detail {

/// Queries come over a network: what their regular expressions compile to is bounded, each and all of a query together.
constexpr int kPatternBytes = 1 << 20, kMaximumProgram = 20'000;

inline re2::RE2::Options patternOptions() {
    re2::RE2::Options options(re2::RE2::Quiet);
    options.set_max_mem(kPatternBytes);
    options.set_never_capture(true);
    return options;
}

}  // namespace emca::query::detail
