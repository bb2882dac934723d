#include "emca/render/diagnostics.h"

#include <algorithm>

namespace emca::render {

void addDiagnostic(std::vector<Diagnostic>& diagnostics, SourceLocation where, std::string message) {
    if (diagnostics.size() > kMaxDiagnostics)
        return;
    if (!message.ends_with('.'))
        message += '.';
    const bool known = std::any_of(diagnostics.begin(), diagnostics.end(), [&](const Diagnostic& d) {
        return d.where.line == where.line && d.message == message && d.where.file == where.file;
    });
    if (known)
        return;
    if (diagnostics.size() == kMaxDiagnostics)
        message = "there is more to say about this scene than " + std::to_string(kMaxDiagnostics) + " remarks; the rest is left out.";
    diagnostics.push_back({std::move(where), std::move(message)});
}

}  // namespace emca::render
