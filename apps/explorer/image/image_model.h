#pragma once

#include <QObject>
#include <QSize>
#include <QString>
#include <QThreadPool>
#include <QTimer>
#include <array>
#include <memory>
#include <string>

#include "emca/client/dataset.h"
#include "image/image_content.h"
#include "image/image_pixels.h"

namespace emca::explorer {

class Theme;

/// What the image view shows: the current image of the Dataset, its reference, how they are displayed, and the numbers
/// and pictures of that. What takes long is computed by another thread while the earlier picture stays. GUI thread.
///
/// The reference is one of the Dataset's images; it is forgotten when it leaves the Dataset.
class ImageModel : public QObject {
    Q_OBJECT
  public:
    /// Both outlive this object. \param theme  gets the tone map, which is that of all swatches
    ImageModel(client::Dataset& dataset, Theme& theme, QObject* parent = nullptr);
    ~ImageModel() override;

    /// The view calls it with what a DatasetListening told.
    void datasetChanged(std::uint32_t parts);

    const ImageDisplay& display() const { return display_; }
    void setDisplay(const ImageDisplay& display);
    /// The range is found from what is shown, now and when that changes.
    void setAutomaticRange(double tail);
    void setMode(ImageMode mode);           ///< without a reference only ImageMode::image
    void setMetric(analysis::ImageMetric metric);

    const std::shared_ptr<const RenderedImage>& image() const { return image_; }        ///< null: none
    const std::shared_ptr<const RenderedImage>& reference() const { return reference_; }
    const std::string& referenceTitle() const { return referenceTitle_; }
    /// \param reference  one of the Dataset's images, or null for none. Images become comparable: the mode stays if it can.
    void setReference(std::shared_ptr<const RenderedImage> reference);
    bool sizesDiffer() const;

    /// The picture of the mode; in ImageMode::split the one at the left.
    const ImagePixels& front() const { return *layers_[frontLayer()].pixels; }
    /// The picture at the right in ImageMode::split.
    const ImagePixels& back() const { return *layers_[kReference].pixels; }
    const ImagePixels& pixelsOfImage() const { return *layers_[kImage].pixels; }
    /// The numbers that the front picture shows, and those of the back.
    const ImageContent& content() const { return layers_[frontLayer()].content; }
    const ImageContent& backContent() const { return layers_[kReference].content; }
    /// Size of what is shown, in pixels; also while its numbers are not there yet. Empty without an image.
    QSize size() const;
    /// Of differences with the metric that is chosen, also while they are not shown; null values if not computed.
    const ImageContent& difference() const { return layers_[kDifference].content; }
    /// Why there is nothing to show in this mode, as a sentence; empty if there is, or will be.
    const QString& obstacle() const { return layers_[frontLayer()].obstacle; }
    bool isComputing() const { return layers_[frontLayer()].job != nullptr; }
    double fraction() const { return isComputing() ? layers_[frontLayer()].job->fraction.load() : 0; }
    /// Neither numbers nor pictures are under way.
    bool isSettled() const;

  signals:
    void displayChanged();        ///< display(), image, reference or their channels
    void pictureChanged();        ///< what is painted
    void computingChanged();      ///< isComputing(), fraction() or obstacle()

  private:
    enum LayerId : std::size_t { kImage = 0, kReference = 1, kDifference = 2 };
    struct Layer {
        ImagePixels* pixels = nullptr;
        ContentWish wish;                          ///< of `content`, or of the job
        ImageContent content;
        QString obstacle;
        std::shared_ptr<ContentProgress> job;      ///< null: none
    };
    LayerId frontLayer() const;
    bool isShown(std::size_t layer) const;
    ContentWish wishOf(std::size_t layer) const;
    void update();
    void fill(std::size_t layer);
    void take(std::size_t layer, Result<ImageContent> result);
    void paint(std::size_t layer);
    void clear(std::size_t layer);
    void rangeFor(const Layer& layer, bool fresh);
    void previewChanged();

    client::Dataset& dataset_;
    Theme& theme_;
    ImageDisplay display_;
    std::shared_ptr<const RenderedImage> image_, reference_;
    std::string referenceTitle_;
    bool preview_ = false;                         ///< the image still changes
    std::shared_ptr<const RenderedImage> frozen_;  ///< the preview as it was when it was last compared
    std::array<Layer, 3> layers_;
    QTimer hidden_;                                ///< pictures that are one key away are made when nothing else is to do
    QTimer progress_, previewDifference_;
    QThreadPool pool_;
};

}  // namespace emca::explorer
