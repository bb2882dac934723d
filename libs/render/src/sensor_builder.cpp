#include <algorithm>
#include <charconv>
#include <cmath>
#include <string>

#include "scene_building.h"

namespace emca::render {

namespace {

std::optional<FieldOfViewAxis> fieldOfViewAxis(const std::string& text) {
    if (text == "x") return FieldOfViewAxis::x;
    if (text == "y") return FieldOfViewAxis::y;
    if (text == "diagonal") return FieldOfViewAxis::diagonal;
    if (text == "smaller") return FieldOfViewAxis::smaller;
    if (text == "larger") return FieldOfViewAxis::larger;
    return std::nullopt;
}

/// "50mm" or "50" as millimetres.
std::optional<float> millimetres(const std::string& text) {
    float value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    const std::string_view unit(end, static_cast<std::size_t>(text.data() + text.size() - end));
    const bool known = unit.empty() || unit == "mm" || unit == " mm";
    if (error != std::errc() || !known || !(value > 0.f) || !std::isfinite(value)) return std::nullopt;
    return value;
}

void readFieldOfView(PropertyReader& read, CameraSettings& camera) {
    if (const auto axis = read.text("fov_axis")) {
        if (const auto known = fieldOfViewAxis(*axis)) {
            camera.axis = *known;
        } else {
            read.reportProperty("fov_axis", "is \"" + *axis + "\"; known are x, y, diagonal, smaller and larger. Taken as x.");
        }
    }
    if (const auto fov = read.number("fov")) {
        read.ignore("focal_length");
        if (*fov > 0 && *fov < 180) {
            camera.fieldOfView = static_cast<float>(*fov);
            return;
        }
        read.reportProperty("fov", "is " + std::to_string(*fov) + ", but must lie between 0 and 180 degrees. Taken as 50.");
        return;
    }
    // Without a field of view the lens counts, along the film's diagonal; Mitsuba's default is 50 mm.
    const std::string lens = read.text("focal_length", "50mm");
    auto focalLength = millimetres(lens);
    if (!focalLength) {
        read.reportProperty("focal_length", "is \"" + lens + "\"; a length such as 50mm was expected. Taken as 50mm.");
        focalLength = 50.f;
    }
    camera.fieldOfView = diagonalFieldOfView(*focalLength);
    camera.axis = FieldOfViewAxis::diagonal;
}

void readLens(PropertyReader& read, CameraSettings& camera) {
    camera.apertureRadius = static_cast<float>(read.number("aperture_radius", 0.0));
    camera.focusDistance = static_cast<float>(read.number("focus_distance", double(camera.farClip)));
    if (camera.apertureRadius < 0 || !(camera.focusDistance > 0)) {
        read.report(read.description() + " needs an aperture_radius of at least 0 and a positive focus_distance: it is taken as a pinhole.");
        camera.apertureRadius = 0;
    }
}

CameraSettings readCamera(PropertyReader& read) {
    CameraSettings camera;
    camera.toWorld = read.transform("to_world", Transform());
    camera.nearClip = static_cast<float>(read.number("near_clip", 1e-2));
    camera.farClip = static_cast<float>(read.number("far_clip", 1e4));
    if (!(camera.nearClip >= 0) || !(camera.farClip > camera.nearClip)) {
        read.report(read.description() + " needs 0 <= near_clip < far_clip: 0.01 and 10000 are used.");
        camera.nearClip = 1e-2f, camera.farClip = 1e4f;
    }
    const std::string& type = read.type();
    if (type == "spherical") {
        camera.kind = emca::CameraKind::spherical;
        return camera;
    }
    if (type != "perspective" && type != "thinlens") {
        read.report(read.description() + " is not known (perspective, thinlens and spherical are): replaced by perspective.");
    }
    readFieldOfView(read, camera);
    if (type == "thinlens") readLens(read, camera);
    for (const char* shift : {"principal_point_offset_x", "principal_point_offset_y"}) {
        if (read.number(shift, 0.0) != 0.0) read.reportProperty(shift, "is not supported; the principal point stays in the middle.");
    }
    return camera;
}

ReconstructionFilter readFilter(PropertyReader read) {
    const std::string& type = read.type();
    ReconstructionFilter filter = ReconstructionFilter::gaussian();
    const auto positive = [&](const char* name, float fallback) {
        const auto value = static_cast<float>(read.number(name, double(fallback)));
        if (value > 0.f && value <= 100.f) return value;
        read.reportProperty(name, "must lie between 0 and 100 pixels; the default is used.");
        return fallback;
    };
    if (type == "box") {
        filter = ReconstructionFilter::box(positive("radius", 0.5f));
    } else if (type == "tent") {
        filter = ReconstructionFilter::tent(positive("radius", 1.f));
    } else if (type == "gaussian") {
        filter = ReconstructionFilter::gaussian(positive("stddev", 0.5f));
    } else {
        read.report(read.description() + " is replaced by gaussian: filters with negative lobes cannot be importance sampled, and box, tent and gaussian are known.");
        return filter;
    }
    read.reportUnused();
    return filter;
}

void readFilm(const std::shared_ptr<const SceneNode>& node, SceneBuilding& building) {
    building.parts.filter = ReconstructionFilter::gaussian();  // Mitsuba's default
    if (!node) return;
    PropertyReader read = building.reader(*node);
    const auto side = [&](const char* name, std::uint32_t fallback) {
        const std::int64_t value = read.integer(name, fallback);
        if (value >= 1 && value <= (1 << 16)) return static_cast<std::uint32_t>(value);
        read.reportProperty(name, "is " + std::to_string(value) + ", but an image has 1 to 65536 pixels a side; " + std::to_string(fallback) + " is used.");
        return fallback;
    };
    building.parts.width = side("width", 768);
    building.parts.height = side("height", 576);
    for (const char* crop : {"crop_width", "crop_height", "crop_offset_x", "crop_offset_y"}) {
        if (read.hasProperty(crop)) read.reportProperty(crop, "is not supported; the whole image is rendered.");
        read.ignore(crop);
    }
    for (const char* fileOnly :
         {"file_format", "pixel_format", "component_format", "banner", "attach_log", "sample_border", "gamma",
          "tonemap_method", "exposure", "key", "burn", "high_quality_edges", "compensate", "filename", "variable",
          "digits"}) {
        read.ignore(fileOnly);
    }
    if (const auto filter = read.firstOfKind("rfilter")) building.parts.filter = readFilter(building.reader(*filter));
    read.reportUnused();
}

void readSampler(const std::shared_ptr<const SceneNode>& node, SceneBuilding& building) {
    if (!node) return;
    PropertyReader read = building.reader(*node);
    const std::string& type = read.type();
    SceneParts& parts = building.parts;
    parts.sampler = type == "independent" ? SamplerKind::independent : SamplerKind::sobol;
    if (type != "independent" && type != "sobol") {
        read.report(read.description() + " is replaced by the Owen-scrambled sobol sampler: independent and sobol are known.");
    }
    const std::int64_t count = read.integer("sample_count", 4);
    if (count >= 1 && count <= (1 << 20)) {
        parts.samplesPerPixel = static_cast<std::uint32_t>(count);
    } else {
        read.reportProperty("sample_count", "is " + std::to_string(count) + ", but must lie between 1 and 1048576; 4 is used.");
    }
    for (const char* ours : {"seed", "dimension", "scramble", "jitter", "sample_border"}) read.ignore(ours);
    read.reportUnused();
}

}  // namespace

void buildSensor(const SceneNode& sensor, SceneBuilding& building) {
    PropertyReader read = building.reader(sensor);
    building.parts.camera = readCamera(read);
    for (const char* unused : {"shutter_open", "shutter_close"}) read.ignore(unused);
    readSampler(read.firstOfKind("sampler"), building);
    readFilm(read.firstOfKind("film"), building);
    read.reportUnused();
}

}  // namespace emca::render
