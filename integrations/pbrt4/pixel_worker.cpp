#include "pixel_worker.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "inside.h"

namespace emca::pbrt4 {

namespace {

/// Pixels of these filters have samples of positive and negative weights.
bool hasNegativeWeights(const pbrt::Filter& filter) {
    return filter.Is<pbrt::MitchellFilter>() || filter.Is<pbrt::LanczosSincFilter>();
}

/// Draws what a camera sample begins with, in pbrt's order: wavelengths, place on the film, time, lens.
pbrt::SampledWavelengths wavelengths(const pbrt::Film& film, pbrt::Sampler& sampler, float* number = nullptr) {
    const pbrt::Float u = sampler.Get1D();
    if (number) *number = static_cast<float>(u);
    return film.SampleWavelengths(pbrt::Options->disableWavelengthJitter ? pbrt::Float(0.5) : u);
}

std::array<float, pbrt::NSpectrumSamples> listed(const pbrt::SampledWavelengths& lambda) {
    std::array<float, pbrt::NSpectrumSamples> list;
    for (int i = 0; i < pbrt::NSpectrumSamples; ++i) list[std::size_t(i)] = static_cast<float>(lambda[i]);
    return list;
}

const pbrt::Bounds2i kOnePixel(pbrt::Point2i(0, 0), pbrt::Point2i(1, 1));

}  // namespace

OwnFilm::OwnFilm(pbrt::Film scenes, pbrt::Bounds2i bounds)
    : film_(pbrt::FilmBaseParameters(scenes.FullResolution(), bounds, scenes.GetFilter(), scenes.Diagonal() * 1000,
                                     scenes.GetPixelSensor(), ""),
            inside::settings(scenes).colorSpace, inside::settings(scenes).largestComponent) {}

PbrtPixelWorker::PbrtPixelWorker(const PixelRequest& request, std::shared_ptr<OwnFilm> film, SurfaceRecorder* surface)
    : request_(request),
      own_(dynamic_cast<const EmcaPathIntegrator*>(&request.integrator)),
      film_(std::move(film)),
      single_(request.scene.film(), kOnePixel),
      sampler_(pbrt::Sampler(request.sampler->sampler).Clone(pbrt::Allocator(&memory_))) {
    if (!surface || !request_.layers) return;
    if (own_) {
        tally_.emplace(*request_.layers);
    } else {
        observedTally_.emplace(*request_.layers);
    }
}

pbrt::Point2i PbrtPixelWorker::filmPixel(Pixel pixel) const {
    return request_.scene.film().PixelBounds().pMin +
           pbrt::Vector2i(static_cast<int>(pixel.x), static_cast<int>(pixel.y));
}

void PbrtPixelWorker::beginPixel(Pixel pixel) {
    weightScale_ = 1;
    // A pixel is the weighted mean of its samples; where weights differ, their sum tells what each one adds.
    if (!recorder().isRecording() || !hasNegativeWeights(request_.scene.film().GetFilter())) return;
    double sum = 0;
    for (std::uint32_t index = 0; index < request_.samplesPerPixel; ++index) {
        sampler_.StartPixelSample(filmPixel(pixel), static_cast<int>(index));
        wavelengths(request_.scene.film(), sampler_);
        sum += double(GetCameraSample(sampler_, filmPixel(pixel), request_.scene.film().GetFilter()).filterWeight);
    }
    weightScale_ = sum != 0 ? request_.samplesPerPixel / sum : 0;
}

Color PbrtPixelWorker::sample(Pixel pixel, std::uint32_t index) {
    const pbrt::Film film = request_.scene.film();
    const pbrt::Point2i place = filmPixel(pixel);
    emca::PathRecorder& emca = recorder();
    emca.setPathIndex(index);
    sampler_.StartPixelSample(place, static_cast<int>(index));
    float u = 0;
    pbrt::SampledWavelengths lambda = wavelengths(film, sampler_, &u);
    const pbrt::CameraSample camera = GetCameraSample(sampler_, place, film.GetFilter());
    emca.addPathData("random number (wavelengths)", u);
    emca.addPathData("film position", [&] { return Vec2f{float(camera.pFilm.x), float(camera.pFilm.y)}; });
    emca.addPathData("time", [&] { return float(camera.time); });

    const pbrt::SampledSpectrum radiance = this->radiance(camera, lambda);
    film_->film().AddSample(place, radiance, lambda, nullptr, camera.filterWeight);
    scratch_.Reset();
    const Color color = contributed(radiance, lambda);
    const bool weighted = hasNegativeWeights(film.GetFilter());
    std::array<float, pbrt::NSpectrumSamples> store;
    emca.addPathData("wavelengths", [&] {
        store = listed(lambda);
        return std::span<const float>(store);
    });
    emca.addPathData("one wavelength", [&] { return lambda.SecondaryTerminated(); });
    if (weighted) emca.addPathData("filter weight", [&] { return float(camera.filterWeight); });
    emca.setFinalEstimate([&] { return weighted ? color * float(weightScale_ * double(camera.filterWeight)) : color; });
    return color;
}

pbrt::SampledSpectrum PbrtPixelWorker::radiance(const pbrt::CameraSample& camera, pbrt::SampledWavelengths& lambda) {
    auto ray = request_.scene.camera().GenerateRayDifferential(camera, lambda);
    if (!ray) {
        recorder().addPathData("end", "no ray: the camera does not see here");
        return pbrt::SampledSpectrum(0);
    }
    // Texture footprints of a pixel's samples shrink as there are more of them, down to an eighth.
    const auto samples = pbrt::Float(sampler_.SamplesPerPixel());
    if (!pbrt::Options->disablePixelJitter)
        ray->ray.ScaleDifferentials(std::max<pbrt::Float>(.125f, 1 / std::sqrt(samples)));
    const pbrt::SampledSpectrum arrived = ray->weight * traced(*ray, lambda);
    if (!arrived.HasNaNs() && !pbrt::IsInf(arrived.y(lambda))) return arrived;
    recorder().addPathData("not finite, taken as black", true);
    return pbrt::SampledSpectrum(0);
}

pbrt::SampledSpectrum PbrtPixelWorker::traced(const pbrt::CameraRayDifferential& ray,
                                              pbrt::SampledWavelengths& lambda) {
    emca::PathRecorder& emca = recorder();
    const SceneView& view = request_.scene.view();
    emca.setPathOrigin([&] { return view.world.point(ray.ray.o); });
    const bool told = emca.isRecording() || tally_ || observedTally_;
    if (own_) {
        PathContext context{
            .view = view, .recorder = emca, .tally = tally_ ? &*tally_ : nullptr, .cameraWeight = ray.weight};
        std::optional<HitWatch> watch;
        if (told) context.watch = &watch.emplace(request_.scene.root(), nullptr);
        return own_->radiance(ray.ray, lambda, sampler_, scratch_, context, own_->settings().maximumDepth);
    }
    if (!told) return request_.integrator.Li(ray.ray, lambda, sampler_, scratch_, nullptr);
    PathObserver observer(view, emca, observedTally_ ? &*observedTally_ : nullptr);
    observer.begin(lambda);
    const HitWatch watch(request_.scene.root(), &observer);
    const pbrt::SampledSpectrum arrived = request_.integrator.Li(ray.ray, lambda, sampler_, scratch_, nullptr);
    observer.end();
    return arrived;
}

/// As the film takes it: seen by its sensor, bright samples cut where the scene says so.
Color PbrtPixelWorker::contributed(const pbrt::SampledSpectrum& radiance, const pbrt::SampledWavelengths& lambda) {
    pbrt::RGBFilm& film = single_.film();
    film.ResetPixel({0, 0});
    film.AddSample({0, 0}, radiance, lambda, nullptr, 1);
    return request_.scene.view().colors.rec709(film.GetPixelRGB({0, 0}));
}

Color PbrtPixelWorker::value(Pixel pixel, const PixelSums&) {
    return request_.scene.view().colors.rec709(film_->film().GetPixelRGB(filmPixel(pixel)));
}

PbrtProbeWorker::PbrtProbeWorker(const LoadedScene& scene, const pbrt::RayIntegrator& integrator, int maximumDepth,
                                 std::uint64_t seed)
    : scene_(scene),
      integrator_(&integrator),
      own_(dynamic_cast<const EmcaPathIntegrator*>(&integrator)),
      maximumDepth_(maximumDepth),
      sampler_(1, static_cast<int>(seed ^ seed >> 32)) {
    if (own_) {
        if (maximumDepth_ < 0) maximumDepth_ = own_->settings().maximumDepth;
    } else if (maximumDepth_ >= 0) {
        deeper_ = inside::withDepth(integrator, maximumDepth_);
        if (deeper_) integrator_ = deeper_.get();
    }
}

Color PbrtProbeWorker::radiance(Vec3f origin, Vec3f direction, Pixel pixel, std::uint32_t sample) {
    const SceneView& view = scene_.view();
    sampler_.StartPixelSample({static_cast<int>(pixel.x), static_cast<int>(pixel.y)}, static_cast<int>(sample), 0);
    pbrt::Sampler sampler(&sampler_);
    pbrt::SampledWavelengths lambda = wavelengths(scene_.film(), sampler);
    const pbrt::RayDifferential ray(view.world.toRender(origin), Normalize(view.world.directionToRender(direction)),
                                    scene_.camera().SampleTime(0));
    PathContext silent{.view = view};
    pbrt::SampledSpectrum arrived = own_ ? own_->radiance(ray, lambda, sampler, scratch_, silent, maximumDepth_)
                                         : integrator_->Li(ray, lambda, sampler, scratch_, nullptr);
    scratch_.Reset();
    if (arrived.HasNaNs() || pbrt::IsInf(arrived.y(lambda))) arrived = pbrt::SampledSpectrum(0);
    return view.colors.radiance(arrived, lambda);
}

}  // namespace emca::pbrt4
