#include <algorithm>
#include <memory>
#include <string>

#include "emca/imageio/imageio.h"
#include "emitters/delta_emitters.h"
#include "emitters/environment_emitters.h"
#include "scene_building.h"

namespace emca::render {

namespace {

std::unique_ptr<Emitter> readPoint(PropertyReader& read) {
    Vec3f position = read.transform("to_world", Transform()).point({});
    if (const auto given = read.vector("position")) position = *given;
    return std::make_unique<PointEmitter>(position, read.color("intensity", Color(1.f)));
}

std::unique_ptr<Emitter> readSpot(PropertyReader& read) {
    const double cutoff = read.number("cutoff_angle", 20.0);
    const double beam = read.number("beam_width", cutoff * 0.75);
    if (!(cutoff > 0 && cutoff <= 180)) {
        read.reportProperty("cutoff_angle", "must lie between 0 and 180 degrees; the light is left out.");
        return nullptr;
    }
    return std::make_unique<SpotEmitter>(read.transform("to_world", Transform()), read.color("intensity", Color(1.f)),
                                         static_cast<float>(cutoff), static_cast<float>(std::clamp(beam, 0.0, cutoff)));
}

std::unique_ptr<Emitter> readDirectional(PropertyReader& read) {
    Vec3f direction = read.transform("to_world", Transform()).vector({0, 0, 1});
    if (const auto given = read.vector("direction")) direction = *given;
    if (!(dot(direction, direction) > 0.f)) {
        read.report(read.description() + " has a direction of length 0; the light is left out.");
        return nullptr;
    }
    return std::make_unique<DirectionalEmitter>(normalize(direction), read.color("irradiance", Color(1.f)));
}

std::unique_ptr<Emitter> readEnvironmentMap(PropertyReader& read) {
    const auto file = read.file("filename");
    if (!file) {
        read.report(read.description() + " names no image (filename); the light is left out.");
        return nullptr;
    }
    const auto image = imageio::read(file->resolved);
    if (!image || image->empty()) {
        const std::string why = image ? "it has no pixels." : image.error().message;
        read.reportProperty("filename", "names \"" + file->written + "\", which cannot be used: " + why +
                                            " The light is left out.");
        return nullptr;
    }
    for (const char* unused : {"cache", "gamma"}) read.ignore(unused);
    return std::make_unique<EnvironmentMap>(*image, read.transform("to_world", Transform()),
                                            static_cast<float>(read.number("scale", 1.0)));
}

std::unique_ptr<Emitter> readEmitter(PropertyReader& read) {
    const std::string& type = read.type();
    if (type == "point") return readPoint(read);
    if (type == "spot") return readSpot(read);
    if (type == "directional") return readDirectional(read);
    if (type == "constant") return std::make_unique<ConstantEmitter>(read.color("radiance", Color(1.f)));
    if (type == "envmap") return readEnvironmentMap(read);
    read.report(read.description() + (type == "area" ? " lights no shape: it must stand inside one. It is left out."
                                                     : " is not known (area, point, spot, directional, constant and "
                                                       "envmap are). It is left out."));
    return nullptr;
}

}  // namespace

void buildEmitter(const SceneNode& node, SceneBuilding& building) {
    PropertyReader read = building.reader(node);
    std::unique_ptr<Emitter> emitter = readEmitter(read);
    if (!emitter) return;
    const auto isEnvironment = [](const std::unique_ptr<Emitter>& other) { return other->isEnvironment(); };
    auto& emitters = building.parts.emitters;
    if (emitter->isEnvironment() && std::any_of(emitters.begin(), emitters.end(), isEnvironment)) {
        read.report(read.description() + " is a second environment; a scene has one. It is left out.");
        return;
    }
    emitter->samplingWeight = static_cast<float>(std::max(read.number("sampling_weight", 1.0), 0.0));
    emitter->name = node.id.empty() ? node.type : node.id;
    read.reportUnused();
    emitters.push_back(std::move(emitter));
}

}  // namespace emca::render
