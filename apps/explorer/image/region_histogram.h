#pragma once

#include <QWidget>
#include <optional>
#include <vector>

#include "image/region_numbers.h"

namespace emca::explorer {

class Theme;

/// How often which value occurs in a region: colours as outlines, luminance as an area, the reference's luminance dashed.
/// What lies beyond the range is counted at the edge. L: logarithmic values.
class RegionHistogram : public QWidget {
    Q_OBJECT
  public:
    explicit RegionHistogram(Theme& theme, QWidget* parent = nullptr);

    void show(const RegionNumbers& numbers);
    void setLogCounts(bool log);
    bool logCounts() const { return logCounts_; }
    /// What stands under the cursor: the values of a bin, and how many pixels have them.
    QString describe(std::size_t bin) const;
    std::size_t binCount() const { return channels_.empty() ? 0 : channels_.front().histogram.binCount(); }
    QSize sizeHint() const override { return {320, 150}; }
    QSize minimumSizeHint() const override { return {160, 96}; }

  protected:
    void paintEvent(QPaintEvent* event) override;
    void mouseMoveEvent(QMouseEvent* event) override;
    void leaveEvent(QEvent* event) override;

  private:
    QRectF plotArea() const;
    double height(std::uint64_t count) const;   ///< in [0, 1]
    QPolygonF outline(const analysis::Histogram& histogram, const QRectF& area) const;
    QColor colorOf(const std::string& channel) const;
    void paintAxis(QPainter& painter, const QRectF& area) const;
    void paintBeyond(QPainter& painter, const QRectF& area) const;

    Theme& theme_;
    std::vector<RegionChannel> channels_;
    std::uint64_t largest_ = 0;
    bool logCounts_ = false;
    std::optional<std::size_t> hovered_;
};

}  // namespace emca::explorer
