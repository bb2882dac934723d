#include "surface_model.h"

#include <QMetaObject>

#include "base/qt_compat.h"
#include "base/theme.h"

namespace emca::explorer {
namespace {

constexpr std::uint64_t kAtOnce = 20000;   ///< faces that are prepared faster than a frame is drawn

}  // namespace

SurfaceModel::SurfaceModel(client::Dataset& dataset, Theme& theme, QObject* parent)
    : QObject(parent), dataset_(dataset), theme_(theme), listening_(dataset, [this](std::uint32_t parts) {
          if (parts & (client::DatasetPart::surface | client::DatasetPart::meshes)) load();
      }) {
    // Colours of RGB layers follow the transfer curve of the image, not its exposure.
    connect(&theme_, &Theme::toneMapChanged, this, [this] {
        if (!isColor()) return;
        recolor();
        emit styleChanged();
    });
    load();
}

SurfaceModel::~SurfaceModel() { cancel(); }

void SurfaceModel::cancel() {
    if (cancelled_) *cancelled_ = true;
    if (worker_.joinable()) worker_.join();
    preparing_ = false;
}

void SurfaceModel::load() {
    cancel();
    const auto meshes = dataset_.meshes();
    const auto field = dataset_.surface();
    if (!meshes || !field) {
        adopt(std::shared_ptr<const PreparedSurface>());
        return;
    }
    if (surface_ && surface_->meshes == meshes && surface_->field == field) return;
    if (field->faceCount() <= kAtOnce && field->meshes.size() <= kAtOnce) {
        adopt(prepareSurface(meshes, field, style_.lower, style_.upper));
        return;
    }
    preparing_ = true;
    cancelled_ = std::make_shared<std::atomic<bool>>(false);
    worker_ = std::thread([this, meshes, field, lower = style_.lower, upper = style_.upper, cancelled = cancelled_] {
        auto prepared = prepareSurface(meshes, field, lower, upper, cancelled.get());
        if (*cancelled) return;
        // Runs in the GUI thread; the destructor joins this thread first, and Qt drops calls to what is gone.
        QMetaObject::invokeMethod(this, [this, cancelled, prepared = std::move(prepared)]() mutable {
            if (*cancelled) return;
            preparing_ = false;
            adopt(std::move(prepared));
        }, Qt::QueuedConnection);
    });
    emit surfaceChanged();
}

void SurfaceModel::adopt(Result<std::shared_ptr<const PreparedSurface>> result) {
    const bool first = surface_ == nullptr;
    surface_ = result ? *result : nullptr;
    error_ = result ? QString() : toQString(result.error().message);
    // What was just collected is what one wants to see; who has switched the colours off keeps them off.
    if (surface_ && !surface_->field->layers.empty() && !shownIndex() && (first || !style_.layer.empty()))
        style_.layer = surface_->field->layers.front().description.name;
    recolor();
    emit surfaceChanged();
    emit styleChanged();
}

std::optional<std::size_t> SurfaceModel::shownIndex() const {
    if (!surface_ || style_.layer.empty()) return std::nullopt;
    for (std::size_t i = 0; i < surface_->field->layers.size(); ++i)
        if (surface_->field->layers[i].description.name == style_.layer) return i;
    return std::nullopt;
}

const SurfaceLayerData* SurfaceModel::shown() const {
    const auto index = shownIndex();
    return index ? &surface_->field->layers[*index] : nullptr;
}

bool SurfaceModel::isColor() const {
    const SurfaceLayerData* layer = shown();
    return layer && layer->description.kind == LayerKind::meanColor;
}

const analysis::SurfaceStatistics* SurfaceModel::statistics() const {
    const auto index = shownIndex();
    return index ? &surface_->layers[*index].statistics : nullptr;
}

void SurfaceModel::setStyle(const SurfaceStyle& style) {
    if (style == style_) return;
    const bool opacityOnly = [&] {
        SurfaceStyle same = style;
        same.opacity = style_.opacity;
        return same == style_;
    }();
    style_ = style;
    if (!opacityOnly) recolor();
    emit styleChanged();
}

void SurfaceModel::setLog(bool log) {
    SurfaceStyle style = style_;
    style.layers[style.layer].log = log;
    setStyle(style);
}

void SurfaceModel::setLimits(std::optional<SurfaceLimits> limits) {
    SurfaceStyle style = style_;
    style.layers[style.layer].limits = limits;
    setStyle(style);
}

void SurfaceModel::recolor() {
    range_ = {};
    colors_.clear();
    const auto index = shownIndex();
    if (!index) return;
    const SurfaceLayerData& layer = surface_->field->layers[*index];
    if (layer.description.kind == LayerKind::meanColor) {
        analysis::ToneMap tones = theme_.toneMap();
        tones.exposure = style_.exposure;
        colors_ = analysis::surfaceColors(layer, analysis::ToneMapper(tones));
        return;
    }
    const LayerStyle chosen = style_.of(style_.layer);
    const LayerNumbers& numbers = surface_->layers[*index];
    const std::span<const float> values = surface_->scalars(*index);
    if (chosen.limits) range_ = analysis::ValueRange{chosen.limits->min, chosen.limits->max, chosen.log}.repaired();
    else if (numbers.lower == style_.lower && numbers.upper == style_.upper) range_ = chosen.log ? numbers.log : numbers.linear;
    else range_ = analysis::surfaceRange(values, surface_->areas, rangeOptions(layer.description.kind, style_.lower, style_.upper, chosen.log));
    colors_ = analysis::surfaceColors(values, analysis::ColorMap::get(style_.map), range_);
}

std::optional<SurfaceValue> SurfaceModel::valueAt(const SurfaceHit& hit) const {
    const SurfaceLayerData* layer = shown();
    if (!layer || hit.mesh >= surface_->locators.size() || !surface_->locators[hit.mesh]) return std::nullopt;
    const auto face = surface_->locators[hit.mesh]->refinedFace(hit.face, hit.u, hit.v);
    if (!face) return std::nullopt;
    SurfaceValue value{hit, *face};
    const std::uint32_t channels = channelCount(layer->description.kind);
    for (std::uint32_t c = 0; c < channels; ++c) value.channels[c] = surface_->field->value(*layer, hit.mesh, *face, c);
    const std::size_t index = surface_->field->meshes[hit.mesh].firstFace + *face;
    value.scalar = double(surface_->scalars(*shownIndex())[index]);
    if (index < surface_->field->points.size()) value.points = surface_->field->points[index];
    return value;
}

QString SurfaceModel::title() const {
    const SurfaceLayerData* layer = shown();
    if (!layer) return {};
    const QString name = toQString(layer->description.name), unit = toQString(layer->description.unit);
    return unit.isEmpty() ? name : QStringLiteral("%1  [%2]").arg(name, unit);
}

}  // namespace emca::explorer
