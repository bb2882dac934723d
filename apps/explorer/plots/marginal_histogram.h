#pragma once

#include <QStringList>

#include "plots/bar_histogram.h"

namespace emca::explorer {

/// Histogram of the values of a scatter plot beside it, sharing its y axis: bars of all points with the share of the
/// selected ones on top, and counts in the edge rows. A click on a bar selects its points.
class MarginalHistogram : public BarHistogram {
    Q_OBJECT
  public:
    MarginalHistogram(const ScatterContent& content, const Theme& theme, QWidget* parent);

    /// What is counted, below the bars; empty: nothing.
    void setCaption(const QString& caption);
    /// What the tool tips count; without it "paths".
    void setCounted(const QString& one, const QString& several);
    /// Words for the whole numbers from 0 on, in the tool tips.
    void setNames(const QStringList& names) { names_ = names; }
    /// Where the canvas of the plot begins and ends, in this widget's coordinates.
    void setCanvas(int top, int height);
    /// The content changed.
    void refresh();
    /// Only which points are selected changed.
    void refreshSelected();
    QSize sizeHint() const override { return {104, 100}; }

  protected:
    void paintEvent(QPaintEvent* event) override;
    int barAt(QPointF position) const override;
    QString tip(std::size_t bar) const override;

  private:
    QRectF barRect(std::size_t bar, std::uint64_t count) const;
    double lengthOf(std::uint64_t count) const;
    /// Count of a bar as long as there is room. A bar that would flatten all others is cut instead, and has a notch.
    std::uint64_t scale() const;
    void paintNotch(QPainter& painter, const QRectF& bar) const;
    void paintRowCount(QPainter& painter, PlotRow row, std::uint64_t count, const QColor& color) const;

    QString caption_, one_, several_;
    QStringList names_;
    int top_ = 0, height_ = 0;
    double roomForCount_ = 40;
    bool dimmed_ = false;
};

}  // namespace emca::explorer
