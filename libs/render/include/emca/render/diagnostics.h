#pragma once

#include <string>
#include <vector>

#include "emca/render/scene_node.h"

namespace emca::render {

/// Appends a diagnostic unless the same one is there already (a node with several references is read several times).
/// `message` is a sentence; its full stop is added if it is missing.
/// After kMaxDiagnostics one last entry says that there were more.
void addDiagnostic(std::vector<Diagnostic>& diagnostics, SourceLocation where, std::string message);

inline constexpr std::size_t kMaxDiagnostics = 1000;

}  // namespace emca::render
