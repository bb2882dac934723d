#pragma once

#include <QWidget>

class QComboBox;
class QToolButton;

namespace emca::client {
class Dataset;
}

namespace emca::explorer {

class ImageModel;
class Theme;

/// The row above the picture: which image, against which reference, invalid pixels, zoom.
class ImageHeader : public QWidget {
    Q_OBJECT
  public:
    ImageHeader(client::Dataset& dataset, ImageModel& model, Theme& theme, QWidget* parent = nullptr);
    void setZoom(double zoom);

  signals:
    void openReferenceWanted();
    void nextInvalidWanted();
    void fitWanted();
    void zoomWanted(double zoom);

  private:
    void listImages();
    void listReferences();
    void showInvalid();
    void referenceChosen(int index);
    client::Dataset& dataset_;
    ImageModel& model_;
    Theme& theme_;
    QComboBox* images_;
    QComboBox* references_;
    QToolButton* invalid_;
    QToolButton* zoom_;
};

}  // namespace emca::explorer
