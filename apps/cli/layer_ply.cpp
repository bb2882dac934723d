#include "layer_ply.h"

#include <fmt/format.h>

#include <bit>
#include <cmath>
#include <cstring>
#include <limits>

#include "emca/analysis/format.h"
#include "table.h"

namespace emca::cli {
namespace {

static_assert(std::endian::native == std::endian::little, "numbers are written as they are in memory: swap their bytes here first");

/// Gathers numbers and hands them over in large pieces.
class Bytes {
  public:
    explicit Bytes(std::ostream& out) : out_(out) { buffer_.reserve(kPiece + 64); }
    ~Bytes() { flush(); }
    Bytes(const Bytes&) = delete;
    Bytes& operator=(const Bytes&) = delete;

    template <typename T>
    void put(const T& value) {
        const auto* bytes = reinterpret_cast<const char*>(&value);
        buffer_.insert(buffer_.end(), bytes, bytes + sizeof(T));
        if (buffer_.size() >= kPiece) flush();
    }

  private:
    static constexpr std::size_t kPiece = 1u << 20;
    void flush() {
        out_.write(buffer_.data(), static_cast<std::streamsize>(buffer_.size()));
        buffer_.clear();
    }
    std::ostream& out_;
    std::vector<char> buffer_;
};

/// One line of a header each; what comes from a renderer may contain anything.
std::string header(const SurfaceLayerData& layer, const LayerPicture& picture, const std::vector<std::string>& comments,
                   std::uint64_t vertices, std::uint64_t faces) {
    const LayerDescription& description = layer.description;
    std::string text = "ply\nformat binary_little_endian 1.0\n";
    const auto comment = [&](const std::string& line) { text += "comment " + printable(line) + "\n"; };
    comment("EMCA surface layer: " + description.name);
    comment(std::string("kind: ") + name(description.kind));
    comment("unit: " + (description.unit.empty() ? std::string("none") : description.unit));
    if (!description.description.empty()) comment("description: " + description.description);
    comment(fmt::format("samples: {}", layer.samples));
    comment(fmt::format("range of colours: {} to {} ({})", analysis::formatFull(picture.range.min),
                        analysis::formatFull(picture.range.max), picture.shownAs));
    for (const std::string& line : comments) comment(line);
    text += fmt::format("element vertex {}\nproperty float x\nproperty float y\nproperty float z\n", vertices);
    text += fmt::format("element face {}\nproperty list uchar int vertex_indices\nproperty float quality\n", faces);
    if (description.kind == LayerKind::meanColor) text += "property float r\nproperty float g\nproperty float b\n";
    return text + "property uchar red\nproperty uchar green\nproperty uchar blue\nend_header\n";
}

/// Faces of one mesh. Meshes without values have one value for all of them: none, or 0.
void putFaces(Bytes& out, const SurfaceField& field, const SurfaceLayerData& layer, std::size_t mesh, const RefinedMesh& refined,
              std::uint32_t firstVertex, const LayerPicture& picture) {
    const bool isColor = layer.description.kind == LayerKind::meanColor;
    const analysis::ColorMap& map = analysis::ColorMap::get(analysis::ColorMapId::viridis);
    for (std::uint32_t f = 0; f < refined.triangles.size(); ++f) {
        out.put(std::uint8_t{3});
        for (const std::uint32_t vertex : refined.triangles[f]) out.put(firstVertex + vertex);
        float channels[3] = {field.value(layer, mesh, f, 0), 0, 0};
        if (isColor) {
            for (std::uint32_t c = 1; c < 3; ++c) channels[c] = field.value(layer, mesh, f, c);
            out.put(luminance(Color(channels[0], channels[1], channels[2])));
            for (const float channel : channels) out.put(channel);
        } else {
            out.put(channels[0]);
        }
        analysis::Color8 color = analysis::kNoDataColor;
        if (field.meshes[mesh].faceCount > 0) {
            color = picture.colors[field.meshes[mesh].firstFace + f];
        } else if (!std::isnan(channels[0])) {
            color = map.map(static_cast<double>(channels[0]), picture.range);
        }
        out.put(color.r);
        out.put(color.g);
        out.put(color.b);
    }
}

}  // namespace

LayerPicture pictureOf(const SurfaceField& field, const SurfaceLayerData& layer, std::span<const Mesh> meshes) {
    LayerPicture picture;
    const std::vector<float> values = analysis::surfaceScalars(layer), areas = analysis::surfaceAreas(field, meshes);
    picture.range = analysis::surfaceRange(values, areas, analysis::surfaceRangeOptions(layer.description.kind));
    picture.statistics = analysis::surfaceStatistics(values, areas);
    if (layer.description.kind == LayerKind::meanColor) {
        analysis::ToneMap tones;
        tones.exposure = picture.range.max > 0 ? static_cast<float>(-std::log2(picture.range.max)) : 0.f;
        picture.colors = analysis::surfaceColors(layer, analysis::ToneMapper(tones));
        picture.shownAs = "exposure " + analysis::formatNumber(static_cast<double>(tones.exposure));
    } else {
        const analysis::ColorMap& map = analysis::ColorMap::get(analysis::ColorMapId::viridis);
        picture.colors = analysis::surfaceColors(values, map, picture.range);
        picture.shownAs = map.name();
    }
    return picture;
}

Result<std::uint64_t> writePly(std::ostream& out, const SurfaceField& field, const SurfaceLayerData& layer,
                               std::span<const Mesh> meshes, const LayerPicture& picture, const std::vector<std::string>& comments) {
    std::vector<RefinedMesh> refined;
    std::uint64_t vertices = 0, faces = 0;
    for (std::size_t m = 0; m < meshes.size(); ++m) {
        auto mesh = refine(meshes[m], field.meshes[m].subdivision);
        if (!mesh) return mesh.error();
        vertices += mesh->positions.size();
        faces += mesh->triangles.size();
        refined.push_back(std::move(mesh).value());
    }
    if (vertices > std::numeric_limits<std::int32_t>::max()) {
        return Error{ErrorCode::tooLarge, fmt::format("The refined scene has {} vertices, more than a PLY file can name: render with a smaller --surface-budget.", vertices)};
    }
    out << header(layer, picture, comments, vertices, faces);
    Bytes bytes(out);
    for (const RefinedMesh& mesh : refined) for (const Vec3f& p : mesh.positions) bytes.put(p);
    std::uint32_t firstVertex = 0;
    for (std::size_t m = 0; m < refined.size(); ++m) {
        putFaces(bytes, field, layer, m, refined[m], firstVertex, picture);
        firstVertex += static_cast<std::uint32_t>(refined[m].positions.size());
    }
    return faces;
}

}  // namespace emca::cli
