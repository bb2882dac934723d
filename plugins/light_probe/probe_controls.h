#pragma once

#include <QWidget>
#include <array>

#include "probe_canvas.h"

class QComboBox;
class QDoubleSpinBox;
class QLineEdit;
class QProgressBar;
class QPushButton;
class QSpinBox;
class QStackedWidget;
class QToolButton;

namespace emca::light_probe {

/// What to ask for: size, samples, depth, now or always. Kept in the plugin's settings.
class RequestControls : public QWidget {
    Q_OBJECT
  public:
    explicit RequestControls(explorer::PluginContext& context, QWidget* parent = nullptr);
    void read();                                   ///< from the settings
    std::uint32_t imageWidth() const;              ///< pixels; the height is half of it
    std::uint32_t samples() const;
    std::int32_t depth() const;                    ///< as LightProbeRequest::maximumDepth
    bool isAutomatic() const;
    /// \param fraction  of the request that runs; negative: none does
    void setProgress(double fraction);
    void setPossible(bool possible);

  signals:
    void updateWanted();
    void stopWanted();
    void changed();                                ///< size, samples or depth
    void automaticChanged();
    void saveWanted();

  private:
    void write();
    explorer::PluginContext& context_;
    QPushButton* update_;
    QToolButton* automatic_;
    QToolButton* save_;
    QComboBox* size_;
    QSpinBox* samples_;
    QSpinBox* depth_;
    QProgressBar* progress_;
    bool running_ = false, reading_ = false;
};

/// How it is shown: projection, orientation, exposure or false colour, which directions.
class LookControls : public QWidget {
    Q_OBJECT
  public:
    explicit LookControls(explorer::PluginContext& context, QWidget* parent = nullptr);
    void read();
    Projection projection() const;
    Orientation orientation() const;
    bool falseColor() const;
    bool logarithmic() const;
    analysis::ColorMapId map() const;
    double exposure() const;                       ///< stops, on top of the image's
    /// What was typed as range; nothing: automatic.
    std::optional<analysis::ValueRange> typedRange() const;
    void showRange(const analysis::ValueRange& range);
    /// The ends of the range, to stand beside the colours; whoever lays them out owns them.
    QLineEdit* minimum() const { return minimum_; }
    QLineEdit* maximum() const { return maximum_; }

  public slots:
    void changeExposure(double stops);
    void toggleFalseColor();
    void toggleLog();

  signals:
    void viewChanged();
    void styleChanged();

  private:
    QWidget* exposurePage();
    QWidget* falseColorPage();
    void write();
    explorer::PluginContext& context_;
    QComboBox* projection_;
    QComboBox* orientation_;
    QToolButton* falseColor_;
    QStackedWidget* pages_;
    QDoubleSpinBox* exposure_;
    QComboBox* map_;
    QLineEdit* minimum_;
    QLineEdit* maximum_;
    QToolButton* log_;
    QToolButton* automatic_;
    bool reading_ = false, typed_ = false;
};

/// The legend, which is also the switches of the directions.
class DirectionLegend : public QWidget {
    Q_OBJECT
  public:
    explicit DirectionLegend(explorer::PluginContext& context, QWidget* parent = nullptr);
    void read();
    bool isShown(DirectionKind kind) const;
    void restyle();

  signals:
    void changed();

  private:
    explorer::PluginContext& context_;
    std::array<QToolButton*, kDirectionKinds> buttons_{};
    bool reading_ = false;
};

}  // namespace emca::light_probe
