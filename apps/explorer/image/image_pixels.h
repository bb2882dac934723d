#pragma once

#include <QElapsedTimer>
#include <QImage>
#include <QObject>
#include <QThreadPool>
#include <QTimer>
#include <cstdint>
#include <memory>
#include <vector>

#include "emca/analysis/image_metrics.h"
#include "image/image_display.h"

namespace emca::explorer {

/// Pixels that are no radiance.
struct InvalidPixels {
    static constexpr std::size_t kMarked = 1000;      ///< more rings would hide the image
    std::vector<analysis::FaultyPixel> marked;        ///< the first ones in reading order
    analysis::FaultCounts counts;
};
/// Which channels a style looks at, and whether negative ones are wrong there.
analysis::FaultRules faultRules(const ImageStyle& style);

/// A picture and the same at half, a quarter, … of its size, averaged, for zooms below 1. They share memory with their
/// copies, may be made by any thread, and are drawn by the GUI thread.
class Picture {
  public:
    Picture() = default;
    Picture(std::uint32_t width, std::uint32_t height);
    bool isNull() const { return levels_.empty(); }
    const QImage& full() const { return levels_.front(); }
    /// At most halved so often; fewer times where one pixel is left.
    const QImage& reduced(int halvings) const;
    /// Converts some rows. A whole picture is made of bands, so that the GUI thread can do other things in between.
    void convert(const Image& image, const ImageStyle& style, std::uint32_t firstRow, std::uint32_t lastRow);

  private:
    void reduce(std::uint32_t firstRow, std::uint32_t lastRow);
    std::vector<std::shared_ptr<std::vector<std::uint8_t>>> bytes_;   ///< RGBA, row by row, of each level
    std::vector<QImage> levels_;                                      ///< views of them
};

/// An image as the screen shows it. Large images are converted by another thread while the earlier picture stays; small
/// ones at once; those that change in place (previews) band by band between other events. GUI thread.
class ImagePixels : public QObject {
    Q_OBJECT
  public:
    explicit ImagePixels(QObject* parent = nullptr);
    ~ImagePixels() override;

    /// \param image  null for none
    /// \param changes  it is written to by this thread from time to time: no other thread reads it
    void set(std::shared_ptr<const Image> image, const ImageStyle& style, bool changes = false);
    /// The pixels of a preview changed in place. A few pictures a second are made of them: what comes sooner is shown a
    /// little later. Invalid pixels are counted when the render is complete.
    void refresh();

    const ImageStyle& style() const { return style_; }
    const std::shared_ptr<const Image>& image() const { return image_; }
    const InvalidPixels& invalid() const { return invalid_; }
    /// Null before the first conversion is done.
    const Picture& picture() const { return picture_; }
    /// No conversion is under way.
    bool isReady() const { return running_ == 0 && !later_.isActive() && !bands_.isActive(); }

  signals:
    void pictureChanged();

  private:
    void refreshNow();
    void convertBand();
    void convertHere();
    void convertElsewhere();
    std::shared_ptr<const Image> image_;
    ImageStyle style_;
    InvalidPixels invalid_;
    Picture picture_;
    QTimer later_, bands_;
    QElapsedTimer clock_;
    qint64 restUntil_ = 0;         ///< of clock_, in milliseconds
    qint64 spent_ = 0;             ///< on the bands of a picture, in milliseconds
    std::uint32_t nextRow_ = 0;    ///< of the bands
    QThreadPool pool_;
    std::uint64_t generation_ = 0;
    int running_ = 0;
};

}  // namespace emca::explorer
