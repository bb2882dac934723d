#include "assemble_surface.h"

#include <algorithm>
#include <string>
#include <utility>

#include "emca/protocol/frame.h"

namespace emca::client {

namespace {

Error violation(const std::string& what) {
    return {ErrorCode::protocolViolation, "The renderer's surface layers do not fit together: " + what + "."};
}

}  // namespace

Result<void> SurfaceAssembler::begin(const protocol::SurfaceResult& result) {
    if (begun_) return violation("they begin twice");
    begun_ = true;
    if (result.layers.size() > protocol::kMaximumSurfaceLayers || result.faceCount > protocol::kMaximumSurfaceFaces) {
        return violation(std::to_string(result.layers.size()) + " layers on " + std::to_string(result.faceCount) + " faces were announced");
    }
    for (const protocol::Layer& layer : result.layers) field_.layers.push_back({layer.description, {}, layer.samples, layer.total});
    field_.counts = result.counts;
    faceCount_ = result.faceCount;
    topologyBytes_ = result.topologyBytes;
    meshCount_ = result.meshCount;
    arrays_.emplace_back();
    return {};
}

std::uint64_t SurfaceAssembler::floatsOf(std::size_t array) const {
    return faceCount_ * (array == 0 ? 1 : channelCount(field_.layers[array - 1].description.kind));
}

double SurfaceAssembler::fraction() const {
    if (complete_) return 1;
    std::uint64_t all = topologyBytes_;
    for (std::size_t array = 0; array <= field_.layers.size(); ++array) all += floatsOf(array) * sizeof(float);
    return all == 0 ? 0 : std::min(1.0, static_cast<double>(bytes_) / static_cast<double>(all));
}

bool SurfaceAssembler::meshesAreWhole() const {
    return field_.meshes.size() == meshCount_ && checkMesh().ok() && field_.faceCount() == faceCount_;
}

Result<void> SurfaceAssembler::add(const protocol::SurfaceChunk& chunk) {
    if (!begun_ || complete_) return violation("a part came before their begin or after their end");
    for (const protocol::SurfaceMeshPart& part : chunk.meshes) {
        if (auto added = addPart(part); !added) return added;
    }
    if (!chunk.arrays.empty() && !meshesAreWhole()) return violation("values came before the whole subdivision");
    for (const protocol::SurfaceArrayPart& part : chunk.arrays) {
        if (auto added = addPart(part); !added) return added;
    }
    complete_ = chunk.last;
    if (complete_ && arrays_.size() != field_.layers.size() + 2) return violation("they end early");
    return {};
}

Result<void> SurfaceAssembler::checkMesh() const {
    if (!field_.meshes.empty() && field_.meshes.back().subdivision.bits.size() != byteCount_) {
        return violation("the subdivision of mesh " + std::to_string(field_.meshes.size() - 1) + " ends early");
    }
    return {};
}

Result<void> SurfaceAssembler::addMesh(const protocol::SurfaceMeshPart& part) {
    if (auto whole = checkMesh(); !whole) return whole;
    const std::string which = "mesh " + std::to_string(part.mesh);
    if (part.mesh >= meshCount_) return violation(which + " was not announced");
    const std::uint64_t before = field_.faceCount();
    if (part.faceCount > faceCount_ - before) return violation(which + " has more faces than were announced");
    // A face that divides has a bit more than its four parts, so that n faces need 4n/3 bits at most.
    if (part.byteCount > part.faceCount / 6u + 1u) {
        return violation(which + " has " + std::to_string(part.byteCount) + " bytes of subdivision for " + std::to_string(part.faceCount) + " faces");
    }
    SurfaceMesh mesh;
    mesh.firstFace = before;
    mesh.faceCount = part.faceCount;
    field_.meshes.push_back(std::move(mesh));
    triangleCounts_.push_back(part.triangleCount);
    byteCount_ = part.byteCount;
    return {};
}

Result<void> SurfaceAssembler::addPart(const protocol::SurfaceMeshPart& part) {
    if (arrays_.size() != 1 || !arrays_.front().empty()) return violation("a subdivision came after the first values");
    if (part.mesh == field_.meshes.size()) {
        if (auto added = addMesh(part); !added) return added;
    } else if (part.mesh + std::size_t(1) != field_.meshes.size()) {
        return violation("mesh " + std::to_string(part.mesh) + " came out of order");
    }
    std::vector<std::uint8_t>& bits = field_.meshes.back().subdivision.bits;
    if (part.firstByte != bits.size() || part.bits.size() > byteCount_ - bits.size()) {
        return violation("parts of the subdivision of mesh " + std::to_string(part.mesh) + " overlap or leave a gap");
    }
    bits.insert(bits.end(), part.bits.begin(), part.bits.end());
    bytes_ += part.bits.size();
    return {};
}

Result<void> SurfaceAssembler::addPart(const protocol::SurfaceArrayPart& part) {
    const std::size_t array = arrays_.size() - 1;
    if (array > field_.layers.size()) return violation("values came after those of the last layer");
    std::vector<float>& values = arrays_.back();
    const std::uint64_t whole = floatsOf(array);
    if (part.array != array || part.first != values.size() || part.values.size() > whole - values.size()) {
        return violation("parts of the values overlap or leave a gap");
    }
    // An honest size spares copies; a wrong one must not cost memory.
    if (values.empty()) values.reserve(std::min<std::uint64_t>(whole, std::max<std::uint64_t>(part.values.size(), 1u << 22)));
    values.insert(values.end(), part.values.begin(), part.values.end());
    bytes_ += part.values.size() * sizeof(float);
    if (values.size() == whole) arrays_.emplace_back();
    return {};
}

Result<SurfaceField> SurfaceAssembler::take(const std::optional<std::vector<std::uint32_t>>& triangleCounts) {
    if (!complete_) return violation("they end early");
    field_.points = std::move(arrays_[0]);
    for (std::size_t i = 0; i < field_.layers.size(); ++i) field_.layers[i].values = std::move(arrays_[i + 1]);
    if (auto valid = validate(field_, triangleCounts ? *triangleCounts : triangleCounts_); !valid) return valid.error();
    if (triangleCounts && *triangleCounts != triangleCounts_) return violation("they are for another scene than the one that came before");
    return std::move(field_);
}

}  // namespace emca::client
