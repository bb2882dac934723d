#pragma once

#include <QElapsedTimer>
#include <QImage>
#include <QObject>
#include <QThreadPool>
#include <QTimer>
#include <cstdint>
#include <memory>
#include <vector>

#include "emca/analysis/color_map.h"
#include "emca/analysis/tone_map.h"
#include "emca/core/image.h"

namespace emca::explorer {

/// How an image is shown: by a tone map, or as numbers through a colour map.
struct ImageStyle {
    analysis::ToneMap toneMap;
    bool falseColor = false;
    analysis::ColorMapId colorMap = analysis::ColorMapId::viridis;
    analysis::ValueRange range;                       ///< of false colour
    analysis::ChannelChoice channel;
    friend bool operator==(const ImageStyle& a, const ImageStyle& b) {
        return a.toneMap == b.toneMap && a.falseColor == b.falseColor && a.colorMap == b.colorMap && a.range == b.range &&
               a.channel.index == b.channel.index;
    }
};

/// Pixels that are no radiance.
struct InvalidPixels {
    static constexpr std::size_t kListed = 1000;
    std::vector<Pixel> pixels;                        ///< the first `kListed`, in reading order
    std::size_t nan = 0, infinite = 0, negative = 0;  ///< how many there are
    std::size_t count() const { return nan + infinite + negative; }
};
InvalidPixels findInvalid(const Image& image);

/// The image as the screen shows it. Large images are converted by other threads while the earlier picture stays; small
/// ones and changed rows of a preview at once. GUI thread.
class ImagePixels : public QObject {
    Q_OBJECT
  public:
    explicit ImagePixels(QObject* parent = nullptr);
    ~ImagePixels() override;

    /// \param image  null for none
    void set(std::shared_ptr<const RenderedImage> image, const ImageStyle& style);
    /// The pixels of a preview changed in place. A few pictures a second are made of them: what comes sooner is shown a
    /// little later. Invalid pixels are counted when the render is complete.
    void refresh();
    void setStyle(const ImageStyle& style) { set(image_, style); }

    const ImageStyle& style() const { return style_; }
    const std::shared_ptr<const RenderedImage>& image() const { return image_; }
    const InvalidPixels& invalid() const { return invalid_; }
    /// Empty before the first conversion is done.
    const QImage& picture() const { return picture_; }
    /// At most half as wide and high as `picture`, averaged: for zooms below 1/2. Made when first asked for.
    const QImage& reduced(int halvings);
    /// No conversion is under way.
    bool isReady() const { return running_ == 0; }

  signals:
    void pictureChanged();

  private:
    void refreshNow();
    void convertHere();
    void convertElsewhere();
    std::shared_ptr<const RenderedImage> image_;
    ImageStyle style_;
    InvalidPixels invalid_;
    QImage picture_;
    std::vector<QImage> reduced_;
    QTimer later_;
    QElapsedTimer clock_;
    qint64 restUntil_ = 0;         ///< of clock_, in milliseconds
    QThreadPool pool_;
    std::uint64_t generation_ = 0;
    int running_ = 0;
};

}  // namespace emca::explorer
