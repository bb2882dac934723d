#include "scene_camera.h"

#include <cmath>

#include <mitsuba/core/track.h>
#include <mitsuba/render/sensor.h>

namespace emca::mitsuba06 {

namespace {

/// A ray through the middle of the image; what is up is taken from two more.
Camera byRays(const mts::Sensor& sensor) {
    Camera camera;
    camera.kind = CameraKind::other;
    const mts::Film& film = *sensor.getFilm();
    const auto rayAt = [&](double x, double y) {
        mts::Ray ray;
        const mts::Point2 at(mts::Float(x * film.getCropSize().x), mts::Float(y * film.getCropSize().y));
        sensor.sampleRay(ray, at, mts::Point2(mts::Float(0.5), mts::Float(0.5)), 0);
        return ray;
    };
    const mts::Ray middle = rayAt(0.5, 0.5), above = rayAt(0.5, 0.25);
    camera.position = toVec3f(middle.o);
    camera.direction = normalize(toVec3f(middle.d));
    const Vec3f rise = toVec3f(above.o + above.d) - toVec3f(middle.o + middle.d);
    const Vec3f up = rise - camera.direction * dot(rise, camera.direction);
    const Vec3f other = std::abs(camera.direction.y) < 0.9f ? Vec3f{0, 1, 0} : Vec3f{1, 0, 0};
    camera.up = length(up) > 0 ? normalize(up) : normalize(other - camera.direction * dot(other, camera.direction));
    return camera;
}

void placeBy(const mts::Transform& toWorld, Camera& camera) {
    camera.position = toVec3f(toWorld(mts::Point(mts::Float(0))));
    const Vec3f left = toVec3f(toWorld(mts::Vector(1, 0, 0))), up = toVec3f(toWorld(mts::Vector(0, 1, 0)));
    camera.direction = normalize(toVec3f(toWorld(mts::Vector(0, 0, 1))));
    camera.up = normalize(up - camera.direction * dot(up, camera.direction));
    camera.rightHanded = dot(cross(camera.direction, camera.up), left) < 0;
}

}  // namespace

Camera cameraOf(const mts::Scene& scene) {
    const mts::Sensor& sensor = *scene.getSensor();
    const mts::Film& film = *sensor.getFilm();
    const bool wholeImage = film.getCropSize() == film.getSize();
    const std::string& kind = sensor.getClass()->getName();
    Camera camera;
    if ((sensor.getType() & mts::Sensor::EPerspectiveCamera) &&
        sensor.getClass()->derivesFrom(MTS_CLASS(mts::PerspectiveCamera)) && wholeImage) {
        const auto& perspective = static_cast<const mts::PerspectiveCamera&>(sensor);
        camera.kind = CameraKind::perspective;
        placeBy(perspective.getWorldTransform(sensor.getShutterOpen()), camera);
        camera.verticalFieldOfView = static_cast<float>(perspective.getYFov());
        if (sensor.getType() & mts::Sensor::ENeedsApertureSample) {
            camera.apertureRadius = static_cast<float>(sensor.getProperties().getFloat("apertureRadius", 0));
            camera.focusDistance = static_cast<float>(perspective.getFocusDistance());
        }
    } else if ((sensor.getType() & mts::Sensor::EOrthographicCamera) &&
               sensor.getClass()->derivesFrom(MTS_CLASS(mts::ProjectiveCamera))) {
        camera.kind = CameraKind::orthographic;
        placeBy(static_cast<const mts::ProjectiveCamera&>(sensor).getWorldTransform(sensor.getShutterOpen()), camera);
    } else {
        camera = byRays(sensor);
        if (kind == "SphericalCamera") camera.kind = CameraKind::spherical;
    }
    if (sensor.getClass()->derivesFrom(MTS_CLASS(mts::ProjectiveCamera))) {
        const auto& projective = static_cast<const mts::ProjectiveCamera&>(sensor);
        camera.nearClip = static_cast<float>(projective.getNearClip());
        camera.farClip = static_cast<float>(projective.getFarClip());
    }
    return camera;
}

}  // namespace emca::mitsuba06
