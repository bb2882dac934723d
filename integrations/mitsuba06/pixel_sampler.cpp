#include "pixel_sampler.h"

#include <algorithm>
#include <cmath>

#include <mitsuba/render/film.h>
#include <mitsuba/render/sampler.h>
#include <mitsuba/render/sensor.h>

#include "emca/recorder/recorder.h"

namespace emca::mitsuba06 {

PixelSampler::PixelSampler(SamplingTask task, mts::ref<mts::Sampler> sampler, SurfaceRecorder* surface)
    : task_(std::move(task)),
      sampler_(sampler),
      sensor_(*task_.scene->getSensor()),
      width_(static_cast<std::uint32_t>(sensor_.getFilm()->getCropSize().x)),
      differentialScale_(1 / std::sqrt(static_cast<mts::Float>(sampler->getSampleCount()))),
      query_(task_.scene, sampler_.get()) {
    if (surface) tally_.emplace(layers_.emplace(*surface));
    block_ = new mts::ImageBlock(mts::Bitmap::ESpectrumAlphaWeight, mts::Vector2i(1, 1), task_.filter);
    queryType_ = mts::RadianceQueryRecord::ESensorRay;
    if (!sensor_.getFilm()->hasAlpha()) queryType_ &= ~mts::RadianceQueryRecord::EOpacity;
}

mts::Float* PixelSampler::filmPixel() {
    const int border = block_->getBorderSize(), width = block_->getBitmap()->getWidth();
    return block_->getBitmap()->getFloatData() + (border * width + border) * block_->getChannelCount();
}

void PixelSampler::beginPixel(Pixel pixel) {
    // Film coordinates begin at the crop window's corner; sensors add its place in the whole image.
    at_ = mts::Point2i(static_cast<int>(pixel.x), static_cast<int>(pixel.y));
    block_->setOffset(at_);
    block_->clear();
    if (task_.film) std::ranges::copy((*task_.film)[place(pixel)], filmPixel());
    sampler_->generate(at_);
}

Color PixelSampler::sample(Pixel, std::uint32_t index) {
    if (sampler_->getSampleIndex() != index) sampler_->setSampleIndex(index);
    PathRecorder emca = recorder();
    emca.setPathIndex(index);

    query_.newQuery(queryType_, sensor_.getMedium());
    const mts::Point2 position = mts::Point2(at_) + mts::Vector2(sampler_->next2D());
    mts::Point2 lens(mts::Float(0.5));
    if (sensor_.needsApertureSample()) lens = sampler_->next2D();
    const mts::Float time = sensor_.needsTimeSample() ? sampler_->next1D() : mts::Float(0.5);
    mts::RayDifferential ray;
    const mts::Spectrum weight = sensor_.sampleRayDifferential(ray, position, lens, time);
    ray.scaleDifferential(differentialScale_);
    emca.setPathOrigin(ray.o);
    emca.addPathData("film position", position);
    if (sensor_.needsApertureSample()) emca.addPathData("random numbers (lens)", lens);

    PathContext context;
    context.shapes = task_.shapes;
    context.cameraWeight = weight;
    context.tally = tally_ ? &*tally_ : nullptr;
    const mts::Spectrum value = weight * task_.integrator->trace(ray, query_, context);
    emca.setFinalEstimate(value);
    if (!block_->put(position, value, query_.alpha)) emca.addPathData("refused by the film", true);
    sampler_->advance();
    return toColor(value);
}

Color PixelSampler::value(Pixel pixel, const PixelSums&) {
    const mts::Float* const film = filmPixel();
    if (task_.film) std::copy_n(film, std::tuple_size_v<FilmPixel>, (*task_.film)[place(pixel)].begin());
    const mts::Float weight = film[SPECTRUM_SAMPLES + 1];
    const mts::Float scale = weight != 0 ? 1 / weight : 0;
    mts::Spectrum mean;
    for (int i = 0; i < SPECTRUM_SAMPLES; ++i) mean[i] = film[i] * scale;
    return toColor(mean);
}

}  // namespace emca::mitsuba06
