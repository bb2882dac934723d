#pragma once

#include <QWidget>

namespace emca::explorer {

class Theme;
struct ScatterContent;

/// The mean of a scatter plot in words, beside the canvas at the height of its line, where it covers no point. A mean
/// beyond the range stands at the edge with an arrow.
class MeanLabel : public QWidget {
    Q_OBJECT
  public:
    MeanLabel(const ScatterContent& content, const Theme& theme, QWidget* parent);

    /// The content changed. \param top  of the canvas in this widget's coordinates
    void setCanvasTop(int top);
    QSize sizeHint() const override;

  protected:
    void paintEvent(QPaintEvent* event) override;

  private:
    const ScatterContent& content_;
    const Theme& theme_;
    int top_ = 0;
};

}  // namespace emca::explorer
