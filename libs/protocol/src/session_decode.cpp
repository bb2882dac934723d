#include <algorithm>
#include <cstring>
#include <limits>
#include <utility>

#include "decoder.h"
#include "emca/protocol/session.h"
#include "session_generated.h"

namespace emca::protocol::saved {

namespace {

namespace file = emca::sessionfile;

Error violation(const std::string& what) {
    return {ErrorCode::protocolViolation, "A part of a session is not valid: " + what + "."};
}

Pixel fromWire(const wire::Pixel& p) { return {p.x(), p.y()}; }
PathId fromFile(const file::PathId& id) { return {fromWire(id.pixel()), id.sample(), id.part()}; }
VertexId fromFile(Decoder& d, const file::VertexId& id) {
    if (id.subpath() > static_cast<std::uint8_t>(Subpath::light)) d.fail("there is no such subpath");
    return {fromFile(id.path()), id.depth(), id.subpath()};
}

Head decodeItem(Decoder& d, const file::Head& item) {
    Head head{d.text(item.software()), item.saved(), {}};
    if (!item.parts()) return head;
    for (const file::PlannedPart* part : *item.parts()) head.parts.push_back({part->kind(), d.text(part->title())});
    return head;
}

Notes decodeItem(Decoder& d, const file::Notes& item) {
    Notes notes{d.text(item.text()), {}};
    if (!item.pixels()) return notes;
    for (const file::PixelNote* note : *item.pixels()) {
        notes.pixels.push_back({note->pixel() ? fromWire(*note->pixel()) : Pixel{}, d.text(note->text())});
    }
    return notes;
}

Selection decodeItem(Decoder& d, const file::Selection& item) {
    Selection selection;
    if (item.pixel()) selection.pixel = fromWire(*item.pixel());
    if (const auto* list = item.paths(); list && list->size() > 0) {
        const auto* paths = d.aligned<file::PathId>(list->Data());
        for (std::uint32_t i = 0; paths && i < list->size(); ++i) selection.paths.push_back(fromFile(paths[i]));
    }
    if (const auto* list = item.region(); list && list->size() > 0) {
        const auto* pixels = d.aligned<wire::Pixel>(list->Data());
        for (std::uint32_t i = 0; pixels && i < list->size(); ++i) {
            selection.region.push_back(fromWire(pixels[i]));
            // Behind the last pixel there is always another number.
            if (std::max(pixels[i].x(), pixels[i].y()) == std::numeric_limits<std::uint32_t>::max()) d.fail("there is no such pixel");
        }
    }
    if (const auto* path = d.aligned<file::PathId>(item.current_path())) selection.currentPath = fromFile(*path);
    if (const auto* v = d.aligned<file::VertexId>(item.vertex())) selection.vertex = fromFile(d, *v);
    return selection;
}

Plane decodePlane(Decoder& d, const file::Plane* plane) {
    if (!plane) return {};
    return {plane->width(), plane->height(), d.texts(plane->channels())};
}

Image decodeItem(Decoder& d, const file::Image& item) {
    Image image;
    image.title = d.text(item.title());
    image.renderId = item.render_id();
    if (const auto* s = item.settings()) {
        image.settings = {s->samples_per_pixel(), d.text(s->integrator()), d.text(s->sampler()), s->seed(), s->has_seed()};
    }
    image.preview = item.preview();
    image.current = item.current();
    image.planes[0] = decodePlane(d, item.color());
    image.planes[1] = decodePlane(d, item.samples());
    image.planes[2] = decodePlane(d, item.variance());
    return image;
}

Rows decodeItem(Decoder& d, const file::Rows& item) {
    if (item.plane() >= kPlanes) d.fail("rows belong to no image");
    return {item.plane(), item.first_row(), item.row_count(), d.view<float>(item.values())};
}

Trace decodeItem(Decoder&, const file::Trace& item) { return {item.total_seconds(), item.shown()}; }

Filter decodeItem(Decoder& d, const file::Filter& item) {
    Filter filter{d.text(item.query()), {}, item.by_hand(), item.automatic()};
    if (!item.rules()) return filter;
    for (const file::FilterRule* rule : *item.rules())
        filter.rules.push_back({d.text(rule->quantity()), rule->over(), rule->operation(), d.text(rule->value())});
    return filter;
}

View decodeItem(Decoder& d, const file::View& item) {
    View view;
    view.reference = item.reference();
    if (item.options())
        for (const file::ViewOption* option : *item.options()) view.options.push_back({d.text(option->name()), d.text(option->value())});
    if (const auto* list = item.paths(); list && list->size() > 0) {
        const auto* paths = d.aligned<file::PathRays>(list->Data());
        for (std::uint32_t i = 0; paths && i < list->size(); ++i) view.paths.push_back({fromFile(paths[i].path()), paths[i].line(), paths[i].next_events()});
    }
    if (const auto* list = item.vertices(); list && list->size() > 0) {
        const auto* vertices = d.aligned<file::VertexRays>(list->Data());
        for (std::uint32_t i = 0; vertices && i < list->size(); ++i)
            view.vertices.push_back({fromFile(d, vertices[i].vertex()), vertices[i].incoming(), vertices[i].outgoing(), vertices[i].next_events()});
    }
    return view;
}

template <typename Table>
bool decodeAs(Decoder& d, const file::Saved& root, Item& item) {
    if (root.item_type() != file::ItemTraits<Table>::enum_value) return false;
    item = decodeItem(d, *root.item_as<Table>());
    return true;
}
template <typename... Tables>
bool decodeAny(Decoder& d, const file::Saved& root, Item& item) {
    return (decodeAs<Tables>(d, root, item) || ...);
}

}  // namespace

Result<Item> decode(const Frame& frame) {
    if (frame.size() < 8 || frame.size() > kMaximumReplyBytes) return violation("it has " + std::to_string(frame.size()) + " bytes");
    if (reinterpret_cast<std::uintptr_t>(frame.data()) % 8 != 0) {
        auto copy = allocatePayload(frame.size());
        if (!copy) return copy.error();
        std::memcpy(copy->get(), frame.data(), frame.size());
        const std::byte* bytes = copy->get();
        return decode(Frame(std::move(copy).value(), bytes, frame.size()));
    }
    const auto* data = reinterpret_cast<const std::uint8_t*>(frame.data());
    if (!file::SavedBufferHasIdentifier(data)) return violation("it does not say \"EMCS\"");
    // The plan names every part, each in a table of its own.
    flatbuffers::Verifier verifier(data, frame.size(), 16, 1u << 22);
    if (!file::VerifySavedBuffer(verifier)) return violation("it is damaged or cut");
    const file::Saved& root = *file::GetSaved(data);
    if (!root.item()) return violation("it has no content");
    Decoder decoder(frame);
    Item item;
    const bool known = decodeAny<file::Head, file::Notes, file::Selection, file::Image, file::Rows, file::Trace, file::Filter, file::View>(decoder, root, item);
    if (!known) item = Unknown{static_cast<std::uint8_t>(root.item_type())};
    if (decoder.failed()) return violation(decoder.fault());
    return item;
}

}  // namespace emca::protocol::saved
