#pragma once

#include <QImage>
#include <QTimer>
#include <QWidget>

#include "base/listeners.h"
#include "image/image_model.h"

namespace emca::explorer {

class ColorBar;
class CompareBar;
class ImageActions;
class ImageCanvas;
class ImageControls;
class ImageDrop;
class ImageFiles;
class ImageHeader;
class RegionTool;
class StateOverlay;
class Theme;
class ValueLine;

/// The image of the Dataset, alone or against a reference, with its list, controls and values under the cursor. A click
/// selects the pixel. What is shown, and how, is ImageModel's.
class ImageView : public QWidget {
    Q_OBJECT
  public:
    ImageView(client::Dataset& dataset, client::Selection& selection, Theme& theme, QWidget* parent = nullptr);
    ~ImageView() override;

    ImageCanvas& canvas() { return *canvas_; }
    ImageModel& model() { return *model_; }
    ImageActions& imageActions() { return *actions_; }
    ImageFiles& files() { return *files_; }
    const ImagePixels& pixels() const { return model_->pixelsOfImage(); }
    /// Several pixels together: rectangles, Ctrl and clicks.
    RegionTool& regionTool() { return *region_; }
    ValueLine& valueLine() { return *values_; }
    /// For what the window has to say while there is no image, or above it.
    StateOverlay& overlay() { return *overlay_; }
    /// Everything is computed and painted, nothing is being written.
    bool isSettled() const;
    /// The picture as it is shown, in the image's own size: tone or colour map, both sides of a split.
    QImage shownPicture() const;

  public slots:
    void focusSelection();
    void toggleLog();
    /// The next pixel that is NaN, infinite or negative, in reading order after the selected one.
    void goToNextInvalid();
    void saveShown();

  signals:
    void traceAgainWanted();
    /// Files that were dropped on the picture, to be opened as images.
    void openWanted(const QStringList& files);
    /// A file that a person wants as the reference: it becomes one of the Dataset's images, then setReference().
    void openReferenceWanted(const QString& file);

  protected:
    void dragEnterEvent(QDragEnterEvent* event) override;
    void dragMoveEvent(QDragMoveEvent* event) override;
    void dragLeaveEvent(QDragLeaveEvent* event) override;
    void dropEvent(QDropEvent* event) override;

  private:
    void build();
    void connectParts();
    void showDisplay();
    void showComputing();
    void showValues();
    void stepImage(int by);
    void pixelMenu(Pixel pixel, QPoint global);

    client::Dataset& dataset_;
    client::Selection& selection_;
    Theme& theme_;
    ImageModel* model_;
    ImageActions* actions_;
    ImageFiles* files_;
    ImageCanvas* canvas_;
    RegionTool* region_;
    ColorBar* bar_;
    ImageHeader* header_;
    CompareBar* compare_;
    ValueLine* values_;
    ImageControls* controls_;
    StateOverlay* overlay_;            ///< the window's
    StateOverlay* computing_;          ///< of the comparison
    ImageDrop* drop_;
    QTimer patience_;                  ///< what is computed within a moment is not announced
    bool waiting_ = false;             ///< something is computed
    DatasetListening datasetListening_;
    SelectionListening selectionListening_;
};

}  // namespace emca::explorer
