#pragma once

#include <QWidget>
#include <vector>

#include "plots/points_item.h"

namespace emca::explorer {

class Theme;

/// What the histograms beside a scatter plot share: the bars of all points and of the selected ones, the bar under the
/// mouse, and clicks on bars.
class BarHistogram : public QWidget {
    Q_OBJECT
  public:
    /// The values are whole numbers: at most one bar for each.
    void setIntegral(bool integral) { integral_ = integral; }
    const analysis::Histogram& bars() const { return all_; }
    const analysis::Histogram& selectedBars() const { return selected_; }

  signals:
    /// \param points  of the bar, ascending
    void barClicked(const QVector<quint32>& points, bool add);

  protected:
    /// \param values  of `content`, that are counted
    BarHistogram(const ScatterContent& content, const std::vector<double>& values, const Theme& theme, QWidget* parent);

    void count(analysis::ValueRange range, std::size_t bins);
    analysis::Histogram histogramOfSelected() const;
    /// The bar of a position, or -1.
    virtual int barAt(QPointF position) const = 0;
    virtual QString tip(std::size_t bar) const = 0;

    void mousePressEvent(QMouseEvent* event) override;
    void mouseMoveEvent(QMouseEvent* event) override;
    void leaveEvent(QEvent* event) override;

    const ScatterContent& content_;
    const Theme& theme_;
    bool integral_ = false;
    int hovered_ = -1;
    analysis::Histogram all_, selected_;

  private:
    const std::vector<double>& values_;
};

}  // namespace emca::explorer
