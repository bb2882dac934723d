#pragma once

#include <QWidget>

#include <set>
#include <string>
#include <vector>

#include "base/listeners.h"
#include "base/theme.h"
#include "surface_model.h"

class QCheckBox;
class QComboBox;
class QDoubleSpinBox;
class QFormLayout;
class QGridLayout;
class QLabel;
class QLineEdit;
class QPushButton;
class QSlider;
class QVBoxLayout;

namespace emca::explorer {

/// 3D data on surfaces, for a dock (which scrolls it): which layers the next render collects, which of the collected
/// ones colours the scene, with which colours, and what its numbers are.
class SurfacePanel : public QWidget {
    Q_OBJECT
  public:
    SurfacePanel(client::Dataset& dataset, SurfaceModel& model, Theme& theme, QWidget* parent = nullptr);

    /// Names that the next render shall collect: those ticked, as far as the renderer offers them.
    std::vector<std::string> wantedLayers() const;
    /// May come before the renderer is known. The one word "all": every layer that the renderer offers.
    void setWantedLayers(const std::vector<std::string>& names);
    /// Whether the button works: a renderer is connected.
    void setCanRender(bool can);

  signals:
    void wantedLayersChanged();
    void renderWanted();

  private:
    QVBoxLayout* section(const QString& title);
    void addColors(QVBoxLayout* into);
    QWidget* rangeRow();
    QWidget* percentRow();
    QWidget* sliderRow(QSlider*& slider, QWidget* value);
    void rebuildList();
    void addRow(int row, const LayerDescription& layer, bool offered, bool collected);
    void showList();
    void showStyle();
    void showNumbers();
    void showWanted();
    void rangeTyped();
    void complain(const QString& sentence);
    bool offers(const std::string& layer) const;

    client::Dataset& dataset_;
    SurfaceModel& model_;
    Theme& theme_;
    std::set<std::string> wanted_;
    bool wantsAll_ = false, canRender_ = false, reading_ = false;

    QVBoxLayout* column_;
    QLabel* none_;                    ///< what to do while there is nothing to choose
    QWidget* list_ = nullptr;
    QVBoxLayout* listPlace_;
    QPushButton* render_;
    QWidget* colors_;
    QFormLayout* form_;
    QComboBox* map_;
    QCheckBox* log_;
    QLineEdit *minimum_, *maximum_;
    QPushButton* automatic_;
    QDoubleSpinBox *lower_, *upper_;
    QSlider *exposure_, *opacity_;
    QDoubleSpinBox* exposureValue_;
    QLabel* opacityValue_;
    QLabel* complaint_;
    std::vector<QWidget*> scalarRows_, colorRows_;
    QWidget* numbers_;
    QGridLayout* numberGrid_;
    QLabel* coarse_;
    DatasetListening listening_;      // last: no call while the rest is destroyed
};

}  // namespace emca::explorer
