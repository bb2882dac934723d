#pragma once

#include <span>
#include <string>
#include <vector>

#include "emca/protocol/messages.h"
#include "wire.h"

namespace emca::protocol {

using Builder = flatbuffers::FlatBufferBuilder;
template <typename T> using Offset = flatbuffers::Offset<T>;
template <typename T> using WireVector = flatbuffers::Vector<std::conditional_t<std::is_class_v<T>, const T*, T>>;

/// One column with one memcpy; empty ones take no space. \param alignment  of its first value
template <typename Core>
Offset<WireVector<Wire<Core>>> column(Builder& builder, std::span<const Core> values,
                                      std::size_t alignment = alignof(Core)) {
    if (values.empty()) return 0;
    // FlatBuffers takes the size of an element for its alignment, which would spoil that of the whole message where a
    // size is no power of two (a colour has 12 bytes): so it is told of as many elements of the alignment's size.
    constexpr std::size_t kUnit = alignof(Core);
    builder.ForceVectorAlignment(values.size(), sizeof(Core), alignment);
    builder.StartVector(values.size_bytes() / kUnit, kUnit);
    builder.PushBytes(reinterpret_cast<const std::uint8_t*>(values.data()), values.size_bytes());
    return builder.EndVector(values.size());
}
template <typename Core>
Offset<WireVector<Wire<Core>>> column(Builder& builder, const SharedArray<Core>& values,
                                      std::size_t alignment = alignof(Core)) {
    return column(builder, values.span(), alignment);
}

inline Offset<flatbuffers::String> text(Builder& builder, const std::string& value) {
    return value.empty() ? Offset<flatbuffers::String>(0) : builder.CreateString(value);
}
inline Offset<flatbuffers::Vector<Offset<flatbuffers::String>>> texts(Builder& builder, const std::vector<std::string>& values) {
    if (values.empty()) return 0;
    return builder.CreateVectorOfStrings(values);
}

using LayerList = flatbuffers::Vector<Offset<wire::Layer>>;
Offset<LayerList> encodeLayers(Builder& builder, const std::vector<Layer>& layers);
wire::SurfaceCounts toWire(const SurfaceCounts& counts);
Offset<wire::SurfaceResult> encodeSurface(Builder& builder, const SurfaceResult& message);
Offset<wire::SurfaceChunk> encodeSurface(Builder& builder, const SurfaceChunk& message);
std::size_t encodedBytes(const std::vector<Layer>& layers);
std::size_t encodedBytes(const SurfaceChunk& message);

Offset<wire::Paths> encodePaths(Builder& builder, const PathColumns& columns);
/// Upper bound of what encodePaths adds, so that the builder allocates once.
std::size_t encodedBytes(const PathColumns& columns);

}  // namespace emca::protocol
