#include "emca/render/scene.h"

#include <algorithm>
#include <cmath>

#include "embree_compat.h"
#include "emca/render/bsdf.h"

namespace emca::render {

namespace {

constexpr float kShadowShortening = 1.f - 1e-5f;  ///< the light's own surface is no occluder
constexpr int kMaximumMaskLayers = 10000;         ///< beyond, a shadow ray counts as blocked
constexpr std::size_t kWidestNode = 8;            ///< children of a node of Embree's trees

/// Fills in Embree's ray where it is; a copy of it would wait for the stores.
void toEmbree(const Ray& ray, RTCRay& r) {
    r.org_x = ray.origin.x, r.org_y = ray.origin.y, r.org_z = ray.origin.z, r.tnear = ray.minimumDistance;
    r.dir_x = ray.direction.x, r.dir_y = ray.direction.y, r.dir_z = ray.direction.z, r.time = 0.f;
    r.tfar = ray.maximumDistance;
    r.mask = ~0u;
    r.id = r.flags = 0;
}

}  // namespace

struct Scene::Embree {
    RTCDevice device = nullptr;
    RTCScene scene = nullptr;
    ~Embree() {
        if (scene) rtcReleaseScene(scene);
        if (device) rtcReleaseDevice(device);
    }
};

Scene::Scene(SceneParts parts)
    : parts_(std::move(parts)),
      embree_(std::make_unique<Embree>()),
      camera_(parts_.camera, parts_.width, parts_.height) {}

Scene::~Scene() = default;

Result<std::shared_ptr<const Scene>> Scene::make(SceneParts parts) {
    std::shared_ptr<Scene> scene(new Scene(std::move(parts)));
    if (auto built = scene->build(); !built) return built.error();
    scene->prepareEmitters();
    return std::shared_ptr<const Scene>(std::move(scene));
}

Result<void> Scene::build() {
    embree_->device = rtcNewDevice(nullptr);
    if (!embree_->device) {
        return Error{ErrorCode::internal, "Embree could not be started (error " +
                                              std::to_string(rtcGetDeviceError(nullptr)) +
                                              "): check that this processor has SSE2 and memory is left."};
    }
    embree_->scene = rtcNewScene(embree_->device);
    rtcSetSceneFlags(embree_->scene, RTC_SCENE_FLAG_ROBUST);
    // One tree of all triangles is best, except where so few shapes are in the scene that Embree's widest node holds
    // them all: there a tree per shape, which low quality asks for, is a sixth faster, as the triangles of flat shapes
    // then share flat boxes.
    const bool treePerShape = parts_.shapes.size() <= kWidestNode;
    rtcSetSceneBuildQuality(embree_->scene, treePerShape ? RTC_BUILD_QUALITY_LOW : RTC_BUILD_QUALITY_HIGH);
    for (std::size_t i = 0; i < parts_.shapes.size(); ++i) {
        Shape& shape = *parts_.shapes[i];
        shape.index = static_cast<std::int32_t>(i);
        hasMasks_ |= shape.masked;
        RTCGeometry geometry = shape.makeGeometry(embree_->device);
        rtcCommitGeometry(geometry);
        rtcAttachGeometryByID(embree_->scene, geometry, static_cast<unsigned>(i));
        rtcReleaseGeometry(geometry);
    }
    rtcCommitScene(embree_->scene);
    if (const RTCError error = rtcGetDeviceError(embree_->device); error != RTC_ERROR_NONE) {
        const bool memory = error == RTC_ERROR_OUT_OF_MEMORY;
        return Error{memory ? ErrorCode::outOfMemory : ErrorCode::internal,
                     "Embree could not build the scene's acceleration structure: " +
                         std::string(memory ? "not enough memory." : "error " + std::to_string(error) + ".")};
    }
    if (!parts_.shapes.empty()) {
        RTCBounds bounds{};
        rtcGetSceneBounds(embree_->scene, &bounds);
        const Vec3f low{bounds.lower_x, bounds.lower_y, bounds.lower_z};
        const Vec3f high{bounds.upper_x, bounds.upper_y, bounds.upper_z};
        if (isFinite(low) && isFinite(high) && low.x <= high.x) {
            center_ = (low + high) * 0.5f;
            radius_ = std::max(0.5f * length(high - low) * 1.01f, 1e-4f);
        }
    }
    return {};
}

void Scene::prepareEmitters() {
    std::vector<float> powers;
    double total = 0;
    for (std::size_t i = 0; i < parts_.emitters.size(); ++i) {
        Emitter& emitter = *parts_.emitters[i];
        emitter.index = static_cast<std::uint32_t>(i);
        emitter.setSceneBounds(center_, radius_);
        if (emitter.isEnvironment() && !environment_) environment_ = &emitter;
        const float power = emitter.power();
        powers.push_back(std::isfinite(power) ? std::max(power, 0.f) : 0.f);
        total += double(powers.back());
    }
    // Half by power, half evenly: a weak light close by is not left to chance (no light has probability 0).
    std::vector<float> weights;
    for (std::size_t i = 0; i < powers.size(); ++i) {
        const double byPower = total > 0 ? double(powers[i]) / total : 0;
        const double share = 0.5 * byPower + 0.5 / static_cast<double>(powers.size());
        weights.push_back(static_cast<float>(share) * parts_.emitters[i]->samplingWeight);
    }
    choice_ = Distribution1D(weights);
}

bool Scene::intersect(const Ray& ray, SurfaceInteraction& at) const {
    RTCRayHit rayHit;
    toEmbree(ray, rayHit.ray);
    rayHit.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    EmbreeContext context = makeEmbreeContext();
    rtcIntersect1(embree_->scene, &context, &rayHit);
    if (rayHit.hit.geomID == RTC_INVALID_GEOMETRY_ID) return false;

    const RayHit hit{rayHit.ray.tfar, rayHit.hit.geomID, rayHit.hit.primID, rayHit.hit.u, rayHit.hit.v};
    const Shape& shape = *parts_.shapes[hit.geometry];
    shape.interact(ray, hit, at);
    at.wo = at.toLocal(-ray.direction);
    at.distance = hit.distance;
    at.mesh = static_cast<std::int32_t>(hit.geometry);
    at.shape = &shape;
    at.bsdf = shape.bsdf.get();
    at.emitter = shape.emitter;
    return true;
}

float Scene::transmittance(const SurfaceInteraction& from, const EmitterSample& light) const {
    const Vec3f origin = offsetOrigin(from.position, from.geometricNormal, from.positionError, light.position - from.position);
    // Aimed anew from there: parallel to the old direction it would pass by the limb of a sphere.
    const Vec3f toLight = light.position - origin;
    if (!hasMasks_) {
        RTCRay shadow;
        toEmbree({origin, toLight, 0.f, kShadowShortening}, shadow);  // Embree needs no unit direction
        EmbreeContext context = makeEmbreeContext();
        rtcOccluded1(embree_->scene, &context, &shadow);
        return shadow.tfar < 0.f ? 0.f : 1.f;
    }
    const float distance = length(toLight);
    Ray ray{origin, toLight / distance, 0.f, distance * kShadowShortening};
    float through = 1.f;
    SurfaceInteraction at;
    for (int layer = 0; layer < kMaximumMaskLayers; ++layer) {
        if (!intersect(ray, at)) return through;
        through *= at.shape->masked ? 1.f - at.bsdf->opacity(at) : 0.f;
        if (!(through > 0.f)) return 0.f;
        ray.origin = offsetOrigin(at.position, at.geometricNormal, at.positionError, ray.direction);
        ray.maximumDistance -= at.distance;
        if (!(ray.maximumDistance > 0.f)) return through;
    }
    return 0.f;
}

Scene::EmitterChoice Scene::chooseEmitter(float u) const {
    if (parts_.emitters.empty()) return {};
    if (parts_.emitters.size() == 1) return {parts_.emitters.front().get(), 1.f};
    const Distribution1D::Choice choice = choice_.sample(u);
    return {parts_.emitters[choice.index].get(), choice.probability};
}

std::vector<emca::Mesh> Scene::meshes() const {
    std::vector<emca::Mesh> meshes;
    meshes.reserve(parts_.shapes.size());
    for (const auto& shape : parts_.shapes) {
        emca::Mesh mesh = shape->displayMesh();
        mesh.name = shape->name;
        mesh.material = shape->bsdf->name();
        mesh.diffuse = shape->bsdf->displayColor();
        if (shape->emitter) mesh.emission = shape->emitter->displayRadiance();
        meshes.push_back(std::move(mesh));
    }
    return meshes;
}

std::uint64_t Scene::triangleCount() const {
    std::uint64_t count = 0;
    for (const auto& shape : parts_.shapes) count += shape->triangleCount();
    return count;
}

}  // namespace emca::render
