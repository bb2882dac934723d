#pragma once

#include <QWidget>

#include "image/image_display.h"

class QComboBox;
class QDoubleSpinBox;
class QLineEdit;
class QMenu;
class QSlider;
class QStackedWidget;
class QToolButton;

namespace emca::explorer {

class ImageActions;
class ImageModel;
class Theme;

/// The row below the picture: exposure, or range and map of false colour; the channel; the menu of how it is displayed.
class ImageControls : public QWidget {
    Q_OBJECT
  public:
    ImageControls(ImageModel& model, ImageActions& actions, Theme& theme, QWidget* parent = nullptr);

  private:
    QWidget* tonePage();
    QWidget* falseColorPage();
    QMenu* rangeMenu();
    QMenu* channelMenu();
    QMenu* displayMenu();
    void refresh();
    void rangeTyped();
    /// Changes a copy of what is displayed and hands it to the model.
    template <typename Change>
    void change(Change change);
    template <typename Change>
    void addChoice(QMenu* menu, const QString& text, bool on, Change change);

    ImageModel& model_;
    ImageActions& actions_;
    Theme& theme_;
    QStackedWidget* pages_;
    QSlider* exposure_ = nullptr;
    QDoubleSpinBox* exposureValue_ = nullptr;
    QToolButton* falseColor_;
    QToolButton* log_ = nullptr;
    QToolButton* automatic_ = nullptr;
    QComboBox* map_ = nullptr;
    QLineEdit* minimum_ = nullptr;
    QLineEdit* maximum_ = nullptr;
    QToolButton* channel_;
    QToolButton* display_;
};

}  // namespace emca::explorer
