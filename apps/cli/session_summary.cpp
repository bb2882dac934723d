#include "session_summary.h"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <algorithm>

#include "table.h"

namespace emca::cli {

namespace {

std::uint64_t trianglesOf(const client::Session& session) {
    std::uint64_t count = 0;
    for (const Mesh& mesh : *session.meshes) count += mesh.triangles.size();
    return count;
}

std::string pixelsOf(const client::Trace& trace) {
    if (trace.pixels.empty()) return "no pixel";
    const Pixel p = trace.pixels.front();
    const std::string first = fmt::format("({}, {})", p.x, p.y);
    return trace.pixels.size() == 1 ? first : fmt::format("{} pixels from {}", trace.pixels.size(), first);
}

std::string savedAt(std::uint64_t seconds) {
    constexpr std::uint64_t kYear9999 = 253'402'300'800;  // a file may say anything
    return seconds == 0 || seconds >= kYear9999 ? "unknown" : fmt::format("{:%Y-%m-%d %H:%M:%S} UTC", fmt::gmtime(static_cast<std::time_t>(seconds)));
}

}  // namespace

bool namesSession(const std::string& argument) { return argument.ends_with(".emca") || client::isSession(argument); }

Json summaryJson(const std::string& file, const client::OpenedSession& opened) {
    const client::Session& session = opened.session;
    Json out;
    out["file"] = file;
    out["whole"] = opened.whole;
    out["notices"] = opened.notices;
    out["software"] = opened.software;
    out["saved"] = opened.saved;
    out["images"] = Json::array();
    for (const client::ImageEntry& entry : session.images) {
        Json image;
        image["title"] = entry.title;
        image["width"] = entry.image->color.width();
        image["height"] = entry.image->color.height();
        image["spp"] = entry.samplesPerPixel == 0 ? Json(nullptr) : Json(entry.samplesPerPixel);
        image["render"] = entry.renderId == 0 ? Json(nullptr) : Json(entry.renderId);
        out["images"].push_back(std::move(image));
    }
    out["traces"] = Json::array();
    for (std::size_t i = 0; i < session.traces.size(); ++i) {
        const client::Trace& trace = *session.traces[i];
        Json entry;
        entry["pixels"] = trace.pixels.size();
        entry["first"] = trace.pixels.empty() ? Json(nullptr) : Json(Json::array({trace.pixels[0].x, trace.pixels[0].y}));
        entry["spp"] = trace.samplesPerPixel;
        entry["paths"] = trace.paths.pathCount();
        entry["vertices"] = trace.paths.vertexCount();
        entry["shown"] = std::find(session.shown.begin(), session.shown.end(), i) != session.shown.end();
        out["traces"].push_back(std::move(entry));
    }
    out["scene"] = nullptr;
    if (session.meshes) out["scene"] = Json{{"meshes", session.meshes->size()}, {"triangles", trianglesOf(session)}};
    out["layers"] = Json::array();
    if (session.surface) {
        for (const SurfaceLayerData& layer : session.surface->layers) out["layers"].push_back(layer.description.name);
    }
    out["selectedPaths"] = session.selection.paths.size();
    out["notes"] = session.notes;
    out["pixelNotes"] = Json::array();
    for (const client::PixelNote& note : session.pixelNotes) {
        out["pixelNotes"].push_back(Json{{"pixel", Json::array({note.pixel.x, note.pixel.y})}, {"text", note.text}});
    }
    return out;
}

std::string summaryText(const std::string& file, const client::OpenedSession& opened) {
    const client::Session& session = opened.session;
    Table table({{"session", Table::Align::left}, {printable(file), Table::Align::left}});
    table.add({"saved", fmt::format("{} by {}", savedAt(opened.saved), opened.software.empty() ? "an unnamed program" : opened.software)});
    if (session.info) table.add({"renderer", fmt::format("{}, scene {}", session.info->renderer, session.info->scene)});
    for (const client::ImageEntry& entry : session.images) {
        table.add({"image", fmt::format("{}: {} x {} pixels", entry.title, entry.image->color.width(), entry.image->color.height())});
    }
    for (const auto& trace : session.traces) {
        table.add({"trace", fmt::format("{}: {} paths, {} vertices, {} spp", pixelsOf(*trace), trace->paths.pathCount(),
                                        trace->paths.vertexCount(), trace->samplesPerPixel)});
    }
    if (session.meshes) table.add({"geometry", fmt::format("{} triangles in {} meshes", trianglesOf(session), session.meshes->size())});
    if (session.surface) {
        std::string names;
        for (const SurfaceLayerData& layer : session.surface->layers) names += (names.empty() ? "" : ", ") + layer.description.name;
        table.add({"surface layers", names});
    }
    if (!session.selection.paths.empty()) table.add({"selected", fmt::format("{} paths", session.selection.paths.size())});
    if (!session.notes.empty()) table.add({"notes", session.notes});
    for (const client::PixelNote& note : session.pixelNotes) {
        table.add({fmt::format("note at ({}, {})", note.pixel.x, note.pixel.y), note.text});
    }
    return table.text();
}

}  // namespace emca::cli
