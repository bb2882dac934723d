#include "encoder.h"

namespace emca::protocol {

wire::SurfaceCounts toWire(const SurfaceCounts& c) {
    return {c.points, c.coarse, c.invalid, c.refusedDivisions, c.bytesUsed, c.budgetBytes};
}

std::size_t encodedBytes(const std::vector<Layer>& layers) {
    std::size_t bytes = 0;
    for (const auto& [description, samples, total] : layers) {
        bytes += 128 + description.name.size() + description.unit.size() + description.description.size();
    }
    return bytes;
}

std::size_t encodedBytes(const SurfaceChunk& m) {
    std::size_t bytes = 256;
    for (const SurfaceMeshPart& part : m.meshes) bytes += 64 + part.bits.size();
    for (const SurfaceArrayPart& part : m.arrays) bytes += 64 + part.values.size() * sizeof(float);
    return bytes;
}

Offset<LayerList> encodeLayers(Builder& builder, const std::vector<Layer>& layers) {
    if (layers.empty()) return 0;
    std::vector<Offset<wire::Layer>> list;
    list.reserve(layers.size());
    for (const auto& [description, samples, total] : layers) {
        const auto name = text(builder, description.name), unit = text(builder, description.unit),
                   sentence = text(builder, description.description);
        list.push_back(wire::CreateLayer(builder, name, static_cast<std::uint8_t>(description.kind), unit, sentence,
                                         samples, total));
    }
    return builder.CreateVector(list);
}

Offset<wire::SurfaceResult> encodeSurface(Builder& builder, const SurfaceResult& m) {
    const auto layers = encodeLayers(builder, m.layers);
    const auto counts = toWire(m.counts);
    return wire::CreateSurfaceResult(builder, m.renderId, layers, &counts, m.meshCount, m.faceCount, m.topologyBytes);
}

Offset<wire::SurfaceChunk> encodeSurface(Builder& builder, const SurfaceChunk& m) {
    std::vector<Offset<wire::SurfaceMeshPart>> meshes;
    for (const SurfaceMeshPart& part : m.meshes) {
        const auto bits = column(builder, part.bits);
        meshes.push_back(wire::CreateSurfaceMeshPart(builder, part.mesh, part.triangleCount, part.faceCount,
                                                     part.byteCount, part.firstByte, bits));
    }
    std::vector<Offset<wire::SurfaceArrayPart>> arrays;
    for (const SurfaceArrayPart& part : m.arrays) {
        const auto values = column(builder, part.values);
        arrays.push_back(wire::CreateSurfaceArrayPart(builder, part.array, part.first, values));
    }
    const auto meshList = meshes.empty() ? 0 : builder.CreateVector(meshes);
    const auto arrayList = arrays.empty() ? 0 : builder.CreateVector(arrays);
    return wire::CreateSurfaceChunk(builder, meshList, arrayList, m.last);
}

}  // namespace emca::protocol
