#include <memory>
#include <utility>

#include "emca/protocol/session.h"
#include "encoder.h"
#include "session_generated.h"

namespace emca::protocol::saved {

namespace {

namespace file = emca::sessionfile;
using Encoded = std::pair<file::Item, Offset<void>>;

wire::Pixel toWire(Pixel p) { return {p.x, p.y}; }
file::PathId toFile(const PathId& id) { return {toWire(id.pixel), id.sample, id.part}; }
file::VertexId toFile(const VertexId& id) { return {toFile(id.path), id.depth, id.subpath}; }

Encoded encodeItem(Builder& b, const Head& item) {
    std::vector<Offset<file::PlannedPart>> parts;
    parts.reserve(item.parts.size());
    for (const PlannedPart& part : item.parts) {
        const auto title = text(b, part.title);
        parts.push_back(file::CreatePlannedPart(b, part.kind, title));
    }
    const auto list = b.CreateVector(parts);
    const auto software = text(b, item.software);
    return {file::Item::Head, file::CreateHead(b, software, item.saved, list).Union()};
}

Encoded encodeItem(Builder& b, const Notes& item) {
    std::vector<Offset<file::PixelNote>> pixels;
    for (const PixelNote& note : item.pixels) {
        const auto sentence = text(b, note.text);
        const auto pixel = toWire(note.pixel);
        pixels.push_back(file::CreatePixelNote(b, &pixel, sentence));
    }
    const auto list = pixels.empty() ? 0 : b.CreateVector(pixels);
    const auto whole = text(b, item.text);
    return {file::Item::Notes, file::CreateNotes(b, whole, list).Union()};
}

Encoded encodeItem(Builder& b, const Selection& item) {
    std::vector<file::PathId> paths;
    paths.reserve(item.paths.size());
    for (const PathId& path : item.paths) paths.push_back(toFile(path));
    const auto list = paths.empty() ? 0 : b.CreateVectorOfStructs(paths);
    const auto region = item.region.empty() ? 0 : b.CreateVectorOfStructs<wire::Pixel>(item.region.size(), [&](std::size_t i, wire::Pixel* out) {
        *out = toWire(item.region[i]);
    });
    const auto pixel = toWire(item.pixel.value_or(Pixel{}));
    const auto current = toFile(item.currentPath.value_or(PathId{}));
    const auto vertex = toFile(item.vertex.value_or(VertexId{}));
    return {file::Item::Selection, file::CreateSelection(b, item.pixel ? &pixel : nullptr, list, item.currentPath ? &current : nullptr,
                                                         item.vertex ? &vertex : nullptr, region).Union()};
}

Offset<file::Plane> encodePlane(Builder& b, const Plane& plane) {
    const auto channels = texts(b, plane.channels);
    return file::CreatePlane(b, plane.width, plane.height, channels);
}

Encoded encodeItem(Builder& b, const Image& item) {
    const auto title = text(b, item.title), integrator = text(b, item.settings.integrator), sampler = text(b, item.settings.sampler);
    const auto settings = wire::CreateSettings(b, item.settings.samplesPerPixel, integrator, sampler, item.settings.seed, item.settings.hasSeed);
    const auto color = encodePlane(b, item.planes[0]), samples = encodePlane(b, item.planes[1]), variance = encodePlane(b, item.planes[2]);
    return {file::Item::Image,
            file::CreateImage(b, title, item.renderId, settings, item.preview, item.current, color, samples, variance).Union()};
}

Encoded encodeItem(Builder& b, const Rows& item) {
    const auto values = column(b, item.values);
    return {file::Item::Rows, file::CreateRows(b, item.plane, item.firstRow, item.rowCount, values).Union()};
}

Encoded encodeItem(Builder& b, const Trace& item) {
    return {file::Item::Trace, file::CreateTrace(b, item.totalSeconds, item.shown).Union()};
}

Encoded encodeItem(Builder& b, const Filter& item) {
    std::vector<Offset<file::FilterRule>> rules;
    for (const FilterRule& rule : item.rules) {
        const auto quantity = text(b, rule.quantity), value = text(b, rule.value);
        rules.push_back(file::CreateFilterRule(b, quantity, rule.over, rule.operation, value));
    }
    const auto list = rules.empty() ? 0 : b.CreateVector(rules);
    const auto query = text(b, item.query);
    return {file::Item::Filter, file::CreateFilter(b, query, list, item.byHand, item.automatic).Union()};
}

Encoded encodeItem(Builder& b, const View& item) {
    std::vector<Offset<file::ViewOption>> options;
    for (const ViewOption& option : item.options) {
        const auto name = text(b, option.name), value = text(b, option.value);
        options.push_back(file::CreateViewOption(b, name, value));
    }
    const auto list = options.empty() ? 0 : b.CreateVector(options);
    const auto paths = item.paths.empty() ? 0 : b.CreateVectorOfStructs<file::PathRays>(item.paths.size(), [&](std::size_t i, file::PathRays* out) {
        *out = file::PathRays(toFile(item.paths[i].path), item.paths[i].line, item.paths[i].nextEvents);
    });
    const auto vertices = item.vertices.empty() ? 0 : b.CreateVectorOfStructs<file::VertexRays>(item.vertices.size(), [&](std::size_t i, file::VertexRays* out) {
        const VertexRays& rays = item.vertices[i];
        *out = file::VertexRays(toFile(rays.vertex), rays.incoming, rays.outgoing, rays.nextEvents);
    });
    return {file::Item::View, file::CreateView(b, item.reference, list, paths, vertices).Union()};
}

Encoded encodeItem(Builder&, const Unknown&) { return {file::Item::NONE, 0}; }

// Upper bounds, so that nothing beyond what a frame may have is built.
std::size_t sizeHint(const Head& item) {
    std::size_t bytes = 1024 + item.software.size();
    for (const PlannedPart& part : item.parts) bytes += 64 + part.title.size();
    return bytes;
}
std::size_t sizeHint(const Notes& item) {
    std::size_t bytes = 1024 + item.text.size();
    for (const PixelNote& note : item.pixels) bytes += 64 + note.text.size();
    return bytes;
}
std::size_t sizeHint(const Selection& item) { return 1024 + item.paths.size() * sizeof(file::PathId) + item.region.size() * sizeof(wire::Pixel); }
std::size_t sizeHint(const Filter& item) {
    std::size_t bytes = 1024 + item.query.size();
    for (const FilterRule& rule : item.rules) bytes += 96 + rule.quantity.size() + rule.value.size();
    return bytes;
}
std::size_t sizeHint(const View& item) {
    std::size_t bytes = 1024 + item.paths.size() * sizeof(file::PathRays) + item.vertices.size() * sizeof(file::VertexRays);
    for (const ViewOption& option : item.options) bytes += 64 + option.name.size() + option.value.size();
    return bytes;
}
std::size_t sizeHint(const Rows& item) { return 1024 + item.values.size() * sizeof(float); }
template <typename T>
std::size_t sizeHint(const T&) { return 4096; }

}  // namespace

Result<Frame> encode(const Item& item) {
    const std::size_t hint = std::visit([](const auto& i) { return sizeHint(i); }, item);
    if (hint > kMaximumReplyBytes) {
        return Error{ErrorCode::tooLarge, "A part of a session would have " + std::to_string(hint) + " bytes; one part can have " +
                                              std::to_string(kMaximumReplyBytes) + "."};
    }
    if (std::holds_alternative<Unknown>(item)) {
        return Error{ErrorCode::invalidArgument, "A part of a kind that this version does not know cannot be saved."};
    }
    Builder builder(hint);
    const auto [kind, offset] = std::visit([&](const auto& i) { return encodeItem(builder, i); }, item);
    builder.Finish(file::CreateSaved(builder, kind, offset), file::SavedIdentifier());
    auto buffer = std::make_shared<flatbuffers::DetachedBuffer>(builder.Release());
    const auto* data = reinterpret_cast<const std::byte*>(buffer->data());
    const std::size_t size = buffer->size();
    return Frame(std::move(buffer), data, size);
}

}  // namespace emca::protocol::saved
