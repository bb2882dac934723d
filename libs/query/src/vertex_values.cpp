#include "emca/query/vertex_values.h"

#include "check.h"
#include "evaluator.h"
#include "path_values.h"
#include "prepare.h"

namespace emca::query {

using namespace detail;

Result<PathValues> vertexValues(std::string_view expression, const PathSet& paths, const EvaluationLimits& limits, QueryError* where) {
    Node root;
    QueryError error;
    if (!parseExpression(expression, root, error) || !prepare(root, error) || !checkWithin(root, Domain::vertex, typesOf(paths), error)) {
        if (where) *where = error;
        return toError(expression, error);
    }
    if (root.type == Type::spectrum) return Error{ErrorCode::parseFailed, "The expression gives a spectrum: take an entry of it, such as [0]."};
    PathValues out;
    Evaluator evaluator(paths, root);
    out.missing = evaluator.missing();
    const bool wholePixels = detail::readsWholePixels(root);
    for (Index first = 0; first < paths.pathCount();) {
        if (limits.cancelled && limits.cancelled()) return Error{ErrorCode::cancelled, "The evaluation was cancelled."};
        const IndexRange range = nextChunk(paths, first, wholePixels);
        Chunk chunk(paths, range);
        if (temporaryBytes(root, chunk) > limits.temporaryBytes)
            return Error{ErrorCode::tooLarge, "The expression needs more than the " + std::to_string(limits.temporaryBytes >> 20) +
                                                  " MiB allowed for what it reads at once: trace fewer samples, or use a simpler one."};
        const Values values = evaluator.evaluateOn(root, Domain::vertex, chunk);
        append(values, chunk.size(Domain::vertex), values.type == Type::text ? &evaluator.texts() : nullptr, out);
        first = range.last;
    }
    setType(root.type, root.components, out);
    return out;
}

}  // namespace emca::query
