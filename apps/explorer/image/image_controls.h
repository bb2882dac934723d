#pragma once

#include <QWidget>

#include "image/image_pixels.h"

class QComboBox;
class QDoubleSpinBox;
class QLineEdit;
class QMenu;
class QSlider;
class QStackedWidget;
class QToolButton;

namespace emca::explorer {

class Theme;

/// The row below the picture: exposure, or the range and map of false colour, and the menu of what is shown.
class ImageControls : public QWidget {
    Q_OBJECT
  public:
    explicit ImageControls(Theme& theme, QWidget* parent = nullptr);

    const ImageStyle& style() const { return style_; }
    void setStyle(const ImageStyle& style);
    /// Names offered besides luminance.
    void setChannels(const std::vector<std::string>& channels);

  public slots:
    void changeExposure(double byStops);
    void toggleFalseColor();
    void toggleLog();

  signals:
    void styleChanged();
    /// The range shall be found from the image.
    void automaticRangeWanted();

  private:
    QWidget* tonePage();
    QWidget* falseColorPage();
    QMenu* displayMenu();
    void edited(const ImageStyle& style);
    void showStyle();
    void rangeTyped();

    Theme& theme_;
    ImageStyle style_;
    std::vector<std::string> channels_;
    QStackedWidget* pages_;
    QSlider* exposure_ = nullptr;
    QDoubleSpinBox* exposureValue_ = nullptr;
    QToolButton* falseColor_;
    QToolButton* log_ = nullptr;
    QComboBox* map_ = nullptr;
    QLineEdit* minimum_ = nullptr;
    QLineEdit* maximum_ = nullptr;
    QToolButton* display_;
};

}  // namespace emca::explorer
