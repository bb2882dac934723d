#include "session_parts.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <utility>

#include "convert.h"
#include "emca/protocol/codec.h"

namespace emca::client {

namespace saved = protocol::saved;
using saved::PartKind;

namespace {

constexpr const char *kNotes = "the notes", *kSurface = "the surface layers";

std::string capitalised(std::string sentence) {
    if (!sentence.empty() && sentence[0] >= 'a' && sentence[0] <= 'z') sentence[0] = static_cast<char>(sentence[0] - 'a' + 'A');
    return sentence;
}

/// "a, b and c"; cut where it would become too long to read.
std::string listed(const std::vector<std::string>& names) {
    constexpr std::size_t kMost = 16;
    std::string text;
    for (std::size_t i = 0; i < names.size(); ++i) {
        if (i == kMost) return text + " and " + std::to_string(names.size() - kMost) + " more";
        text += (i == 0 ? "" : i + 1 == names.size() ? " and " : ", ") + names[i];
    }
    return text;
}

Image imageOf(const saved::Plane& plane) { return plane.width == 0 ? Image() : Image(plane.width, plane.height, plane.channels); }

/// Bytes of a plane in memory; nothing if its size is no image's.
std::optional<std::uint64_t> bytesOf(const saved::Plane& plane) {
    constexpr std::uint32_t kMostPerSide = 1u << 20, kMostChannels = 1u << 16;
    if (plane.width > kMostPerSide || plane.height > kMostPerSide || plane.channels.size() > kMostChannels) return std::nullopt;
    if (plane.width != 0 && (plane.height == 0 || plane.channels.empty())) return std::nullopt;
    return std::uint64_t(plane.width) * plane.height * plane.channels.size() * sizeof(float);
}

PathId id(const saved::PathId& path) { return {path.pixel, path.sample, path.part}; }
VertexId id(const saved::VertexId& v) { return {id(v.path), v.depth, static_cast<Subpath>(v.subpath)}; }

/// What never came is marked, not black.
void fillMissingRows(Image& plane, const std::vector<bool>& came, float value) {
    const std::size_t row = std::size_t(plane.width()) * plane.channelCount();
    for (std::size_t y = 0; y < came.size(); ++y) {
        if (!came[y]) std::fill_n(plane.data() + y * row, row, value);
    }
}

}  // namespace

void PartCollector::report(const std::string& sentence) {
    opened_.whole = false;
    opened_.notices.push_back(sentence);
}

void PartCollector::fault(const std::string& clause, bool later) {
    if (std::exchange(faulty_, true)) return;
    const std::string title = titleHere("a part");
    const bool several = title == kSurface || title == kNotes;
    if (later) {
        opened_.notices.push_back(capitalised(title) + (several ? " were" : " was") + " left out: " + clause + "; open the file with a newer EMCA.");
    } else {
        report(capitalised(title) + (several ? " are" : " is") + " damaged: " + clause + ".");
    }
}

std::string PartCollector::titleOf(std::size_t planned) const {
    const saved::PlannedPart& part = plan_->parts[planned];
    switch (static_cast<PartKind>(part.kind)) {
        case PartKind::notes: return kNotes;
        case PartKind::selection: return "the selection";
        case PartKind::filter: return "the filter";
        case PartKind::view: return "the view";
        case PartKind::info: return "what the renderer said about itself";
        case PartKind::camera: return "the camera";
        case PartKind::scene: return "the scene";
        case PartKind::surface: return kSurface;
        case PartKind::image:
        case PartKind::trace: break;
    }
    return part.title.empty() ? "a part" : part.title.substr(0, 200);
}

std::string PartCollector::titleHere(const std::string& otherwise) const {
    if (part_ == 0u) return "the list of what the session holds";
    if (plan_ && part_ && *part_ <= plan_->parts.size()) return titleOf(*part_ - 1);
    return otherwise;
}

void PartCollector::add(SessionReader::Block block) {
    const BlockHeader& header = block.header;
    if (part_ != header.part) {
        finishPart();
        part_ = header.part;
        faulty_ = false;
        if (plan_ && header.part >= 1 && header.part <= plan_->parts.size()) seen_[header.part - 1] = true;
    }
    if (!block.fault.empty()) return fault(block.fault, block.later);
    if (header.kind == BlockKind::message) {
        auto message = protocol::decode(block.content);
        if (!message) return fault("its content is not valid");
        take(std::move(message).value());
    } else if (header.kind == BlockKind::saved) {
        auto item = saved::decode(block.content);
        if (!item) return fault("its content is not valid");
        take(std::move(item).value());
    } else {
        fault("it is of a kind that this version does not know", true);
    }
}

void PartCollector::take(protocol::Message message) {
    if (auto* info = std::get_if<protocol::Info>(&message.body)) {
        opened_.session.info = infoOf(std::move(*info));
    } else if (const auto* camera = std::get_if<Camera>(&message.body)) {
        opened_.session.camera = *camera;
    } else if (auto* result = std::get_if<protocol::TraceResult>(&message.body)) {
        take(std::move(*result));
    } else if (const auto* scene = std::get_if<protocol::SceneChunk>(&message.body)) {
        take(*scene);
    } else if (const auto* surface = std::get_if<protocol::SurfaceResult>(&message.body)) {
        if (!underWay_.emplace<SurfaceAssembler>().begin(*surface)) fault("its pieces do not fit together");
    } else if (const auto* chunk = std::get_if<protocol::SurfaceChunk>(&message.body)) {
        auto* assembler = std::get_if<SurfaceAssembler>(&underWay_);
        if (!assembler || !assembler->add(*chunk)) fault("its pieces do not fit together");
    } else {
        fault("it is of a kind that this version does not know", true);
    }
}

void PartCollector::take(saved::Item item) {
    if (auto* head = std::get_if<saved::Head>(&item)) {
        opened_.software = head->software;
        opened_.saved = head->saved;
        plan_ = std::move(*head);
        seen_.assign(plan_->parts.size(), false);
    } else if (auto* notes = std::get_if<saved::Notes>(&item)) {
        take(std::move(*notes));
    } else if (const auto* selection = std::get_if<saved::Selection>(&item)) {
        take(*selection);
    } else if (auto* filter = std::get_if<saved::Filter>(&item)) {
        take(std::move(*filter));
    } else if (auto* view = std::get_if<saved::View>(&item)) {
        take(std::move(*view));
    } else if (const auto* image = std::get_if<saved::Image>(&item)) {
        take(*image);
    } else if (const auto* rows = std::get_if<saved::Rows>(&item)) {
        take(*rows);
    } else if (const auto* about = std::get_if<saved::Trace>(&item)) {
        underWay_ = TraceUnderWay{*about, nullptr};
    } else {
        fault("it is of a kind that this version does not know", true);
    }
}

void PartCollector::take(saved::Notes notes) {
    opened_.session.notes = std::move(notes.text);
    opened_.session.pixelNotes.clear();
    for (saved::PixelNote& note : notes.pixels) opened_.session.pixelNotes.push_back({note.pixel, std::move(note.text)});
}

void PartCollector::take(saved::Filter filter) {
    SavedFilter taken{std::move(filter.query), {}, filter.byHand, filter.automatic};
    for (saved::FilterRule& rule : filter.rules)
        taken.rules.push_back({std::move(rule.quantity), rule.over, rule.operation, std::move(rule.value)});
    opened_.session.filter = std::move(taken);
}

void PartCollector::take(saved::View view) {
    SavedView taken;
    reference_ = view.reference;
    for (saved::ViewOption& option : view.options) taken.options.push_back({std::move(option.name), std::move(option.value)});
    for (const saved::PathRays& rays : view.paths) taken.paths.push_back({id(rays.path), rays.line, rays.nextEvents});
    for (const saved::VertexRays& rays : view.vertices) taken.vertices.push_back({id(rays.vertex), rays.incoming, rays.outgoing, rays.nextEvents});
    opened_.session.view = std::move(taken);
}

void PartCollector::take(const saved::Selection& selection) {
    Selection::State state;
    state.pixel = selection.pixel;
    state.region = PixelRegion(selection.region);
    for (const saved::PathId& path : selection.paths) state.paths.push_back(id(path));
    if (selection.currentPath) state.currentPath = id(*selection.currentPath);
    if (const auto& v = selection.vertex) state.vertex = id(*v);
    opened_.session.selection = std::move(state);
}

/// Of the image under way among those of the file, from 1, whether or not those before it came.
std::uint32_t PartCollector::imageNumber() {
    if (!plan_ || !part_ || *part_ == 0 || *part_ > plan_->parts.size()) return ++imageCount_;
    const auto until = plan_->parts.begin() + static_cast<std::ptrdiff_t>(*part_);
    return static_cast<std::uint32_t>(std::count_if(plan_->parts.begin(), until, [](const saved::PlannedPart& part) {
        return part.kind == static_cast<std::uint8_t>(PartKind::image);
    }));
}

void PartCollector::take(const saved::Image& image) {
    std::uint64_t bytes = 0;
    for (const saved::Plane& plane : image.planes) {
        const auto size = bytesOf(plane);
        if (!size) return fault("its size is not that of an image");
        bytes += *size;
    }
    if (bytes > bytesLeft_) return fault("it would need " + std::to_string(bytes) + " bytes, more than is accepted here");
    bytesLeft_ -= bytes;
    ImageUnderWay next;
    next.number = imageNumber();
    next.current = image.current;
    next.entry.title = image.title;
    next.entry.renderId = image.renderId;
    next.entry.samplesPerPixel = image.settings.samplesPerPixel;
    next.entry.seed = image.settings.seed;
    next.entry.integrator = image.settings.integrator;
    next.entry.sampler = image.settings.sampler;
    next.entry.preview = image.preview;
    next.image = {imageOf(image.planes[0]), imageOf(image.planes[1]), imageOf(image.planes[2])};
    for (std::size_t i = 0; i < saved::kPlanes; ++i) next.rows[i].assign(image.planes[i].width == 0 ? 0 : image.planes[i].height, false);
    underWay_ = std::move(next);
}

void PartCollector::take(const saved::Rows& rows) {
    auto* image = std::get_if<ImageUnderWay>(&underWay_);
    if (!image) return fault("its pieces do not fit together");
    Image* const planes[] = {&image->image.color, &image->image.samples, &image->image.variance};
    Image& plane = *planes[rows.plane];
    auto& came = image->rows[rows.plane];
    const std::size_t row = std::size_t(plane.width()) * plane.channelCount();
    if (rows.firstRow > came.size() || rows.rowCount > came.size() - rows.firstRow || rows.values.size() != rows.rowCount * row) {
        return fault("its pieces do not fit together");
    }
    if (rows.rowCount == 0) return;
    std::memcpy(plane.data() + rows.firstRow * row, rows.values.data(), rows.values.size() * sizeof(float));
    std::fill_n(came.begin() + rows.firstRow, rows.rowCount, true);
}

void PartCollector::take(protocol::TraceResult result) {
    if (!std::holds_alternative<TraceUnderWay>(underWay_)) underWay_ = TraceUnderWay{};
    auto& underWay = std::get<TraceUnderWay>(underWay_);
    Trace trace = traceOf(std::move(result));
    trace.totalSeconds = underWay.about.totalSeconds;
    underWay.trace = std::make_shared<const Trace>(std::move(trace));
}

void PartCollector::take(const protocol::SceneChunk& chunk) {
    if (!std::holds_alternative<SceneUnderWay>(underWay_)) underWay_.emplace<SceneUnderWay>();
    auto& scene = std::get<SceneUnderWay>(underWay_);
    scene.announced = chunk.meshCount;
    if (!faulty_ && !scene.assembler.add(chunk)) fault("its pieces do not fit together");
}

void PartCollector::finishPart() {
    if (auto* image = std::get_if<ImageUnderWay>(&underWay_)) finishImage(*image);
    if (auto* trace = std::get_if<TraceUnderWay>(&underWay_)) finishTrace(*trace);
    if (auto* scene = std::get_if<SceneUnderWay>(&underWay_)) finishScene(*scene);
    if (auto* surface = std::get_if<SurfaceAssembler>(&underWay_)) finishSurface(*surface);
    underWay_ = std::monostate();
}

void PartCollector::finishImage(ImageUnderWay& image) {
    const auto count = [&](std::size_t plane) { return std::count(image.rows[plane].begin(), image.rows[plane].end(), true); };
    const auto all = [&](std::size_t plane) { return static_cast<std::size_t>(count(plane)) == image.rows[plane].size(); };
    const std::string title = titleHere("an image");
    if (count(0) == 0 && !all(0)) {
        if (!faulty_) missing_.push_back(title);
        return;
    }
    if (!all(0)) {
        report("Of " + title + ", " + std::to_string(count(0)) + " of " + std::to_string(image.rows[0].size()) +
               " rows are there; the others are marked as not a number (NaN).");
    } else if (!all(1) || !all(2)) {
        report("Of " + title + ", not all sample counts and variances are there.");
    }
    constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
    fillMissingRows(image.image.color, image.rows[0], kNan);
    fillMissingRows(image.image.samples, image.rows[1], 0);
    fillMissingRows(image.image.variance, image.rows[2], kNan);
    image.entry.image = std::make_shared<const RenderedImage>(std::move(image.image));
    if (image.current) opened_.session.currentImage = opened_.session.images.size();
    if (image.number == reference_ && reference_ > 0 && opened_.session.view) opened_.session.view->reference = opened_.session.images.size();
    opened_.session.images.push_back(std::move(image.entry));
}

void PartCollector::finishTrace(TraceUnderWay& trace) {
    if (!trace.trace) {
        if (!faulty_) missing_.push_back(titleHere("a traced pixel"));
        return;
    }
    if (trace.about.shown > 0) shown_.emplace_back(trace.about.shown, opened_.session.traces.size());
    opened_.session.traces.push_back(std::move(trace.trace));
}

void PartCollector::finishScene(SceneUnderWay& scene) {
    sceneIsWhole_ = scene.assembler.complete() && !faulty_;
    auto meshes = sceneIsWhole_ ? scene.assembler.take() : scene.assembler.takeWholeMeshes();
    if (!sceneIsWhole_) {
        if (meshes.empty() && !faulty_) missing_.push_back("the scene");
        if (meshes.empty()) return;
        report("Of the scene, " + std::to_string(meshes.size()) + " of " + std::to_string(scene.announced) + " meshes are there.");
    }
    opened_.session.meshes = std::make_shared<const std::vector<Mesh>>(std::move(meshes));
}

void PartCollector::finishSurface(SurfaceAssembler& surface) {
    if (faulty_) return;
    if (!surface.complete()) {
        missing_.push_back(kSurface);
        return;
    }
    if (!sceneIsWhole_) return report("The surface layers were left out, as the scene that they lie on is not whole.");
    std::vector<std::uint32_t> triangles;
    for (const Mesh& mesh : *opened_.session.meshes) triangles.push_back(static_cast<std::uint32_t>(mesh.triangles.size()));
    auto field = surface.take(triangles);
    if (!field) return fault("they do not fit the scene");
    opened_.session.surface = std::make_shared<const SurfaceField>(std::move(field).value());
}

void PartCollector::finish(std::optional<std::uint64_t> endsAt) {
    finishPart();
    std::sort(shown_.begin(), shown_.end());
    for (const auto& [place, index] : shown_) opened_.session.shown.push_back(index);
    for (std::size_t i = 0; i < seen_.size(); ++i) {
        if (!seen_[i]) missing_.push_back(titleOf(i));
    }
    const std::string where = endsAt ? "The file ends early, after " + std::to_string(*endsAt) + " bytes" : "";
    if (endsAt && !plan_) {
        report(where + "; what it should hold is not known.");
    } else if (endsAt && missing_.empty()) {
        report(where + ".");
    } else if (!missing_.empty()) {
        report((endsAt ? where + "; missing: " : "Missing: ") + listed(missing_) + ".");
    }
}

}  // namespace emca::client
