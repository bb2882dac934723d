#include "loaded_scene.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace emca::pbrt4 {

namespace {

constexpr std::size_t kKeptSamplers = 4;
constexpr const char* kObserved[] = {"path",          "simplepath", "volpath",
                                     "simplevolpath", "randomwalk", "ambientocclusion"};
constexpr const char* kSamplers[] = {"halton", "independent", "paddedsobol", "pmj02bn",
                                     "sobol",  "stratified",  "zsobol"};
constexpr const char* kLightSamplers[] = {"bvh", "exhaustive", "power", "uniform"};

template <std::size_t N>
bool contains(const char* const (&names)[N], const std::string& name) {
    return std::find(std::begin(names), std::end(names), name) != std::end(names);
}

template <std::size_t N>
std::string listed(const char* const (&names)[N]) {
    std::string text;
    for (const char* name : names) text += (text.empty() ? "" : ", ") + std::string(name);
    return text;
}

/// pbrt's builder, which also remembers the sampler: a request may want it with other numbers.
class Builder final : public pbrt::BasicSceneBuilder {
  public:
    using BasicSceneBuilder::BasicSceneBuilder;

    void Sampler(const std::string& name, pbrt::ParsedParameterVector parameters, pbrt::FileLoc where) override {
        samplerName = name;
        samplerParameters.clear();
        for (const pbrt::ParsedParameter* parameter : parameters) samplerParameters.push_back(*parameter);
        BasicSceneBuilder::Sampler(name, parameters, where);
    }

    std::string samplerName = "zsobol";  // pbrt's where the scene says nothing
    std::vector<pbrt::ParsedParameter> samplerParameters;
};

/// Parameters for one of pbrt's Create functions, which look at them and let them go. An unknown one is passed over:
/// outside of a scene file it is no mistake.
class Parameters {
  public:
    explicit Parameters(const std::vector<pbrt::ParsedParameter>& given = {}) {
        for (const pbrt::ParsedParameter& parameter : given) add(parameter);
    }
    void add(pbrt::ParsedParameter parameter) {
        parameter.mayBeUnused = true;
        list_.push_back(std::make_unique<pbrt::ParsedParameter>(std::move(parameter)));
    }
    void set(const std::string& name, int value) {
        std::erase_if(list_, [&](const auto& parameter) { return parameter->name == name; });
        pbrt::ParsedParameter parameter{pbrt::FileLoc("request")};
        parameter.type = "integer";
        parameter.name = name;
        parameter.AddInt(value);
        add(std::move(parameter));
    }
    pbrt::ParameterDictionary dictionary() const {
        pbrt::ParsedParameterVector pointers;
        for (const auto& parameter : list_) pointers.push_back(parameter.get());
        return pbrt::ParameterDictionary(pointers, pbrt::RGBColorSpace::sRGB);
    }

  private:
    std::vector<std::unique_ptr<pbrt::ParsedParameter>> list_;
};

std::vector<pbrt::ParsedParameter> copied(const pbrt::ParameterDictionary& dictionary) {
    std::vector<pbrt::ParsedParameter> parameters;
    for (const pbrt::ParsedParameter* parameter : dictionary.GetParameterVector()) parameters.push_back(*parameter);
    return parameters;
}

/// Whether pbrt's table of points fills the pixels of a tile evenly: if not, its sampler ends the process. (A pbrt
/// whose table was replaced by another one is seen so.)
bool pmjTableHolds(int samples) {
    const int tile = 1 << (pbrt::Log4Int(pbrt::nPMJ02bnSamples) - pbrt::Log4Int(pbrt::RoundUpPow4(samples)));
    std::vector<int> points(std::size_t(tile) * std::size_t(tile));
    for (int i = 0; i < pbrt::nPMJ02bnSamples; ++i) {
        const pbrt::Point2f p = pbrt::GetPMJ02BNSample(0, i) * tile;
        ++points[std::size_t(int(p.x) + int(p.y) * tile)];
    }
    return std::all_of(points.begin(), points.end(),
                       [&](int n) { return n >= samples && (n == samples || !pbrt::IsPowerOf4(samples)); });
}

Error unknownIntegrator(const std::string& name) {
    const std::string known = std::string(kOwnIntegrator) + ", " + listed(kObserved);
    for (const char* splatting : {"bdpt", "mlt", "sppm", "lightpath"}) {
        if (name == splatting) {
            return {ErrorCode::notSupported, "pbrt's integrator \"" + name +
                                                 "\" lets paths add to any pixel, so that no pixel can be "
                                                 "rendered alone; choose one of " +
                                                 known + "."};
        }
    }
    return {ErrorCode::notSupported, "There is no integrator \"" + name + "\" here; there are " + known + "."};
}

/// A ray through a place of the film, from the middle of the lens, at the time when the shutter opens.
std::optional<pbrt::Ray> filmRay(const pbrt::Camera& camera, pbrt::Point2f film) {
    pbrt::SampledWavelengths lambda = camera.GetFilm().SampleWavelengths(0.5f);
    pbrt::CameraSample sample;
    sample.pFilm = film;
    sample.pLens = {0.5f, 0.5f};
    const auto ray = camera.GenerateRay(sample, lambda);
    return ray ? std::optional<pbrt::Ray>(ray->ray) : std::nullopt;
}

}  // namespace

struct LoadedScene::Parsed {
    pbrt::BasicScene scene;
    Builder builder{&scene};
};

LoadedScene::LoadedScene() = default;
LoadedScene::~LoadedScene() = default;

Result<std::unique_ptr<LoadedScene>> LoadedScene::load(const LoadOptions& options) {
    pbrt::PBRTOptions pbrtOptions;
    pbrtOptions.nThreads = options.threads;
    if (options.seed) pbrtOptions.seed = *options.seed;
    pbrt::InitPBRT(pbrtOptions);

    std::unique_ptr<LoadedScene> loaded(new LoadedScene);
    loaded->parsed_ = std::make_unique<Parsed>();
    pbrt::BasicScene& scene = loaded->parsed_->scene;
    Builder& builder = loaded->parsed_->builder;
    pbrt::ParseFiles(&builder, options.files);

    // In the order of pbrt's own CPU renderer: media before lights, lights before shapes.
    const ShapeSources sources;
    std::map<std::string, pbrt::Medium> media = scene.CreateMedia();
    const pbrt::NamedTextures textures = scene.CreateTextures();
    std::map<int, pstd::vector<pbrt::Light>*> areaLights;
    loaded->lights_ = scene.CreateLights(textures, &areaLights);
    std::map<std::string, pbrt::Material> namedMaterials;
    std::vector<pbrt::Material> materials;
    scene.CreateMaterials(textures, &namedMaterials, &materials);
    loaded->root_ = scene.CreateAggregate(textures, areaLights, media, namedMaterials, materials);
    loaded->camera_ = scene.GetCamera();
    scene.GetSampler();
    loaded->materials_ = MaterialNames(namedMaterials, materials);
    loaded->samplerName_ = builder.samplerName;
    loaded->samplerParameters_ = builder.samplerParameters;
    loaded->integratorName_ = options.integrator.empty() ? scene.integrator.name : options.integrator;

    loaded->surfaces_ = std::make_unique<SceneSurfaces>(SceneSurfaces::Scene{
        loaded->root_, loaded->camera_, loaded->lights_, sources, loaded->materials_, options.largestTriangleCount});
    pbrt::Point3f centre;
    pbrt::Float radius = 1;
    if (loaded->root_) loaded->root_.Bounds().BoundingSphere(&centre, &radius);
    loaded->view_ =
        std::make_unique<SceneView>(SceneView{*loaded->surfaces_, loaded->materials_, SpectrumColors(loaded->film()),
                                              WorldSpace(loaded->camera_.GetCameraTransform()), centre, radius});
    const auto sampler = loaded->sampler("", {}, {});
    if (!sampler) return sampler.error();
    loaded->samplesPerPixel_ = (*sampler)->sampler.SamplesPerPixel();
    loaded->seed_ = Parameters(loaded->samplerParameters_).dictionary().GetOneInt("seed", pbrt::Options->seed);
    if (auto made = loaded->makeIntegrators(scene); !made) return made.error();
    if (auto chosen = loaded->integrator(""); !chosen) return chosen.error();
    if (auto watching = loaded->checkWatching(); !watching) return watching.error();
    return loaded;
}

/// All of them now: their constructors write to the lights, which later are in use.
Result<void> LoadedScene::makeIntegrators(const pbrt::BasicScene& scene) {
    const Parameters parameters(copied(scene.integrator.parameters));
    const pbrt::ParameterDictionary dictionary = parameters.dictionary();
    const EmcaPathIntegrator::Settings settings{.maximumDepth = dictionary.GetOneInt("maxdepth", 5),
                                                .lightSampler = dictionary.GetOneString("lightsampler", "bvh"),
                                                .regularize = dictionary.GetOneBool("regularize", false)};
    if (!contains(kLightSamplers, settings.lightSampler)) {
        return Error{ErrorCode::invalidArgument, "The scene's integrator asks for the light sampler \"" +
                                                     settings.lightSampler + "\"; there are " + listed(kLightSamplers) +
                                                     "."};
    }
    const pbrt::Sampler prototype = samplers_.back().prototype->sampler;
    integrators_[kOwnIntegrator] =
        std::make_unique<EmcaPathIntegrator>(settings, camera_, prototype, root_, lights_, *view_);
    // What this one does not take would end the process, at the first ray that meets it.
    if (std::any_of(lights_.begin(), lights_.end(),
                    [](const pbrt::Light& light) { return IsDeltaLight(light.Type()); })) {
        whyNoSimpleVolpath_ =
            "pbrt's \"simplevolpath\" takes area lights and infinite lights only, and the scene has others.";
    } else if (surfaces_->anyScatters()) {
        whyNoSimpleVolpath_ = "pbrt's \"simplevolpath\" takes no surfaces that scatter, and the scene has some.";
    }
    for (const std::string name : kObserved) {
        if (name == "simplevolpath" && !whyNoSimpleVolpath_.empty()) continue;
        auto made = pbrt::Integrator::Create(name, dictionary, camera_, prototype, root_, lights_, scene.filmColorSpace,
                                             &scene.integrator.loc);
        if (auto* rays = dynamic_cast<pbrt::RayIntegrator*>(made.get())) {
            static_cast<void>(made.release());
            integrators_[name].reset(rays);
        }
    }
    return {};
}

Result<void> LoadedScene::checkWatching() const {
    const pbrt::Bounds2f bounds(film().PixelBounds());
    constexpr int kSteps = 16;
    for (int i = 0; i < kSteps * kSteps; ++i) {
        const pbrt::Point2f at =
            bounds.Lerp(pbrt::Point2f((float(i % kSteps) + 0.5f) / kSteps, (float(i / kSteps) + 0.5f) / kSteps));
        const auto ray = filmRay(camera_, at);
        if (!ray || !root_ || !root_.Intersect(*ray, pbrt::Infinity)) continue;
        if (HitWatch::works(root_, *ray)) return {};
        return Error{ErrorCode::notSupported,
                     "This pbrt was linked so that its calls cannot be seen (link-time optimisation?); build pbrt "
                     "without it."};
    }
    return {};  // nothing is seen anyway
}

Result<const pbrt::RayIntegrator*> LoadedScene::integrator(const std::string& asked) const {
    std::string name = asked.empty() ? integratorName_ : asked;
    if (name == "ao") name = "ambientocclusion";
    const auto found = integrators_.find(name);
    if (found != integrators_.end()) return found->second.get();
    if (name == "simplevolpath") return Error{ErrorCode::notSupported, whyNoSimpleVolpath_};
    return unknownIntegrator(name);
}

Result<std::shared_ptr<const SamplerPrototype>> LoadedScene::sampler(const std::string& asked,
                                                                     std::optional<int> samplesPerPixel,
                                                                     std::optional<int> seed) const {
    const std::string name = asked.empty() ? samplerName_ : asked;
    if (!contains(kSamplers, name)) {
        return Error{ErrorCode::notSupported,
                     "pbrt has no sampler \"" + name + "\"; it has " + listed(kSamplers) + "."};
    }
    // A sampler's own parameters mean nothing to another one.
    Parameters parameters(name == samplerName_ ? samplerParameters_ : std::vector<pbrt::ParsedParameter>());
    const pbrt::ParameterDictionary scenes = parameters.dictionary();
    const int samples = samplesPerPixel.value_or(
        samplesPerPixel_ > 0   ? samplesPerPixel_
        : name == "stratified" ? scenes.GetOneInt("xsamples", 4) * scenes.GetOneInt("ysamples", 4)
                               : scenes.GetOneInt("pixelsamples", name == "independent" ? 4 : 16));
    const int number = seed.value_or(scenes.GetOneInt("seed", pbrt::Options->seed));
    if (samples < 1)
        return Error{ErrorCode::invalidArgument,
                     "Asked for " + std::to_string(samples) + " samples per pixel: at least 1 it must be."};
    const bool askedFor = samplesPerPixel.has_value();
    if (name == "zsobol" && askedFor && !pbrt::IsPowerOf2(samples)) {
        return Error{ErrorCode::invalidArgument,
                     "pbrt's sampler \"zsobol\" takes a power of two of samples per pixel; asked for " +
                         std::to_string(samples) + "."};
    }
    if (name == "pmj02bn" && samples > pbrt::nPMJ02bnSamples) {
        return Error{ErrorCode::invalidArgument, "pbrt's sampler \"pmj02bn\" has at most " +
                                                     std::to_string(pbrt::nPMJ02bnSamples) +
                                                     " samples per pixel; asked for " + std::to_string(samples) + "."};
    }
    if (name == "pmj02bn" && !pmjTableHolds(samples)) {
        return Error{ErrorCode::notSupported,
                     "This pbrt's table of \"pmj02bn\" points is not what it has to be; take another sampler."};
    }

    const std::scoped_lock lock(samplerMutex_);
    for (const CachedSampler& cached : samplers_) {
        if (cached.name == name && cached.samplesPerPixel == samples && cached.seed == number) return cached.prototype;
    }
    if (name == "stratified") {
        if (samples != scenes.GetOneInt("xsamples", 4) * scenes.GetOneInt("ysamples", 4)) {  // as square as they divide
            int rows = static_cast<int>(std::sqrt(double(samples)));
            while (samples % rows != 0) --rows;
            parameters.set("xsamples", samples / rows);
            parameters.set("ysamples", rows);
        }
    } else {
        parameters.set("pixelsamples", samples);
    }
    parameters.set("seed", number);
    auto prototype = std::make_shared<SamplerPrototype>();
    const pbrt::FileLoc where("request");
    prototype->sampler = pbrt::Sampler::Create(name, parameters.dictionary(), film().FullResolution(), &where,
                                               pbrt::Allocator(&prototype->memory));
    samplers_.push_back({name, samples, number, prototype});
    if (samplers_.size() > kKeptSamplers) samplers_.erase(samplers_.begin() + 1);  // the first is the scene's
    return std::shared_ptr<const SamplerPrototype>(std::move(prototype));
}

Camera LoadedScene::viewerCamera() const {
    const WorldSpace& world = view_->world;
    const pbrt::Bounds2f bounds(film().PixelBounds());
    const auto ray = [&](float x, float y) { return filmRay(camera_, bounds.Lerp(pbrt::Point2f(x, y))); };
    const auto middle = ray(0.5f, 0.5f), top = ray(0.5f, 0.f), bottom = ray(0.5f, 1.f), left = ray(0.f, 0.5f),
               right = ray(1.f, 0.5f);
    Camera camera;
    camera.kind = camera_.Is<pbrt::OrthographicCamera>() ? CameraKind::orthographic
                  : camera_.Is<pbrt::SphericalCamera>()  ? CameraKind::spherical
                  : camera_.Is<pbrt::PerspectiveCamera>() || camera_.Is<pbrt::RealisticCamera>()
                      ? CameraKind::perspective
                      : CameraKind::other;
    camera.farClip = 1e3f * float(view_->radius);
    if (!middle) return camera;
    camera.position = world.point(middle->o);
    camera.direction = normalize(world.direction(middle->d));
    if (camera.kind == CameraKind::spherical) {
        const auto& transform = camera_.GetCameraTransform();
        camera.direction =
            normalize(world.direction(transform.RenderFromCamera(pbrt::Vector3f(0, 0, 1), camera_.SampleTime(0))));
        camera.up =
            normalize(world.direction(transform.RenderFromCamera(pbrt::Vector3f(0, 1, 0), camera_.SampleTime(0))));
        return camera;
    }
    if (!top || !bottom || !left || !right) return camera;
    // Up and right of the image, by where its edges look to, or start from.
    const auto across = [&](const pbrt::Ray& from, const pbrt::Ray& to) {
        const Vec3f v = world.direction((to.o + to.d) - (from.o + from.d));
        return v - camera.direction * dot(v, camera.direction);
    };
    camera.up = normalize(across(*bottom, *top));
    camera.rightHanded = dot(across(*left, *right), cross(camera.direction, camera.up)) > 0;
    const float cosine = dot(normalize(world.direction(top->d)), normalize(world.direction(bottom->d)));
    if (camera.kind == CameraKind::perspective)
        camera.verticalFieldOfView = std::acos(std::clamp(cosine, -1.f, 1.f)) * 57.2957795f;
    return camera;
}

}  // namespace emca::pbrt4
