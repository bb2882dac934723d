#pragma once

#include <string>

#include "emca/client/connection.h"

namespace emca::cli {

/// What `emca pixel` prints for a person: the verdict, then the paths. \param trace  of one pixel
/// \param limit  at most so many paths, the brightest ones; 0: all, in their order
std::string pixelReport(const client::Trace& trace, const std::string& scene, std::size_t limit);

/// How a path went, in the letters of light path expressions: "RD TS O" is a diffuse reflection, a specular
/// transmission and a light that was hit; "·" is a vertex without event. Empty if no vertex has one.
std::string eventLetters(const PathSet& paths, Index path);

}  // namespace emca::cli
