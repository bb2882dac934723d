#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <mutex>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "emca/core/path_set.h"
#include "syntax.h"

namespace re2 {
class RE2;
}

namespace emca::query::detail {

/// Truth after Kleene.
enum Truth : std::uint8_t { kFalse = 0, kTrue = 1, kUnknown = 2 };

/// A light path expression in Heckbert's and OSL's notation. Every event of a path, and each of its ends, is one byte, so
/// that RE2 decides in linear time.
///
///     C        the camera; every path begins with it
///     D G S s  scattering that is diffuse, glossy, specular, straight; short for <.D> and so on
///     R T V    reflection, transmission, scattering in a medium
///     <RD>     both; <RD'glass'> also the label of the vertex; a dot for anything: <.S>, <T.'glass'>
///     L O B    the end: any light; an emitting surface that the walk hit; the environment that it reached
///     .        anything; [DG] one of these; [^S] anything else; ( | ) * + ? {2} {2,} {2,4} as usual
class LightPathExpression {
  public:
    /// Null: `error` says what is wrong; `begin` is where the expression begins in the query.
    static std::shared_ptr<const LightPathExpression> parse(std::string_view text, std::uint32_t begin, QueryError& error);
    ~LightPathExpression();

    /// Texts of labels that it names; label i has class i + 1, every other one 0.
    const std::vector<std::string>& labels() const { return labels_; }
    /// The byte of an event; 0 if it was not recorded, or ends the walk.
    char symbol(Event event, Lobe lobe, std::size_t labelClass) const;
    /// \param path  "C" (kCamera), symbols, and one end.
    bool matches(std::string_view path) const;
    /// Instructions that it compiles to: what it costs.
    int programSize() const;

    /// Symbols are below this.
    std::size_t symbolCount() const;
    static constexpr char kCamera = 1, kLight = 2, kSurface = 3, kEnvironment = 4;
    static constexpr std::size_t kMaximumLabels = 15, kMaximumLength = 4096;

    /// Ways that begin alike share their nodes; a node knows for each end whether the way to it matches.
    struct Ways {
        struct Node { std::array<std::uint8_t, 3> matches{kUnknown, kUnknown, kUnknown}; };
        std::vector<Node> nodes;
        std::vector<std::uint32_t> next;  ///< per node and symbol: the node after it; 0 if not seen yet
    };
    /// What was found out about ways on earlier sets, to go on with: an image is evaluated set by set, and most ways occur
    /// in each. Empty if there is none left. From any thread.
    Ways takeWays() const;
    /// Kept for the next one, unless it grew large.
    void giveBack(Ways ways) const;

  private:
    LightPathExpression() = default;
    mutable std::mutex waysMutex_;  // taken twice per set
    mutable std::vector<Ways> ways_;
    std::unique_ptr<re2::RE2> expression_;
    std::vector<std::string> labels_;
};

/// Matches the paths of one set; remembers what it has seen. For one thread.
class LightPathMatcher {
  public:
    LightPathMatcher(const LightPathExpression& expression, const PathSet& paths);
    ~LightPathMatcher() { expression_.giveBack({std::move(nodes_), std::move(next_)}); }
    LightPathMatcher(const LightPathMatcher&) = delete;
    /// True if any contribution's way from the camera and its end match; where the set has no contributions, the walk.
    Truth matches(Index path);

    /// Each contribution is a way of its own, so that a long walk costs its length squared: beyond, unknown.
    static constexpr std::size_t kMaximumWay = 4096;

  private:
    using Node = LightPathExpression::Ways::Node;
    static constexpr std::size_t kMaximumEntries = 1 << 22;

    Truth contributionsMatch(Index path);
    Truth walkMatches();
    Truth wayOf(std::size_t i, bool hit);
    Truth wayMatches(std::size_t first, std::size_t last, char end);
    bool enter(Index vertex, std::size_t place);
    void readWalk(Index path);
    std::size_t symbolPlace(Event event, Lobe lobe, std::size_t label) const;
    std::size_t placeOf(Index vertex) const;
    std::uint32_t follow(std::uint32_t node, char symbol);
    void forget();
    char endAt(Index vertex) const;
    Event eventOf(Index vertex) const;
    bool emits(Index vertex) const;
    bool isHit(Index vertex, LightEnd said) const;

    const LightPathExpression& expression_;
    const PathSet& paths_;
    std::vector<std::uint8_t> labelClasses_;  ///< per string of the set; empty if the expression names none
    std::vector<char> symbols_;               ///< of every event, lobe and class of label
    bool hasContributions_ = false;
    std::size_t at_ = 0;                      ///< in the list of contributions
    std::string walk_;                        ///< of the path at hand: a symbol per vertex, in order from the camera
    std::vector<Index> vertices_;             ///< the vertex of each symbol
    bool fromLight_ = false;                  ///< a light path: no vertex is on the camera's subpath
    std::size_t unrecorded_ = 0;              ///< place of the first symbol that was not recorded
    std::size_t recorded_ = 0;                ///< how many symbols come before the first that was not recorded
    std::vector<std::uint32_t> reached_;      ///< the node of each prefix of the walk that was asked for
    std::string text_;
    std::vector<Node> nodes_;
    std::size_t width_;                       ///< how many symbols there are
    std::vector<std::uint32_t> next_;         ///< with nodes_: LightPathExpression::Ways
};

}  // namespace emca::query::detail
