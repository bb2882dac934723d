#include "image/image_pixels.h"

#include <QRunnable>
#include <algorithm>
#include <cmath>

namespace emca::explorer {
namespace {

/// Converted at once, within a frame; larger images go to other threads.
constexpr std::size_t kQuickPixels = 1u << 20;
/// Between two pictures of a preview.
constexpr qint64 kRestMilliseconds = 200;

/// Writes RGBA rows into memory that was allocated before: QImage's own accessors detach and belong to the GUI thread.
void convertInto(const Image& image, const ImageStyle& style, std::span<std::uint8_t> rgba) {
    if (style.falseColor) {
        analysis::falseColor(image, style.channel, analysis::ColorMap::get(style.colorMap), style.range, rgba);
    } else if (style.channel.index == analysis::ChannelChoice::kLuminance) {
        analysis::ToneMapper(style.toneMap).convert(image, rgba);
    } else {
        analysis::ToneMapper(style.toneMap).convertChannel(image, style.channel, rgba);
    }
}

QImage wrap(std::shared_ptr<std::vector<std::uint8_t>> rgba, std::uint32_t width, std::uint32_t height) {
    auto* owner = new std::shared_ptr<std::vector<std::uint8_t>>(std::move(rgba));
    return QImage((*owner)->data(), static_cast<int>(width), static_cast<int>(height), static_cast<int>(width) * 4,
                  QImage::Format_RGBX8888,
                  [](void* p) { delete static_cast<std::shared_ptr<std::vector<std::uint8_t>>*>(p); }, owner);
}

}  // namespace

InvalidPixels findInvalid(const Image& image) {
    InvalidPixels found;
    const std::size_t stride = image.channelCount(), colors = std::min<std::size_t>(stride, 3);
    if (colors == 0) return found;
    const float* value = image.data();
    const std::size_t count = image.size() / stride;
    for (std::size_t i = 0; i < count; ++i, value += stride) {
        bool nan = false, infinite = false, negative = false;
        for (std::size_t c = 0; c < colors; ++c) {
            nan = nan || std::isnan(value[c]);
            infinite = infinite || std::isinf(value[c]);
            negative = negative || value[c] < 0;
        }
        if (!nan && !infinite && !negative) continue;
        (nan ? found.nan : infinite ? found.infinite : found.negative) += 1;
        if (found.pixels.size() < InvalidPixels::kListed)
            found.pixels.push_back({static_cast<std::uint32_t>(i % image.width()), static_cast<std::uint32_t>(i / image.width())});
    }
    return found;
}

ImagePixels::ImagePixels(QObject* parent) : QObject(parent) {
    pool_.setMaxThreadCount(1);
    clock_.start();
    later_.setSingleShot(true);
    connect(&later_, &QTimer::timeout, this, &ImagePixels::refreshNow);
}

ImagePixels::~ImagePixels() {
    pool_.clear();
    pool_.waitForDone();
}

void ImagePixels::set(std::shared_ptr<const RenderedImage> image, const ImageStyle& style) {
    const bool sameImage = image == image_;
    if (sameImage && style == style_) return;
    style_ = style;
    image_ = std::move(image);
    ++generation_;
    if (!image_ || image_->color.empty()) {
        picture_ = {};
        reduced_.clear();
        invalid_ = {};
        emit pictureChanged();
    } else if (std::size_t(image_->color.width()) * image_->color.height() <= kQuickPixels) {
        if (!sameImage) invalid_ = findInvalid(image_->color);
        convertHere();
    } else {
        convertElsewhere();
    }
}

void ImagePixels::refresh() {
    if (later_.isActive()) return;
    const qint64 wait = restUntil_ - clock_.elapsed();
    if (wait > 0) later_.start(static_cast<int>(wait));
    else refreshNow();
}

void ImagePixels::refreshNow() {
    if (!image_ || image_->color.empty()) return;
    const qint64 start = clock_.elapsed();
    ++generation_;
    convertHere();
    // Painting costs more than converting: with software GL every repaint composes the whole window anew.
    restUntil_ = clock_.elapsed() + kRestMilliseconds + 4 * (clock_.elapsed() - start);
}

void ImagePixels::convertHere() {
    const Image& color = image_->color;
    auto rgba = std::make_shared<std::vector<std::uint8_t>>(std::size_t(color.width()) * color.height() * 4);
    convertInto(color, style_, *rgba);
    picture_ = wrap(std::move(rgba), color.width(), color.height());
    reduced_.clear();
    emit pictureChanged();
}

void ImagePixels::convertElsewhere() {
    pool_.clear();  // conversions that did not begin are stale
    running_ = 1;
    pool_.start(QRunnable::create([this, image = image_, style = style_, generation = generation_] {
        const Image& color = image->color;
        auto rgba = std::make_shared<std::vector<std::uint8_t>>(std::size_t(color.width()) * color.height() * 4);
        convertInto(color, style, *rgba);
        auto invalid = findInvalid(color);
        QMetaObject::invokeMethod(this, [this, image, generation, rgba, invalid = std::move(invalid)] {
            if (generation != generation_) return;
            running_ = 0;
            invalid_ = invalid;
            picture_ = wrap(rgba, image->color.width(), image->color.height());
            reduced_.clear();
            emit pictureChanged();
        }, Qt::QueuedConnection);
    }));
}

const QImage& ImagePixels::reduced(int halvings) {
    const QImage* last = &picture_;
    for (int level = 0; level < halvings && last->width() > 1 && last->height() > 1; ++level) {
        if (static_cast<int>(reduced_.size()) <= level)
            reduced_.push_back(last->scaled(std::max(1, last->width() / 2), std::max(1, last->height() / 2),
                                            Qt::IgnoreAspectRatio, Qt::SmoothTransformation));
        last = &reduced_[static_cast<std::size_t>(level)];
    }
    return *last;
}

}  // namespace emca::explorer
