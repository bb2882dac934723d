#include "chunks.h"

#include <algorithm>

#include "emca/protocol/cut.h"
#include "emca/protocol/frame.h"

namespace emca {

namespace {

protocol::ImageRows rowsOf(const std::shared_ptr<const KeptImage>& kept, std::uint32_t first, std::uint32_t count) {
    const RenderedImage& image = kept->image;
    const std::size_t width = image.color.width();
    const std::size_t begin = first * width, pixels = count * width;
    const auto colors = [&](const Image& source) {
        // Three floats per pixel lie in memory as a Color does.
        static_assert(sizeof(Color) == 3 * sizeof(float));
        return SharedArray<Color>(kept, reinterpret_cast<const Color*>(source.data()) + begin, pixels);
    };
    protocol::ImageRows rows;
    rows.firstRow = first;
    rows.rowCount = count;
    rows.colors = colors(image.color);
    rows.samples = SharedArray<float>(kept, image.samples.data() + begin, pixels);
    if (!image.variance.empty()) rows.variance = colors(image.variance);
    rows.last = first + count == image.color.height();
    return rows;
}

}  // namespace

std::size_t chunkBytes(std::uint32_t asked) {
    if (asked == 0) return protocol::kChunkBytes;
    return std::clamp<std::size_t>(asked, 4u << 10, 64u << 20);
}

ClientPort::Source sceneChunks(std::shared_ptr<const std::vector<Mesh>> meshes, std::size_t bytes) {
    return [cutter = protocol::SceneCutter(std::move(meshes), bytes)]() mutable -> std::optional<protocol::Body> { return cutter.next(); };
}

ClientPort::Source imageRows(std::shared_ptr<const KeptImage> kept, std::size_t bytes) {
    const std::size_t rowBytes = kept->image.color.width() * (2 * sizeof(Color) + sizeof(float));
    const auto step = static_cast<std::uint32_t>(std::max<std::size_t>(1, bytes / std::max<std::size_t>(rowBytes, 1)));
    return [kept = std::move(kept), step, row = 0u]() mutable -> std::optional<protocol::Body> {
        const std::uint32_t height = kept->image.color.height();
        if (row >= height) return std::nullopt;
        const std::uint32_t count = std::min(step, height - row);
        auto rows = rowsOf(kept, row, count);
        row += count;
        return rows;
    };
}

}  // namespace emca
