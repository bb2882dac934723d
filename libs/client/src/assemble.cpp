#include "assemble.h"

#include <algorithm>
#include <cstring>

namespace emca::client {

namespace {

Error violation(const std::string& what) {
    return {ErrorCode::protocolViolation, "The renderer's answer does not fit together: " + what + "."};
}

constexpr std::uint32_t kMaximumSide = 1u << 16;
constexpr std::uint64_t kMaximumPixels = 1u << 27;

template <typename T>
void append(std::vector<T>& whole, const SharedArray<T>& part, std::size_t expected) {
    // An honest count spares copies; a wrong one must not cost memory.
    if (whole.empty()) whole.reserve(std::min<std::size_t>(expected, std::max<std::size_t>(part.size(), 1u << 22)));
    whole.insert(whole.end(), part.begin(), part.end());
}

}  // namespace

double SceneAssembler::fraction() const {
    if (complete_ || allTriangles_ == 0) return complete_ ? 1 : 0;
    return std::min(1.0, static_cast<double>(triangles_) / static_cast<double>(allTriangles_));
}

Result<void> SceneAssembler::add(const protocol::SceneChunk& chunk) {
    if (complete_) return violation("a scene goes on after its end");
    allTriangles_ = chunk.triangleCount;
    for (const protocol::MeshPart& part : chunk.parts) {
        if (auto added = addPart(part); !added) return added;
    }
    if (!chunk.last) return {};
    if (meshes_.size() != chunk.meshCount) {
        return violation(std::to_string(chunk.meshCount) + " meshes were announced, " + std::to_string(meshes_.size()) + " came");
    }
    complete_ = true;
    return checkWhole();
}

Result<void> SceneAssembler::addPart(const protocol::MeshPart& part) {
    if (part.mesh == meshes_.size()) {
        if (auto whole = checkWhole(); !whole) return whole;
        Mesh& mesh = meshes_.emplace_back();
        mesh.name = part.name;
        mesh.material = part.material;
        mesh.diffuse = part.diffuse;
        mesh.emission = part.emission;
        vertexCount_ = part.vertexCount;
        triangleCount_ = part.triangleCount;
    } else if (part.mesh + std::size_t(1) != meshes_.size()) {
        return violation("mesh " + std::to_string(part.mesh) + " came out of order");
    }
    Mesh& mesh = meshes_.back();
    if (part.firstVertex != mesh.positions.size() || part.firstTriangle != mesh.triangles.size() ||
        part.positions.size() > vertexCount_ - mesh.positions.size() ||
        part.triangles.size() > triangleCount_ - mesh.triangles.size()) {
        return violation("parts of mesh " + std::to_string(part.mesh) + " overlap or leave a gap");
    }
    append(mesh.positions, part.positions, vertexCount_);
    append(mesh.triangles, part.triangles, triangleCount_);
    triangles_ += part.triangles.size();
    return {};
}

Result<void> SceneAssembler::checkWhole() {
    if (meshes_.empty()) return {};
    const Mesh& mesh = meshes_.back();
    if (mesh.positions.size() != vertexCount_ || mesh.triangles.size() != triangleCount_) {
        return violation("mesh " + std::to_string(meshes_.size() - 1) + " ends early");
    }
    if (auto valid = validate(mesh); !valid) return Error{ErrorCode::protocolViolation, valid.error().message};
    return {};
}

std::vector<Mesh> SceneAssembler::takeWholeMeshes() {
    if (!checkWhole()) meshes_.pop_back();
    return take();
}

Result<void> ImageAssembler::begin(const protocol::RenderResult& result) {
    if (begun_) return violation("an image begins twice");
    begun_ = true;
    width_ = result.width;
    height_ = result.height;
    if (width_ == 0 || height_ == 0 || width_ > kMaximumSide || height_ > kMaximumSide || std::uint64_t(width_) * height_ > kMaximumPixels) {
        return violation("an image of " + std::to_string(width_) + " x " + std::to_string(height_) + " pixels was announced");
    }
    render_.id = result.id;
    render_.samplesPerPixel = result.settings.samplesPerPixel;
    render_.seed = result.settings.seed;
    render_.integrator = result.settings.integrator;
    render_.sampler = result.settings.sampler;
    render_.seconds = result.seconds;
    for (const protocol::Layer& layer : result.layers) {
        render_.layers.push_back(layer.description);
        render_.layerSamples.push_back(layer.samples);
    }
    render_.surfaceCounts = result.surfaceCounts;
    render_.surfaceFaces = result.surfaceFaces;
    render_.image.color = Image(width_, height_, {"R", "G", "B"});
    render_.image.samples = Image(width_, height_, {"samples"});
    return {};
}

Result<void> ImageAssembler::add(const protocol::ImageRows& rows) {
    if (!begun_ || complete_) return violation("rows of an image came before its begin or after its end");
    if (rows.firstRow != nextRow_ || rows.rowCount == 0 || rows.rowCount > height_ - nextRow_ ||
        rows.colors.size() != std::size_t(rows.rowCount) * width_) {
        return violation("rows of an image overlap or leave a gap");
    }
    RenderedImage& image = render_.image;
    if (!rows.variance.empty() && image.variance.empty()) {
        if (nextRow_ != 0) return violation("only some rows have variances");
        image.variance = Image(width_, height_, {"R", "G", "B"});
    }
    if (rows.variance.empty() != image.variance.empty()) return violation("only some rows have variances");
    const std::size_t begin = std::size_t(nextRow_) * width_;
    std::memcpy(image.color.data() + 3 * begin, rows.colors.data(), rows.colors.size() * sizeof(Color));
    std::memcpy(image.samples.data() + begin, rows.samples.data(), rows.samples.size() * sizeof(float));
    if (!rows.variance.empty()) std::memcpy(image.variance.data() + 3 * begin, rows.variance.data(), rows.variance.size() * sizeof(Color));
    nextRow_ += rows.rowCount;
    complete_ = rows.last;
    if (complete_ != (nextRow_ == height_)) return violation("an image ends early");
    return {};
}

}  // namespace emca::client
