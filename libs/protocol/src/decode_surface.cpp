#include "decoder.h"

namespace emca::protocol {

std::vector<Layer> decodeLayers(Decoder& d, const flatbuffers::Vector<flatbuffers::Offset<wire::Layer>>* layers,
                                bool everyKindMustBeKnown) {
    std::vector<Layer> result;
    if (!layers) return result;
    for (const wire::Layer* source : *layers) {
        if (source->kind() > static_cast<std::uint8_t>(LayerKind::density)) {
            if (everyKindMustBeKnown) d.fail("there is no kind of surface layer " + std::to_string(source->kind()));
            continue;
        }
        Layer& layer = result.emplace_back();
        layer.description.name = d.text(source->name());
        layer.description.kind = static_cast<LayerKind>(source->kind());
        layer.description.unit = d.text(source->unit());
        layer.description.description = d.text(source->description());
        layer.samples = source->samples();
        layer.total = source->total();
    }
    return result;
}

SurfaceCounts decodeCounts(Decoder& d, const wire::SurfaceCounts* counts) {
    const auto* c = d.aligned<wire::SurfaceCounts>(counts);
    if (!c) return {};
    return {c->points(), c->coarse(), c->invalid(), c->refused_divisions(), c->bytes_used(), c->budget_bytes()};
}

SurfaceResult decodeSurface(Decoder& d, const wire::SurfaceResult& m) {
    return {m.render_id(), decodeLayers(d, m.layers(), true), decodeCounts(d, m.counts()),
            m.mesh_count(), m.face_count(), m.topology_bytes()};
}

SurfaceChunk decodeSurface(Decoder& d, const wire::SurfaceChunk& m) {
    SurfaceChunk chunk;
    if (m.meshes()) {
        for (const wire::SurfaceMeshPart* part : *m.meshes()) {
            chunk.meshes.push_back({part->mesh(), part->triangle_count(), part->face_count(), part->byte_count(),
                                    part->first_byte(), d.view<std::uint8_t>(part->bits())});
        }
    }
    if (m.arrays()) {
        for (const wire::SurfaceArrayPart* part : *m.arrays()) {
            chunk.arrays.push_back({part->array(), part->first(), d.view<float>(part->values())});
        }
    }
    chunk.last = m.last();
    return chunk;
}

}  // namespace emca::protocol
