#pragma once

#include <QObject>
#include <QString>

#include <array>
#include <atomic>
#include <memory>
#include <optional>
#include <thread>
#include <vector>

#include "base/listeners.h"
#include "surface_data.h"
#include "surface_style.h"

namespace emca::explorer {

class Theme;

/// What a layer says at one place.
struct SurfaceValue {
    SurfaceHit hit;
    std::uint32_t refinedFace = 0;
    std::array<float, 3> channels{};       ///< one, or three of a colour layer
    double scalar = 0;                     ///< the value, or the luminance of the colour
    float points = 0;                      ///< places that were located on the refined face; 0: filled in from neighbours
};

/// The surface layers of the Dataset as they are shown: the style, and for the shown layer its range, its colours and
/// its numbers, all by emca::analysis. Large fields are prepared beside the GUI thread; after that, everything that
/// setStyle() changes is there when it returns. Knows no OpenGL. GUI thread.
class SurfaceModel : public QObject {
    Q_OBJECT
  public:
    SurfaceModel(client::Dataset& dataset, Theme& theme, QObject* parent = nullptr);
    ~SurfaceModel() override;

    const SurfaceStyle& style() const { return style_; }
    void setStyle(const SurfaceStyle& style);
    /// Of the shown layer; what setStyle() makes of it.
    void setLog(bool log);
    void setLimits(std::optional<SurfaceLimits> limits);   ///< nothing: by percentiles

    /// Null while there is nothing or it is being prepared.
    const std::shared_ptr<const PreparedSurface>& surface() const { return surface_; }
    bool isPreparing() const { return preparing_; }
    /// Why the layers that came cannot be shown; empty if they can.
    const QString& error() const { return error_; }

    /// The layer that colours the scene; null if none.
    const SurfaceLayerData* shown() const;
    bool isColor() const;                                      ///< of the shown one
    /// Of the shown layer: what the colour map spans. [0, 1] without one.
    const analysis::ValueRange& range() const { return range_; }
    bool isRangeByHand() const { return style_.of(style_.layer).limits.has_value(); }
    const analysis::SurfaceStatistics* statistics() const;
    /// One per data face; empty without a shown layer.
    const std::vector<analysis::Color8>& colors() const { return colors_; }
    /// Value of the shown layer there. Nothing without one, and on meshes without data.
    std::optional<SurfaceValue> valueAt(const SurfaceHit& hit) const;
    /// "intersection density, 1/unit²" and the like: the title of the colour bar.
    QString title() const;

  signals:
    void surfaceChanged();   ///< surface(), isPreparing(), error()
    void styleChanged();     ///< the style, or what follows from it: range and colours are up to date

  private:
    void load();
    void cancel();
    void adopt(Result<std::shared_ptr<const PreparedSurface>> result);
    void recolor();
    std::optional<std::size_t> shownIndex() const;

    client::Dataset& dataset_;
    Theme& theme_;
    SurfaceStyle style_;
    std::shared_ptr<const PreparedSurface> surface_;
    QString error_;
    bool preparing_ = false;
    analysis::ValueRange range_;
    std::vector<analysis::Color8> colors_;
    std::thread worker_;
    std::shared_ptr<std::atomic<bool>> cancelled_;
    DatasetListening listening_;
};

}  // namespace emca::explorer
