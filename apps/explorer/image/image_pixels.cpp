#include "image/image_pixels.h"

#include <QRunnable>
#include <algorithm>
#include <cmath>
#include <utility>

#include "emca/analysis/image_channels.h"

namespace emca::explorer {
namespace {

/// Converted at once, within a frame; larger images go to other threads.
constexpr std::size_t kQuickPixels = 1u << 20;
/// Between two pictures of a preview.
constexpr qint64 kRestMilliseconds = 200;

std::size_t pixelCount(const Image& image) { return std::size_t(image.width()) * image.height(); }

/// Rows of an image as an image of their own, with the channels that are shown alone if they are not the first three.
Image rowsOf(const Image& image, std::uint32_t firstRow, std::uint32_t lastRow, const ResolvedChannel& channel) {
    const std::uint32_t channels = channel.picked ? 3 : image.channelCount();
    Image rows(image.width(), lastRow - firstRow, channel.picked ? std::vector<std::string>{"R", "G", "B"} : image.channels());
    const float* in = image.at({0, firstRow});
    float* out = rows.data();
    if (!channel.picked) {
        std::copy(in, in + rows.size(), out);
        return rows;
    }
    for (std::size_t i = 0; i < pixelCount(rows); ++i, in += image.channelCount(), out += channels)
        for (std::size_t c = 0; c < 3; ++c) out[c] = in[channel.channels[c]];
    return rows;
}

/// \param rgba  of these rows alone
void convertRows(const Image& rows, const ImageStyle& style, const ResolvedChannel& channel, std::span<std::uint8_t> rgba) {
    if (style.falseColor)
        analysis::falseColor(rows, channel.choice, analysis::ColorMap::get(style.colorMap), style.range, rgba);
    else if (channel.color)
        analysis::ToneMapper(style.toneMap).convert(rows, rgba);
    else
        analysis::ToneMapper(style.toneMap).convertChannel(rows, channel.choice, rgba);
}

QImage wrap(const std::shared_ptr<std::vector<std::uint8_t>>& rgba, int width, int height) {
    auto* owner = new std::shared_ptr<std::vector<std::uint8_t>>(rgba);
    return QImage(static_cast<const std::uint8_t*>((*owner)->data()), width, height, width * 4, QImage::Format_RGBX8888,
                  [](void* p) { delete static_cast<std::shared_ptr<std::vector<std::uint8_t>>*>(p); }, owner);
}

InvalidPixels findInvalid(const Image& image, const ImageStyle& style) {
    const analysis::FaultRules rules = faultRules(style);
    return {analysis::faultyPixels(image, InvalidPixels::kMarked, rules), analysis::countFaults(image, rules)};
}

}  // namespace

analysis::FaultRules faultRules(const ImageStyle& style) { return {.channels = 3, .negative = style.negativeIsInvalid}; }

Picture::Picture(std::uint32_t width, std::uint32_t height) {
    std::uint32_t w = width, h = height;
    while (w > 0 && h > 0) {
        bytes_.push_back(std::make_shared<std::vector<std::uint8_t>>(std::size_t(w) * h * 4));
        levels_.push_back(wrap(bytes_.back(), static_cast<int>(w), static_cast<int>(h)));
        if (w == 1 || h == 1) break;
        w /= 2;
        h /= 2;
    }
}

const QImage& Picture::reduced(int halvings) const {
    return levels_[std::min(static_cast<std::size_t>(std::max(halvings, 0)), levels_.size() - 1)];
}

void Picture::convert(const Image& image, const ImageStyle& style, std::uint32_t firstRow, std::uint32_t lastRow) {
    lastRow = std::min(lastRow, image.height());
    if (isNull() || firstRow >= lastRow) return;
    const ResolvedChannel channel = resolve(style.channel, image);
    const std::span<std::uint8_t> all(*bytes_.front());
    const std::size_t row = std::size_t(image.width()) * 4;
    if (!style.falseColor && channel.color && !channel.picked) {
        analysis::ToneMapper(style.toneMap).convert(image, all, firstRow, lastRow);
    } else if (firstRow == 0 && lastRow == image.height() && !channel.picked) {
        convertRows(image, style, channel, all);
    } else {
        convertRows(rowsOf(image, firstRow, lastRow, channel), style, channel, all.subspan(firstRow * row, (lastRow - firstRow) * row));
    }
    reduce(firstRow, lastRow);
}

/// Averages 2 x 2 pixels of the screen's colours, level by level, of the rows that changed. An odd last row or column
/// belongs to no average.
void Picture::reduce(std::uint32_t firstRow, std::uint32_t lastRow) {
    for (std::size_t level = 1; level < levels_.size(); ++level) {
        const QImage &from = levels_[level - 1], &to = levels_[level];
        const std::size_t wide = static_cast<std::size_t>(from.width()) * 4, narrow = static_cast<std::size_t>(to.width()) * 4;
        firstRow /= 2;
        lastRow = std::min((lastRow + 1) / 2, static_cast<std::uint32_t>(to.height()));
        for (std::size_t y = firstRow; y < lastRow; ++y) {
            const std::uint8_t* a = bytes_[level - 1]->data() + 2 * y * wide;
            const std::uint8_t* b = a + wide;
            std::uint8_t* out = bytes_[level]->data() + y * narrow;
            for (std::size_t x = 0; x < narrow; x += 4)
                for (std::size_t c = 0; c < 4; ++c) {
                    const std::size_t at = 2 * x + c;
                    out[x + c] = static_cast<std::uint8_t>((a[at] + a[at + 4] + b[at] + b[at + 4] + 2) / 4);
                }
        }
    }
}

ImagePixels::ImagePixels(QObject* parent) : QObject(parent) {
    pool_.setMaxThreadCount(1);
    clock_.start();
    later_.setSingleShot(true);
    connect(&later_, &QTimer::timeout, this, &ImagePixels::refreshNow);
    connect(&bands_, &QTimer::timeout, this, &ImagePixels::convertBand);
}

ImagePixels::~ImagePixels() {
    pool_.clear();
    pool_.waitForDone();
}

void ImagePixels::set(std::shared_ptr<const Image> image, const ImageStyle& style, bool changes) {
    const bool sameImage = image == image_;
    if (sameImage && style == style_) return;
    style_ = style;
    image_ = std::move(image);
    ++generation_;
    bands_.stop();
    pool_.clear();   // conversions that did not begin are stale
    running_ = 0;
    if (!image_ || image_->empty()) {
        picture_ = {};
        invalid_ = {};
        emit pictureChanged();
    } else if (pixelCount(*image_) <= kQuickPixels) {
        if (!sameImage) invalid_ = findInvalid(*image_, style_);
        convertHere();
    } else if (changes) {
        if (!sameImage) invalid_ = {};
        refreshNow();
    } else {
        convertElsewhere();
    }
}

void ImagePixels::refresh() {
    if (later_.isActive() || bands_.isActive()) return;
    const qint64 wait = restUntil_ - clock_.elapsed();
    if (wait > 0) later_.start(static_cast<int>(wait));
    else refreshNow();
}

/// Only this thread may read what changes in place, so it converts in bands of a few milliseconds.
void ImagePixels::refreshNow() {
    if (!image_ || image_->empty()) return;
    ++generation_;
    running_ = 0;
    nextRow_ = 0;
    spent_ = 0;
    if (picture_.isNull() || picture_.full().width() != static_cast<int>(image_->width()) || picture_.full().height() != static_cast<int>(image_->height()))
        picture_ = Picture(image_->width(), image_->height());
    convertBand();
    if (nextRow_ < image_->height()) bands_.start(0);
}

void ImagePixels::convertBand() {
    const qint64 start = clock_.elapsed();
    const auto rows = static_cast<std::uint32_t>(std::max<std::size_t>(1, kQuickPixels / image_->width()));
    const std::uint32_t last = std::min(nextRow_ + rows, image_->height());
    picture_.convert(*image_, style_, nextRow_, last);
    nextRow_ = last;
    spent_ += clock_.elapsed() - start;
    if (nextRow_ < image_->height()) return;
    bands_.stop();
    emit pictureChanged();
    // Painting costs more than converting: with software GL every repaint composes the whole window anew.
    restUntil_ = clock_.elapsed() + kRestMilliseconds + 4 * spent_;
}

void ImagePixels::convertHere() {
    picture_ = Picture(image_->width(), image_->height());
    picture_.convert(*image_, style_, 0, image_->height());
    emit pictureChanged();
}

void ImagePixels::convertElsewhere() {
    running_ = 1;
    pool_.start(QRunnable::create([this, image = image_, style = style_, generation = generation_] {
        Picture picture(image->width(), image->height());
        picture.convert(*image, style, 0, image->height());
        auto invalid = findInvalid(*image, style);
        QMetaObject::invokeMethod(this, [this, generation, picture, invalid = std::move(invalid)] {
            if (generation != generation_) return;
            running_ = 0;
            invalid_ = invalid;
            // Giving back a hundred megabytes takes tens of milliseconds: not in this thread.
            pool_.start(QRunnable::create([before = std::exchange(picture_, picture)] {}));
            emit pictureChanged();
        }, Qt::QueuedConnection);
    }));
}

}  // namespace emca::explorer
