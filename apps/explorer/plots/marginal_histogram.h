#pragma once

#include <QStringList>
#include <QWidget>

#include "plots/points_item.h"

namespace emca::explorer {

class Theme;

/// Histogram of the values of a scatter plot beside it, sharing its y axis: bars of all points with the share of the
/// selected ones on top, and counts in the edge rows. A click on a bar selects its points.
class MarginalHistogram : public QWidget {
    Q_OBJECT
  public:
    /// \param integral  the values are whole numbers: at most one bar for each, with its count
    MarginalHistogram(const ScatterContent& content, const Theme& theme, QWidget* parent);

    void setIntegral(bool integral) { integral_ = integral; }
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
    const analysis::Histogram& bars() const { return all_; }
    const analysis::Histogram& selectedBars() const { return selected_; }
    QSize sizeHint() const override { return {104, 100}; }

  signals:
    /// \param points  of the bar, ascending
    void barClicked(const QVector<quint32>& points, bool add);

  protected:
    void paintEvent(QPaintEvent* event) override;
    void mousePressEvent(QMouseEvent* event) override;
    void mouseMoveEvent(QMouseEvent* event) override;
    void leaveEvent(QEvent* event) override;

  private:
    analysis::Histogram histogramOfSelected() const;
    QRectF barRect(std::size_t bar, std::uint64_t count) const;
    double lengthOf(std::uint64_t count) const;
    /// Count of a bar as long as there is room. A bar that would flatten all others is cut instead, and has a notch.
    std::uint64_t scale() const;
    void paintNotch(QPainter& painter, const QRectF& bar) const;
    void paintRowCount(QPainter& painter, PlotRow row, std::uint64_t count, const QColor& color) const;
    int barAt(QPointF position) const;

    const ScatterContent& content_;
    const Theme& theme_;
    bool integral_ = false;
    QString caption_, one_, several_;
    QStringList names_;
    int top_ = 0, height_ = 0;
    int hovered_ = -1;
    double roomForCount_ = 40;
    bool dimmed_ = false;
    analysis::Histogram all_, selected_;
};

}  // namespace emca::explorer
