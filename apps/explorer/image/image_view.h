#pragma once

#include <QWidget>

#include "base/listeners.h"
#include "image/image_pixels.h"

class QComboBox;
class QLabel;
class QToolButton;

namespace emca::explorer {

class ColorBar;
class ImageCanvas;
class ImageControls;
class RegionTool;
class StateOverlay;
class Theme;

/// The image of the Dataset with its list, controls and values under the cursor. A click selects the pixel.
class ImageView : public QWidget {
    Q_OBJECT
  public:
    ImageView(client::Dataset& dataset, client::Selection& selection, Theme& theme, QWidget* parent = nullptr);
    ~ImageView() override;

    ImageCanvas& canvas() { return *canvas_; }
    ImageControls& controls() { return *controls_; }
    const ImagePixels& pixels() const { return pixels_; }
    /// Several pixels together: rectangles, Ctrl and clicks.
    RegionTool& regionTool() { return *region_; }
    /// For what the window has to say while there is no image, or above it.
    StateOverlay& overlay() { return *overlay_; }
    /// Everything that is known of a pixel, as the line below the picture and the clipboard have it.
    QString describe(Pixel pixel) const;

  public slots:
    void focusSelection();
    void toggleLog();
    /// The next pixel that is NaN, infinite or negative, in reading order after the selected one.
    void goToNextInvalid();

  signals:
    void traceAgainWanted();

  protected:
    void keyPressEvent(QKeyEvent* event) override;

  private:
    QWidget* header();
    QWidget* infoLine();
    void datasetChanged(std::uint32_t parts);
    void listImages();
    void showImage();
    void applyStyle();
    void automaticRange();
    void showValues();
    void showInvalid();
    void pixelMenu(Pixel pixel, QPoint global);

    client::Dataset& dataset_;
    client::Selection& selection_;
    Theme& theme_;
    ImagePixels pixels_;
    ImageCanvas* canvas_;
    RegionTool* region_;
    ColorBar* bar_;
    ImageControls* controls_;
    QComboBox* images_ = nullptr;
    QToolButton* invalid_ = nullptr;
    QToolButton* zoom_ = nullptr;
    QLabel* position_ = nullptr;
    QLabel* values_ = nullptr;
    QLabel* statistics_ = nullptr;
    StateOverlay* overlay_;
    bool rangeChosen_ = false;   ///< false colour has a range for this image
    DatasetListening datasetListening_;
    SelectionListening selectionListening_;
};

}  // namespace emca::explorer
