#include "encoder.h"

namespace emca::protocol {

namespace {

template <typename T>
std::size_t bytesOf(const SharedArray<T>& array) { return array.size() * sizeof(T) + 16; }

Offset<wire::Column> encodeColumn(Builder& builder, const Column& source) {
    const auto name = text(builder, source.name);
    const auto owners = column(builder, source.owners);
    const auto bytes = column(builder, source.bytes, 8);  // doubles and 64-bit integers are read in place
    const auto spectrumOffsets = column(builder, source.spectrumOffsets);
    const auto locations = column(builder, source.locations);
    return wire::CreateColumn(builder, name, static_cast<std::uint8_t>(source.scope),
                              static_cast<std::uint8_t>(source.type), source.count, owners, bytes, spectrumOffsets,
                              locations);
}

}  // namespace

std::size_t encodedBytes(const PathColumns& c) {
    std::size_t bytes = 1024;
    bytes += bytesOf(c.pixels) + bytesOf(c.samples) + bytesOf(c.parts) + bytesOf(c.pathFlags) + bytesOf(c.origins) +
             bytesOf(c.estimates) + bytesOf(c.firstVertex);
    bytes += bytesOf(c.depths) + bytesOf(c.vertexFlags) + bytesOf(c.positions) + bytesOf(c.vertexEstimates) +
             bytesOf(c.emissions) + bytesOf(c.meshes) + bytesOf(c.faces) + bytesOf(c.events) + bytesOf(c.lobes) +
             bytesOf(c.labels);
    bytes += bytesOf(c.nextEventOwners) + bytesOf(c.nextEvents) + bytesOf(c.contributionOwners) +
             bytesOf(c.contributions) + bytesOf(c.splatOwners) + bytesOf(c.splats);
    for (const Column& user : c.columns) {
        bytes += user.name.size() + 128 + bytesOf(user.owners) + bytesOf(user.bytes) + bytesOf(user.spectrumOffsets) +
                 bytesOf(user.locations);
    }
    for (const std::string& string : c.strings) bytes += string.size() + 16;
    return bytes;
}

Offset<wire::Paths> encodePaths(Builder& builder, const PathColumns& c) {
    std::vector<Offset<wire::Column>> columns;
    columns.reserve(c.columns.size());
    for (const Column& user : c.columns) columns.push_back(encodeColumn(builder, user));
    const auto columnList = columns.empty() ? 0 : builder.CreateVector(columns);
    const auto strings = texts(builder, c.strings);

    const auto pixels = column(builder, c.pixels);
    const auto samples = column(builder, c.samples);
    const auto parts = column(builder, c.parts);
    const auto pathFlags = column(builder, c.pathFlags);
    const auto origins = column(builder, c.origins);
    const auto estimates = column(builder, c.estimates);
    const auto firstVertex = column(builder, c.firstVertex);
    const auto depths = column(builder, c.depths);
    const auto vertexFlags = column(builder, c.vertexFlags);
    const auto positions = column(builder, c.positions);
    const auto vertexEstimates = column(builder, c.vertexEstimates);
    const auto emissions = column(builder, c.emissions);
    const auto meshes = column(builder, c.meshes);
    const auto faces = column(builder, c.faces);
    const auto events = column(builder, c.events);
    const auto lobes = column(builder, c.lobes);
    const auto labels = column(builder, c.labels);
    const auto nextEventOwners = column(builder, c.nextEventOwners);
    const auto nextEvents = column(builder, c.nextEvents);
    const auto contributionOwners = column(builder, c.contributionOwners);
    const auto contributions = column(builder, c.contributions);
    const auto splatOwners = column(builder, c.splatOwners);
    const auto splats = column(builder, c.splats);
    return wire::CreatePaths(builder, pixels, samples, parts, pathFlags, origins, estimates, firstVertex, depths,
                             vertexFlags, positions, vertexEstimates, emissions, meshes, faces, events, lobes, labels,
                             nextEventOwners, nextEvents, contributionOwners, contributions, splatOwners, splats,
                             columnList, strings);
}

}  // namespace emca::protocol
