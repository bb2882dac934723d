#include "session_save.h"

#include <algorithm>
#include <chrono>
#include <functional>
#include <numeric>
#include <utility>

#include "convert.h"
#include "emca/core/surface_field.h"
#include "emca/protocol/codec.h"
#include "emca/protocol/cut.h"
#include "emca/protocol/session.h"

namespace emca::client {

namespace {

namespace saved = protocol::saved;
using saved::PartKind;

std::string titleOf(const Trace& trace) {
    if (trace.pixels.empty()) return "paths of no pixel";
    const auto name = [](Pixel p) { return "(" + std::to_string(p.x) + ", " + std::to_string(p.y) + ")"; };
    if (trace.pixels.size() == 1) return "pixel " + name(trace.pixels.front());
    return std::to_string(trace.pixels.size()) + " pixels from " + name(trace.pixels.front()) + " to " + name(trace.pixels.back());
}

std::uint64_t bytesOf(const Session& session) {
    std::uint64_t bytes = 0;
    for (const ImageEntry& entry : session.images) {
        if (entry.image) bytes += 4 * (entry.image->color.size() + entry.image->samples.size() + entry.image->variance.size());
    }
    for (const auto& trace : session.traces) bytes += trace->stats.bytes + 100 * std::uint64_t(trace->paths.vertexCount());
    if (session.meshes) {
        for (const Mesh& mesh : *session.meshes) bytes += mesh.positions.size() * sizeof(Vec3f) + mesh.triangles.size() * sizeof(Triangle);
    }
    if (session.surface) bytes += session.surface->faceCount() * 4 * (1 + session.surface->layers.size());
    return bytes;
}

/// What a reader would not believe.
Result<void> check(const Session& session) {
    const auto refuse = [](const std::string& what) { return Error{ErrorCode::invalidArgument, "The session cannot be saved: " + what + "."}; };
    if (session.surface) {
        if (!session.meshes) return refuse("it has surface layers, but not the scene that they lie on; fetch that first");
        if (auto valid = validate(*session.surface, *session.meshes); !valid) return refuse("its surface layers do not fit its scene");
    }
    for (const auto& trace : session.traces) {
        if (!trace) return refuse("one of its traces is null");
        if (trace->replays.size() != trace->pixels.size()) return refuse("the trace of " + titleOf(*trace) + " has not one comparison per pixel");
    }
    if (session.view && session.view->reference && *session.view->reference >= session.images.size()) return refuse("it has no such reference image");
    for (const ImageEntry& entry : session.images) {
        if (!entry.image) return refuse("the image \"" + entry.title + "\" has no pixels");
    }
    return {};
}

saved::PathId savedId(const PathId& path) { return {path.pixel, path.sample, path.part}; }
saved::VertexId savedId(const VertexId& v) { return {savedId(v.path), v.depth, static_cast<std::uint8_t>(v.subpath)}; }

/// Writes the parts one after the other. Each is planned with what writes it, so that plan and content cannot differ.
class Saver {
  public:
    Saver(const Session& session, SessionWriter& writer, const RequestObserver& observer)
        : session_(session), writer_(writer), observer_(observer), allBytes_(bytesOf(session)) {}

    Result<void> run(std::uint64_t now, const std::string& software) {
        planPeoplesParts();
        planRenderersParts();
        saved::Head head{software, now, {}};
        for (const Part& part : parts_) head.parts.push_back({static_cast<std::uint8_t>(part.kind), part.title});
        if (auto added = add(std::move(head)); !added) return added;
        for (const Part& part : parts_) {
            ++number_;
            if (auto added = part.write(); !added) return added;
        }
        return {};
    }

  private:
    struct Part {
        PartKind kind;
        std::string title;
        std::function<Result<void>()> write;
    };

    // What cannot be had again comes first: what a person wrote and chose; then pixels and paths; then what is large.
    void planPeoplesParts() {
        if (!session_.notes.empty() || !session_.pixelNotes.empty()) plan(PartKind::notes, "", [this] { return writeNotes(); });
        if (session_.selection != Selection::State()) plan(PartKind::selection, "", [this] { return writeSelection(); });
        if (session_.filter) plan(PartKind::filter, "", [this] { return writeFilter(); });
        if (session_.view) plan(PartKind::view, "", [this] { return writeView(); });
    }
    void planRenderersParts() {
        if (session_.info) plan(PartKind::info, "", [this] { return add(messageOf(*session_.info)); });
        if (session_.camera) plan(PartKind::camera, "", [this] { return add(*session_.camera); });
        for (std::size_t i = 0; i < session_.images.size(); ++i) {
            plan(PartKind::image, "image \"" + session_.images[i].title + "\"", [this, i] { return writeImage(i); });
        }
        for (std::size_t i = 0; i < session_.traces.size(); ++i) {
            plan(PartKind::trace, titleOf(*session_.traces[i]), [this, i] { return writeTrace(i); });
        }
        if (session_.meshes) plan(PartKind::scene, "", [this] { return writeScene(); });
        if (session_.surface) plan(PartKind::surface, "", [this] { return writeSurface(); });
    }
    void plan(PartKind kind, std::string title, std::function<Result<void>()> write) {
        parts_.push_back({kind, std::move(title), std::move(write)});
    }

    Result<void> add(std::uint8_t kind, Result<protocol::Frame> frame) {
        if (!frame) return frame.error();
        if (observer_.cancel && *observer_.cancel) return Error{ErrorCode::cancelled, "Saving the session was cancelled."};
        if (auto added = writer_.add(kind, number_, frame->span()); !added) return added;
        savedBytes_ += frame->size();
        const double all = static_cast<double>(std::max(allBytes_, savedBytes_));
        if (observer_.progress) observer_.progress(static_cast<double>(savedBytes_) / std::max(all, 1.0));
        return {};
    }
    Result<void> add(saved::Item item) { return add(BlockKind::saved, saved::encode(item)); }
    Result<void> add(protocol::Body body) { return add(BlockKind::message, protocol::encode({0, std::move(body)})); }

    Result<void> writeNotes() {
        saved::Notes notes{session_.notes, {}};
        for (const PixelNote& note : session_.pixelNotes) notes.pixels.push_back({note.pixel, note.text});
        return add(std::move(notes));
    }

    Result<void> writeSelection() {
        const Selection::State& state = session_.selection;
        saved::Selection selection;
        selection.pixel = state.pixel;
        selection.region.assign(state.region.pixels().begin(), state.region.pixels().end());
        for (const PathId& path : state.paths) selection.paths.push_back(savedId(path));
        if (state.currentPath) selection.currentPath = savedId(*state.currentPath);
        if (state.vertex) selection.vertex = savedId(*state.vertex);
        return add(std::move(selection));
    }

    Result<void> writeFilter() {
        const SavedFilter& from = *session_.filter;
        saved::Filter filter{from.query, {}, from.byHand, from.automatic};
        for (const SavedFilter::Rule& rule : from.rules) filter.rules.push_back({rule.quantity, rule.over, rule.operation, rule.value});
        return add(std::move(filter));
    }

    Result<void> writeView() {
        const SavedView& from = *session_.view;
        saved::View view;
        if (from.reference) view.reference = static_cast<std::uint32_t>(*from.reference) + 1;
        for (const SavedView::Option& option : from.options) view.options.push_back({option.name, option.value});
        for (const SavedView::PathRays& rays : from.paths) view.paths.push_back({savedId(rays.path), rays.line, rays.nextEvents});
        for (const SavedView::VertexRays& rays : from.vertices) view.vertices.push_back({savedId(rays.vertex), rays.incoming, rays.outgoing, rays.nextEvents});
        return add(std::move(view));
    }

    Result<void> writeImage(std::size_t index) {
        const ImageEntry& entry = session_.images[index];
        const Image* planes[saved::kPlanes] = {&entry.image->color, &entry.image->samples, &entry.image->variance};
        saved::Image image;
        image.title = entry.title;
        image.renderId = entry.renderId;
        image.settings = {entry.samplesPerPixel, entry.integrator, entry.sampler, entry.seed, true};
        image.preview = entry.preview;
        image.current = index == session_.currentImage;
        for (std::size_t i = 0; i < saved::kPlanes; ++i) {
            if (!planes[i]->empty()) image.planes[i] = {planes[i]->width(), planes[i]->height(), planes[i]->channels()};
        }
        if (auto added = add(std::move(image)); !added) return added;
        for (std::size_t i = 0; i < saved::kPlanes; ++i) {
            if (auto added = writeRows(entry.image, *planes[i], static_cast<std::uint8_t>(i)); !added) return added;
        }
        return {};
    }

    Result<void> writeRows(const std::shared_ptr<const RenderedImage>& owner, const Image& plane, std::uint8_t number) {
        if (plane.empty()) return {};
        const std::size_t row = std::size_t(plane.width()) * plane.channelCount();
        const auto step = static_cast<std::uint32_t>(std::max<std::size_t>(1, protocol::kChunkBytes / (row * sizeof(float))));
        for (std::uint32_t first = 0; first < plane.height(); first += step) {
            const std::uint32_t count = std::min(step, plane.height() - first);
            saved::Rows rows{number, first, count, SharedArray<float>(owner, plane.data() + first * row, count * row)};
            if (auto added = add(std::move(rows)); !added) return added;
        }
        return {};
    }

    Result<void> writeTrace(std::size_t index) {
        const Trace& trace = *session_.traces[index];
        const auto found = std::find(session_.shown.begin(), session_.shown.end(), index);
        const auto place = found == session_.shown.end() ? 0 : static_cast<std::uint32_t>(found - session_.shown.begin()) + 1;
        if (auto added = add(saved::Trace{trace.totalSeconds, place}); !added) return added;
        return add(messageOf(trace));
    }

    Result<void> writeScene() {
        protocol::SceneCutter cutter(session_.meshes, protocol::kChunkBytes);
        while (auto chunk = cutter.next()) {
            if (auto added = add(std::move(*chunk)); !added) return added;
        }
        return {};
    }

    Result<void> writeSurface() {
        std::vector<std::uint32_t> triangles;
        for (const Mesh& mesh : *session_.meshes) triangles.push_back(static_cast<std::uint32_t>(mesh.triangles.size()));
        std::vector<std::size_t> layers(session_.surface->layers.size());
        std::iota(layers.begin(), layers.end(), 0u);
        protocol::SurfaceCutter cutter(session_.surface, std::move(triangles), std::move(layers), protocol::kChunkBytes);
        if (auto added = add(cutter.announcement(0)); !added) return added;
        while (auto chunk = cutter.next()) {
            if (auto added = add(std::move(*chunk)); !added) return added;
        }
        return {};
    }

    const Session& session_;
    SessionWriter& writer_;
    const RequestObserver& observer_;
    std::vector<Part> parts_;
    std::uint32_t number_ = 0;
    std::uint64_t allBytes_, savedBytes_ = 0;
};

}  // namespace

Result<void> saveSession(const std::filesystem::path& file, const Session& session, const RequestObserver& observer,
                         SessionWriter::Step step, std::uint64_t now, const std::string& software) {
    if (auto valid = check(session); !valid) return valid;
    SessionWriter writer(std::move(step));
    if (auto created = writer.create(file); !created) return created;
    if (auto saved = Saver(session, writer, observer).run(now, software); !saved) return saved;
    return writer.finish();
}

Result<void> saveSession(const std::filesystem::path& file, const Session& session, const RequestObserver& observer) {
    const auto now = std::chrono::duration_cast<std::chrono::seconds>(std::chrono::system_clock::now().time_since_epoch());
    return saveSession(file, session, observer, {}, static_cast<std::uint64_t>(now.count()), "EMCA " EMCA_VERSION);
}

}  // namespace emca::client
