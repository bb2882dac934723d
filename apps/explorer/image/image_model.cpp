#include "image/image_model.h"

#include <QMetaObject>
#include <QRunnable>
#include <algorithm>

#include "base/qt_compat.h"
#include "base/theme.h"
#include "emca/analysis/image_channels.h"
#include "emca/analysis/metric_scale.h"

namespace emca::explorer {
namespace {

constexpr int kHiddenMilliseconds = 250;     // after the last change
constexpr int kProgressMilliseconds = 100;
constexpr int kPreviewMilliseconds = 700;    // between differences of a render that goes on

}  // namespace

ImageModel::ImageModel(client::Dataset& dataset, Theme& theme, QObject* parent) : QObject(parent), dataset_(dataset), theme_(theme) {
    display_.toneMap = theme.toneMap();
    // Two, so that a metric that was chosen last does not wait for the end of one that is no longer wanted.
    pool_.setMaxThreadCount(2);
    for (std::size_t i = 0; i < layers_.size(); ++i) {
        layers_[i].pixels = new ImagePixels(this);
        connect(layers_[i].pixels, &ImagePixels::pictureChanged, this, [this, i] {
            if (isShown(i)) emit pictureChanged();
        });
    }
    hidden_.setSingleShot(true);
    hidden_.setInterval(kHiddenMilliseconds);
    connect(&hidden_, &QTimer::timeout, this, [this] {
        for (const std::size_t i : {kImage, kReference})
            if (!isShown(i) && reference_) paint(i);
    });
    progress_.setInterval(kProgressMilliseconds);
    connect(&progress_, &QTimer::timeout, this, &ImageModel::computingChanged);
    previewDifference_.setSingleShot(true);
    previewDifference_.setInterval(kPreviewMilliseconds);
    connect(&previewDifference_, &QTimer::timeout, this, [this] {
        frozen_.reset();
        update();
    });
    datasetChanged(client::DatasetPart::images | client::DatasetPart::currentImage);
}

ImageModel::~ImageModel() {
    for (Layer& layer : layers_)
        if (layer.job) layer.job->cancelled = true;
    pool_.clear();
    pool_.waitForDone();
}

void ImageModel::datasetChanged(std::uint32_t parts) {
    using client::DatasetPart;
    if (parts & (DatasetPart::images | DatasetPart::currentImage)) {
        const client::ImageEntry* entry = dataset_.currentImage();
        const bool other = image_ != (entry ? entry->image : nullptr);
        image_ = entry ? entry->image : nullptr;
        preview_ = entry && entry->preview;
        if (other) frozen_.reset();
        const auto& images = dataset_.images();
        const auto found = std::find_if(images.begin(), images.end(), [this](const client::ImageEntry& e) { return e.image == reference_; });
        if (reference_ && found == images.end()) {
            reference_.reset();
            display_.mode = ImageMode::image;
        }
        referenceTitle_ = reference_ ? found->title : std::string();
        update();
        emit displayChanged();
    }
    if (parts & DatasetPart::pixels) previewChanged();
}

void ImageModel::previewChanged() {
    if (!preview_) return;
    // Numbers of other threads come from a copy of the preview, made now and then.
    if (!layers_[kImage].wish.isImage() || display_.mode == ImageMode::difference) {
        if (!previewDifference_.isActive()) previewDifference_.start();
    }
    if (layers_[kImage].wish.isImage()) layers_[kImage].pixels->refresh();
}

void ImageModel::setDisplay(const ImageDisplay& display) {
    if (display == display_) return;
    const ImageDisplay before = display_;
    display_ = display;
    if (!reference_) display_.mode = ImageMode::image;
    theme_.setToneMap(display_.toneMap);
    const bool sameNumbers = display_.quantity() == before.quantity();
    const bool fresh = display_.channel != before.channel || (sameNumbers && display_.scale().range.log != before.scale().range.log);
    // Numbers that are not there yet get their range when they come.
    const Layer& front = layers_[frontLayer()];
    const bool recolored = display_.scale().falseColor != before.scale().falseColor || display_.scale().colorMap != before.scale().colorMap;
    if (front.wish == wishOf(frontLayer()) && (fresh || !sameNumbers || recolored)) rangeFor(front, fresh);
    update();
    emit displayChanged();
}

void ImageModel::setAutomaticRange(double tail) {
    display_.tail = tail;
    display_.scale().automatic = true;
    rangeFor(layers_[frontLayer()], true);
    update();
    emit displayChanged();
}

void ImageModel::setMode(ImageMode mode) {
    ImageDisplay display = display_;
    display.mode = reference_ ? mode : ImageMode::image;
    setDisplay(display);
}

void ImageModel::setMetric(analysis::ImageMetric metric) {
    ImageDisplay display = display_;
    display.metric = metric;
    setDisplay(display);
}

void ImageModel::setReference(std::shared_ptr<const RenderedImage> reference) {
    if (reference == reference_) return;
    reference_ = std::move(reference);
    referenceTitle_.clear();
    for (const client::ImageEntry& entry : dataset_.images())
        if (reference_ && entry.image == reference_) referenceTitle_ = entry.title;
    if (!reference_) display_.mode = ImageMode::image;
    update();
    emit displayChanged();
}

bool ImageModel::sizesDiffer() const {
    return image_ && reference_ &&
           (image_->color.width() != reference_->color.width() || image_->color.height() != reference_->color.height());
}

QSize ImageModel::size() const {
    const auto& shown = display_.mode == ImageMode::reference ? reference_ : image_;
    return shown ? QSize(static_cast<int>(shown->color.width()), static_cast<int>(shown->color.height())) : QSize();
}

ImageModel::LayerId ImageModel::frontLayer() const {
    switch (display_.mode) {
        case ImageMode::reference: return kReference;
        case ImageMode::difference: return kDifference;
        default: return kImage;
    }
}

bool ImageModel::isShown(std::size_t layer) const {
    return layer == frontLayer() || (layer == kReference && display_.mode == ImageMode::split);
}

bool ImageModel::isSettled() const {
    return std::all_of(layers_.begin(), layers_.end(), [](const Layer& layer) { return !layer.job && layer.pixels->isReady(); });
}

ContentWish ImageModel::wishOf(std::size_t layer) const {
    const bool compares = layer == kDifference;
    auto image = layer == kReference ? reference_ : image_;
    if (layer != kReference && preview_ && frozen_ && (compares || display_.samplingError)) image = frozen_;
    if (!compares) return {image, nullptr, std::nullopt, display_.samplingError};
    if (!reference_ || !image_) return {};
    return {image, reference_, display_.metric, std::nullopt};
}

/// Brings numbers and pictures of what is shown up to date; of the two images also while the other one is shown.
void ImageModel::update() {
    const bool computes = display_.samplingError || display_.mode == ImageMode::difference;
    if (preview_ && image_ && computes && !frozen_) frozen_ = std::make_shared<const RenderedImage>(*image_);
    for (std::size_t i = 0; i < layers_.size(); ++i) {
        if (isShown(i) || (i != kDifference && reference_)) fill(i);
        // Not shown and no longer true: nobody shall read it.
        else if (i != kImage && layers_[i].wish != wishOf(i)) clear(i);
    }
    emit computingChanged();
    emit pictureChanged();
}

void ImageModel::clear(std::size_t which) {
    Layer& layer = layers_[which];
    if (layer.job) layer.job->cancelled = true;
    ImagePixels* const pixels = layer.pixels;
    layer = {pixels, {}, {}, {}, nullptr};
    pixels->set(nullptr, pixels->style());
}

void ImageModel::fill(std::size_t which) {
    Layer& layer = layers_[which];
    const ContentWish wish = wishOf(which);
    if (wish == layer.wish) {
        if (isShown(which)) paint(which);
        else hidden_.start();
        return;
    }
    if (layer.job) layer.job->cancelled = true;
    layer.job.reset();
    layer.wish = wish;
    if (!wish.isSlow()) {
        ContentProgress progress;
        take(which, computeContent(wish, progress));
        return;
    }
    layer.obstacle.clear();
    layer.job = std::make_shared<ContentProgress>();
    if (!progress_.isActive()) progress_.start();
    pool_.start(QRunnable::create([this, which, wish, job = layer.job] {
        auto result = std::make_shared<Result<ImageContent>>(computeContent(wish, *job));
        QMetaObject::invokeMethod(this, [this, which, job, result] {
            if (layers_[which].job != job) return;
            layers_[which].job.reset();
            take(which, std::move(*result));
            emit computingChanged();
            emit displayChanged();
        }, Qt::QueuedConnection);
    }));
}

void ImageModel::take(std::size_t which, Result<ImageContent> result) {
    Layer& layer = layers_[which];
    if (std::none_of(layers_.begin(), layers_.end(), [](const Layer& l) { return l.job != nullptr; })) progress_.stop();
    layer.obstacle = result ? QString() : toQString(result.error().message);
    layer.content = result ? std::move(*result) : ImageContent{};
    if (which == frontLayer()) rangeFor(layer, false);
    if (isShown(which)) paint(which);
    else hidden_.start();
}

/// Hidden pictures of large images are made later; those of small ones are made when they are shown, within a frame.
void ImageModel::paint(std::size_t which) {
    ImageDisplay as = display_;
    if (which != kDifference && display_.mode == ImageMode::difference) as.mode = ImageMode::image;
    const Layer& layer = layers_[which];
    layer.pixels->set(layer.content.values, as.style(), which == kImage && preview_ && layer.wish.isImage());
    if (isShown(which)) hidden_.start();
}

/// \param fresh  also where a range is there: asked for, or of another channel
void ImageModel::rangeFor(const Layer& layer, bool fresh) {
    ValueScale& scale = display_.scale();
    const bool shown = scale.falseColor || display_.mustBeFalseColor();
    if (!scale.automatic || !shown || !layer.content.values || layer.content.values->empty()) return;
    // Renders of one scene keep the range that the first one had, so that their colours can be compared.
    const bool keeps = display_.mode != ImageMode::difference && !display_.samplingError;
    if (keeps && !fresh && scale.range != ValueScale{}.range) return;
    const Image& values = *layer.content.values;
    const ResolvedChannel channel = resolve(display_.channel, values);
    Image picked;
    if (channel.picked) picked = analysis::pickChannels(values, channel.channels);
    const Image& numbers = channel.picked ? picked : values;
    const bool log = scale.range.log;
    if (display_.mode == ImageMode::difference)
        scale.range = analysis::metricRange(numbers, display_.metric, channel.choice, display_.tail, log);
    else if (analysis::ColorMap::get(scale.colorMap).isDiverging() && !log)
        scale.range = analysis::symmetricRange(numbers, channel.choice, display_.tail);
    else
        scale.range = analysis::imageRange(numbers, channel.choice, display_.tail, log);
}

}  // namespace emca::explorer
