#pragma once

#include "plots/bar_histogram.h"

namespace emca::explorer {

/// Histogram of the x values of a scatter plot above it, sharing its x axis: bars of all points with the share of the
/// selected ones on top. A click on a bar selects its points.
class TopHistogram : public BarHistogram {
    Q_OBJECT
  public:
    TopHistogram(const ScatterContent& content, const Theme& theme, QWidget* parent);

    /// Where the canvas of the plot begins, in this widget's coordinates. Content or place changed.
    void refresh(int left);
    QSize sizeHint() const override { return {100, 44}; }

  protected:
    void paintEvent(QPaintEvent* event) override;
    int barAt(QPointF position) const override;
    QString tip(std::size_t bar) const override;

  private:
    QRectF barRect(std::size_t bar, std::uint64_t count) const;

    int left_ = 0;
};

}  // namespace emca::explorer
