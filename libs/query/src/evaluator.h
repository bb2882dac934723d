#pragma once

#include <memory>
#include <string>
#include <unordered_map>
#include <vector>

#include "chunk.h"
#include "texts.h"
#include "values.h"

namespace re2 {
class RE2;
}

namespace emca::query::detail {

/// Evaluates a checked tree on chunks of one set, column by column. For one thread.
class Evaluator {
  public:
    /// The tree must outlive the evaluator.
    Evaluator(const PathSet& paths, const Node& root);
    ~Evaluator();

    /// One value per element of the node's domain.
    Values evaluate(const Node& node, Chunk& chunk);
    /// The same, one value per element of `domain`, which the node's own encloses.
    Values evaluateOn(const Node& node, Domain domain, Chunk& chunk);
    /// Names of user data that the tree reads and the set does not have.
    std::vector<std::string> missing() const;
    const Texts& texts();

  private:
    Values core(const Node& node, Chunk& chunk);
    Values user(const Node& node, Chunk& chunk);
    Values lightPath(const Node& node, Chunk& chunk);
    Values operation(const Node& node, Chunk& chunk);
    Values reduction(const Node& node, Chunk& chunk);
    Values recorded(const Node& node, Chunk& chunk);
    Values textOperation(const Node& node, const std::vector<Values>& values, std::size_t size);
    Values literalText(const std::string& text);
    Texts& allTexts();
    /// Of a sparse or text core column: see evaluate_core.cpp.
    Values coreTexts(const Node& node, Chunk& chunk);

    const PathSet& paths_;
    const Node& root_;
    std::unique_ptr<Texts> texts_;                       ///< made when a text is first read
    std::unordered_map<const Node*, std::unique_ptr<LightPathMatcher>> matchers_;
    std::unordered_map<const Node*, std::vector<std::uint8_t>> textTests_;  ///< per node and text: unknown until asked
    std::unordered_map<const Node*, std::unique_ptr<re2::RE2>> patterns_;
    std::unordered_map<const Node*, std::vector<const Column*>> columns_;
};

/// Element by element, for operations that know neither texts nor spectra (operations.cpp).
Values combine(const Node& node, std::vector<Values>& values, std::size_t size);
/// One value per element of the reduction's domain (reductions.cpp). `value` and `condition` have one per element of the
/// argument's domain, whose elements [firsts[i], firsts[i + 1]) belong to element i; no condition: null.
Values reduce(const Node& node, const Values& value, const Values* condition, const std::vector<Index>& firsts);

/// The columns from which user data of one type are read.
std::vector<const Column*> columnsOfType(const PathSet& paths, const Node& node);

}  // namespace emca::query::detail
