#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <unordered_map>
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

    static constexpr char kCamera = 1, kLight = 2, kSurface = 3, kEnvironment = 4;
    static constexpr std::size_t kMaximumLabels = 15;

  private:
    LightPathExpression() = default;
    std::unique_ptr<re2::RE2> expression_;
    std::vector<std::string> labels_;
};

/// Matches the paths of one set; remembers what it has seen. For one thread.
class LightPathMatcher {
  public:
    LightPathMatcher(const LightPathExpression& expression, const PathSet& paths);
    /// True if any contribution's way from the camera and its end match; where the set has no contributions, the walk.
    Truth matches(Index path);

  private:
    Truth contributionsMatch(Index path);
    Truth walkMatches();
    /// Of a prefix of the walk: the first `length` symbols.
    Truth prefixMatches(std::size_t length, char end);
    void readWalk(Index path);
    char endAt(Index vertex) const;
    bool emits(Index vertex) const;

    const LightPathExpression& expression_;
    const PathSet& paths_;
    std::vector<std::uint8_t> labelClasses_;  ///< per string of the set
    bool hasContributions_ = false;
    std::string walk_;                        ///< of the path at hand: kCamera, then a symbol per vertex
    std::vector<Index> walkVertices_;         ///< the vertex of each symbol, in the order of the walk from the camera
    std::unordered_map<std::string, bool> seen_;
};

}  // namespace emca::query::detail
