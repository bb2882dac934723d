#pragma once

#include <QWidget>
#include <optional>
#include <vector>

#include "base/plot_export.h"
#include "image/region_numbers.h"

namespace emca::explorer {

class Theme;

/// How often which value occurs in a region: colours as outlines, luminance as an area, the reference's luminance dashed.
/// What lies beyond the range is counted at the edge. L: logarithmic values.
class RegionHistogram : public QWidget {
    Q_OBJECT
  public:
    explicit RegionHistogram(Theme& theme, QWidget* parent = nullptr);

    /// \param title  what pixels: stands in exported pictures
    void show(const RegionNumbers& numbers, const QString& title);
    void setLogCounts(bool log);
    bool logCounts() const { return logCounts_; }
    /// What stands under the cursor: the values of a bin, and how many pixels have them.
    QString describe(std::size_t bin) const;
    std::size_t binCount() const { return channels_.empty() ? 0 : channels_.front().histogram.binCount(); }
    /// The bins: ends, and for each channel how many pixels; a bin without an end is what lies beyond.
    QString csv() const;
    /// PNG, SVG or CSV by the ending of the name. Errors: fileUnwritable.
    Result<void> exportTo(const QString& file, int scale = 2);
    PlotExport exporting();
    QSize sizeHint() const override { return {320, 150}; }
    QSize minimumSizeHint() const override { return {160, 96}; }

  signals:
    /// What was copied or written, or why not.
    void message(const QString& sentence);

  protected:
    bool event(QEvent* event) override;
    void keyPressEvent(QKeyEvent* event) override;
    void contextMenuEvent(QContextMenuEvent* event) override;
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
    void paintCaption(QPainter& painter) const;

    Theme& theme_;
    std::vector<RegionChannel> channels_;
    std::uint64_t largest_ = 0;
    QString title_;
    bool logCounts_ = false, exporting_ = false;
    std::optional<std::size_t> hovered_;
};

}  // namespace emca::explorer
