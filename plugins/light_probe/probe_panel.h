#pragma once

#include <QWidget>
#include <memory>
#include <optional>

#include "probe_canvas.h"
#include "probe_controls.h"

class QLabel;

namespace emca::light_probe {

class ColorStrip;

/// The light probe view (paper, section 3.5.1): what the selected vertex sees in all directions, rendered on request, and
/// the directions that paths took there.
class ProbePanel : public QWidget {
    Q_OBJECT
  public:
    explicit ProbePanel(explorer::PluginContext& context);

    ProbeCanvas& canvas() { return *canvas_; }
    /// The probe that is shown; null before the first one came.
    std::shared_ptr<const probe::LightProbe> probe() const { return probe_; }
    bool isStale() const;
    /// .exr: radiance; .png: the picture as shown. Errors: those of imageio::write.
    Result<void> saveTo(const QString& file);

  public slots:
    void requestProbe();
    void stop();

  protected:
    void keyPressEvent(QKeyEvent* event) override;
    void showEvent(QShowEvent* event) override;

  private:
    void follow();                     ///< the selection or the data changed
    void received(Result<std::vector<std::byte>> reply, const ProbeVertex& vertex);
    void showView();
    void showStyle();
    void showState();
    void showValues();
    void showDirectionInScene();
    void save();
    QString obstacle() const;          ///< why nothing can be asked for; empty if it can

    explorer::PluginContext& context_;
    RequestControls* request_;
    ProbeCanvas* canvas_;
    DirectionLegend* legend_;
    ColorStrip* strip_;
    QWidget* range_;
    LookControls* look_;
    QLabel* place_;
    QLabel* values_;

    VertexAnswer selected_;
    std::optional<ProbeVertex> shown_; ///< whose probe it is
    std::shared_ptr<const probe::LightProbe> probe_;
    bool asking_ = false;
    explorer::Task task_;
    explorer::Subscription onDataset_, onSelection_, onLook_, onSettings_;
};

}  // namespace emca::light_probe
