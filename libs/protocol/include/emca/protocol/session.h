#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "emca/core/pixel.h"
#include "emca/core/result.h"
#include "emca/core/shared_array.h"
#include "emca/protocol/frame.h"
#include "emca/protocol/messages.h"

/// What a session file holds besides messages of the wire (docs/sessions.md): frames of their own kind, with the file
/// identifier "EMCS". They never travel.
namespace emca::protocol::saved {

enum class PartKind : std::uint8_t {
    notes = 1, selection = 2, info = 3, camera = 4, image = 5, trace = 6, scene = 7, surface = 8, filter = 9, view = 10,
};

/// Something that was saved, announced at the begin of the file, so that a file that was cut can say what is missing.
struct PlannedPart {
    std::uint8_t kind = 0;                           ///< PartKind, or a number of a later version
    std::string title;                               ///< for people; of images and traces
};
struct Head {
    std::string software;                            ///< product and version that saved it
    std::uint64_t saved = 0;                         ///< when: seconds since 1970, UTC
    std::vector<PlannedPart> parts;                  ///< part i of the file is entry i - 1; the head itself is part 0
};

struct PixelNote {
    Pixel pixel;
    std::string text;
};
struct Notes {
    std::string text;                                ///< about the whole session
    std::vector<PixelNote> pixels;
};

struct PathId {
    Pixel pixel;
    std::int64_t sample = 0;
    std::int32_t part = 0;
};
struct VertexId {
    PathId path;
    std::int32_t depth = 0;
    std::uint8_t subpath = 0;
};
struct Selection {
    std::optional<Pixel> pixel;
    std::vector<PathId> paths;
    std::optional<PathId> currentPath;
    std::optional<VertexId> vertex;
    std::vector<Pixel> region;                       ///< pixels looked at together; empty if there is one or none
};

/// One of the three images of a render; empty if its width is 0.
struct Plane {
    std::uint32_t width = 0, height = 0;
    std::vector<std::string> channels;
};
inline constexpr std::size_t kPlanes = 3;            ///< colour, samples, variance: in this order
/// Announces an image; its Rows follow.
struct Image {
    std::string title;
    std::uint64_t renderId = 0;
    Settings settings;
    bool preview = false, current = false;
    Plane planes[kPlanes];
};
struct Rows {
    std::uint8_t plane = 0;
    std::uint32_t firstRow = 0, rowCount = 0;
    SharedArray<float> values;                       ///< all channels of a pixel, pixel by pixel, row by row
};

/// Comes before a TraceResult and says what that does not.
struct Trace {
    double totalSeconds = 0;
    std::uint32_t shown = 0;                         ///< position among the traces that views show, from 1; 0: not shown
};

/// What a person asked of the paths.
struct FilterRule {
    std::string quantity;
    std::uint8_t over = 0, operation = 0;            ///< query::Quantifier, query::RuleOperator
    std::string value;
};
struct Filter {
    std::string query;
    std::vector<FilterRule> rules;
    bool byHand = false;                             ///< the query was edited: it is not what the rules say
    bool automatic = false;                          ///< applied to each new pixel
};

/// How the session was looked at.
struct ViewOption { std::string name, value; };
/// What is drawn of single paths and vertices.
struct PathRays {
    PathId path;
    bool line = true, nextEvents = true;
};
struct VertexRays {
    VertexId vertex;
    bool incoming = true, outgoing = true, nextEvents = true;
};
struct View {
    std::uint32_t reference = 0;                     ///< number of an image of the file, from 1; 0: none
    std::vector<ViewOption> options;
    std::vector<PathRays> paths;
    std::vector<VertexRays> vertices;
};

/// Of a kind that only later versions know. Cannot be saved.
struct Unknown { std::uint8_t kind = 0; };

using Item = std::variant<Head, Notes, Selection, Image, Rows, Trace, Filter, View, Unknown>;

/// Errors: tooLarge, invalidArgument (Unknown).
Result<Frame> encode(const Item& item);
/// Verifies the whole frame before it is used; any bytes are safe to pass. Rows look into the frame and keep it alive.
/// Errors: protocolViolation.
Result<Item> decode(const Frame& frame);

}  // namespace emca::protocol::saved
