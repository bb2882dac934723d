#include "mitsuba_renderer.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <memory>
#include <utility>

#include <mitsuba/core/sched.h>
#include <mitsuba/core/version.h>
#include <mitsuba/render/film.h>
#include <mitsuba/render/sampler.h>

#include "pixel_sampler.h"
#include "scene_camera.h"

namespace emca::mitsuba06 {

namespace {

constexpr const char* kOurSampler = "emcasampler";
constexpr mts::Float kWidestBox = mts::Float(0.51);  ///< Mitsuba's box filter is a little wider than a pixel

/// Samplers whose numbers depend on pixel and sample alone.
bool isAddressable(const std::string& sampler) {
    constexpr std::array<std::string_view, 4> kNames{kOurSampler, "sobol", "halton", "hammersley"};
    return std::ranges::find(kNames, sampler) != kNames.end();
}

/// What a sampler calls its seed; empty if it has none.
std::string seedName(const std::string& sampler) {
    return sampler == kOurSampler ? "seed" : sampler == "sobol" ? "scramble" : "";
}

template <typename T>
mts::ref<T> create(const mts::Class* kind, const mts::Properties& properties) {
    mts::ref<T> object = static_cast<T*>(mts::PluginManager::getInstance()->createObject(kind, properties));
    object->configure();
    return object;
}

}  // namespace

MitsubaRenderer::MitsubaRenderer(mts::Scene& scene, const TracedIntegrator& integrator)
    : scene_(scene),
      integrator_(integrator),
      shapes_(scene),
      sceneSampler_(scene.getSensor()->getSampler()->getProperties().getPluginName()) {
    filter_ = scene.getFilm()->getReconstructionFilter();
    filtersAlike_ = filter_->getRadius() <= kWidestBox;
    if (!filtersAlike_) {
        filter_ = create<mts::ReconstructionFilter>(MTS_CLASS(mts::ReconstructionFilter), mts::Properties("box"));
        say(mts::EInfo,
            "EMCA: the film's reconstruction filter is wider than a pixel; in the explorer a pixel is the mean of its "
            "own samples.");
    }
    sampler_ = isAddressable(sceneSampler_) ? sceneSampler_ : kOurSampler;
    if (sampler_ != sceneSampler_) {
        say(mts::EInfo, "EMCA: the sampler \"" + sceneSampler_ +
                            "\" gives other numbers each time; in the explorer \"" + sampler_ + "\" takes its place.");
    }
}

void MitsubaRenderer::say(mts::ELogLevel level, const std::string& text) const {
    threads_.registerThisThread();
    SLog(level, "%s", text.c_str());
}

RendererInfo MitsubaRenderer::info() const {
    const mts::Film& film = *scene_.getFilm();
    RendererInfo info;
    info.renderer = "Mitsuba " MTS_VERSION;
    info.scene = std::filesystem::path(scene_.getSourceFile().native()).stem().string();
    if (info.scene.starts_with("scene")) {  // as in collections where each scene has a folder
        info.scene =
            std::filesystem::path(scene_.getSourceFile().native()).parent_path().filename().string() + "/" + info.scene;
    }
    info.width = static_cast<std::uint32_t>(film.getCropSize().x);
    info.height = static_cast<std::uint32_t>(film.getCropSize().y);
    info.samplesPerPixel = static_cast<std::uint32_t>(scene_.getSensor()->getSampler()->getSampleCount());
    info.integrator = integrator_.label();
    info.sampler = sampler_;
    const mts::Properties& ofSampler = scene_.getSensor()->getSampler()->getProperties();
    if (sampler_ == sceneSampler_ && ofSampler.hasProperty(seedName(sampler_))) {
        info.seed = static_cast<std::uint64_t>(ofSampler.getLong(seedName(sampler_)));
    }
    info.concurrent = true;
    info.threads = static_cast<unsigned>(std::max<std::size_t>(1, mts::Scheduler::getInstance()->getCoreCount()));
    info.deterministic = integrator_.isDeterministic();
    if (!filtersAlike_) info.capabilities.push_back("box filter instead of the film's");
    if (sampler_ != sceneSampler_) info.capabilities.push_back(sampler_ + " instead of " + sceneSampler_);
    return info;
}

Camera MitsubaRenderer::camera() const {
    threads_.registerThisThread();
    return cameraOf(scene_);
}

mts::ref<mts::Sampler> MitsubaRenderer::createSampler(const std::string& name, const RenderSettings& settings) const {
    mts::Sampler& ofScene = *scene_.getSensor()->getSampler();
    mts::Properties properties(name);
    if (name == sceneSampler_) properties = ofScene.getProperties();
    const auto count =
        static_cast<int>(settings.samplesPerPixel > 0 ? settings.samplesPerPixel : ofScene.getSampleCount());
    properties.removeProperty("sampleCount");
    properties.setInteger("sampleCount", count);
    if (settings.hasSeed && !seedName(name).empty()) {
        properties.removeProperty(seedName(name));
        properties.setLong(seedName(name), static_cast<std::int64_t>(settings.seed));
    }
    mts::ref<mts::Sampler> sampler = create<mts::Sampler>(MTS_CLASS(mts::Sampler), properties);
    integrator_.computing().configureSampler(&scene_, sampler.get());
    return sampler;
}

Result<mts::ref<mts::Sampler>> MitsubaRenderer::samplerFor(const RenderSettings& settings) const {
    const std::string name = settings.sampler.empty() ? sampler_ : settings.sampler;
    if (!isAddressable(name)) {
        return Error{ErrorCode::invalidArgument,
                     "Asked for the sampler \"" + name +
                         "\": a pixel can be replayed with emcasampler, sobol, halton and hammersley."};
    }
    if (settings.hasSeed && settings.seed != 0 && seedName(name).empty()) {
        return Error{ErrorCode::invalidArgument, "Asked for a seed with the sampler \"" + name +
                                                     "\", which has none: emcasampler and sobol have one."};
    }
    const std::lock_guard lock(mutex_);
    try {
        return createSampler(name, settings);
    } catch (const std::exception& error) {
        return Error{ErrorCode::rendererFailed, "Mitsuba could not make the sampler \"" + name + "\": " + error.what()};
    }
}

mts::ref<mts::Sampler> MitsubaRenderer::clone(mts::Sampler& sampler) const {
    const std::lock_guard lock(mutex_);
    return sampler.clone();
}

Result<mts::ref<mts::SamplingIntegrator>> MitsubaRenderer::integratorFor(int maximumDepth) const {
    mts::SamplingIntegrator& original = integrator_.computing();
    mts::Properties properties(original.getProperties());
    const bool hidesEmitters = properties.hasProperty("hideEmitters") && properties.getBoolean("hideEmitters");
    if (maximumDepth == 0 && !hidesEmitters) return mts::ref<mts::SamplingIntegrator>(&original);
    properties.removeProperty("hideEmitters");
    if (maximumDepth != 0) {
        properties.removeProperty("maxDepth");
        properties.setInteger("maxDepth", maximumDepth);
    }
    const std::lock_guard lock(mutex_);
    try {
        return create<mts::SamplingIntegrator>(MTS_CLASS(mts::SamplingIntegrator), properties);
    } catch (const std::exception& error) {
        return Error{ErrorCode::notSupported, "Mitsuba could not make a copy of the integrator \"" +
                                                  properties.getPluginName() + "\": " + error.what()};
    }
}

Result<adapter::PixelLoop> MitsubaRenderer::loopFor(const RenderSettings& settings) const {
    threads_.registerThisThread();
    if (!settings.integrator.empty() && settings.integrator != integrator_.label()) {
        return Error{ErrorCode::invalidArgument, "Asked for the integrator \"" + settings.integrator +
                                                     "\": this server renders with " + integrator_.label() +
                                                     "; start Mitsuba with the other one."};
    }
    auto sampler = samplerFor(settings);
    if (!sampler) return sampler.error();
    const RendererInfo about = info();
    adapter::PixelLoop loop;
    loop.width = about.width;
    loop.height = about.height;
    loop.samplesPerPixel = settings.samplesPerPixel > 0 ? settings.samplesPerPixel : about.samplesPerPixel;
    loop.threads = about.threads;
    SamplingTask task{&scene_, &integrator_, &shapes_, filter_.get(), nullptr};
    const auto film = std::make_shared<std::vector<FilmPixel>>();
    loop.makeWorker = [this, task, film, prototype = sampler->get(), owner = *sampler,
                       pixels = std::size_t(about.width) * about.height, once = std::make_shared<std::once_flag>()](
                          SurfaceRecorder* surface) -> Result<std::unique_ptr<adapter::PixelWorker>> {
        threads_.registerThisThread();
        SamplingTask mine = task;
        if (surface) {  // the samples of a pixel come in several passes
            std::call_once(*once, [&] { film->assign(pixels, FilmPixel{}); });
            mine.film = film;
        }
        return std::unique_ptr<adapter::PixelWorker>(
            std::make_unique<PixelSampler>(std::move(mine), clone(*prototype), surface));
    };
    return loop;
}

}  // namespace emca::mitsuba06
