#pragma once

#include <QWidget>

#include "plots/points_item.h"

namespace emca::explorer {

class Theme;

/// Histogram of the x values of a scatter plot above it, sharing its x axis: bars of all points with the share of the
/// selected ones on top. A click on a bar selects its points.
class TopHistogram : public QWidget {
    Q_OBJECT
  public:
    TopHistogram(const ScatterContent& content, const Theme& theme, QWidget* parent);

    void setIntegral(bool integral) { integral_ = integral; }
    /// Where the canvas of the plot begins, in this widget's coordinates. Content or place changed.
    void refresh(int left);
    const analysis::Histogram& bars() const { return all_; }
    QSize sizeHint() const override { return {100, 44}; }

  signals:
    /// \param points  of the bar, ascending
    void barClicked(const QVector<quint32>& points, bool add);

  protected:
    void paintEvent(QPaintEvent* event) override;
    void mousePressEvent(QMouseEvent* event) override;
    void mouseMoveEvent(QMouseEvent* event) override;
    void leaveEvent(QEvent* event) override;

  private:
    QRectF barRect(std::size_t bar, std::uint64_t count) const;
    int barAt(QPointF position) const;

    const ScatterContent& content_;
    const Theme& theme_;
    bool integral_ = false;
    int left_ = 0, hovered_ = -1;
    analysis::Histogram all_, selected_;
};

}  // namespace emca::explorer
