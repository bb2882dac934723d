#pragma once

#include <QWidget>

namespace emca::explorer {

class Theme;

/// One line of text that changes often. A QLabel asks for a new layout of everything around it with each text, up to the
/// window, which then paints again; this takes the room that it gets and cuts the text with "…".
class TextLine : public QWidget {
    Q_OBJECT
  public:
    TextLine(const Theme& theme, Qt::Alignment alignment, bool muted, QWidget* parent = nullptr);

    void setText(const QString& text);
    const QString& text() const { return text_; }
    QSize sizeHint() const override;
    QSize minimumSizeHint() const override { return {40, sizeHint().height()}; }

  protected:
    void paintEvent(QPaintEvent* event) override;

  private:
    const Theme& theme_;
    Qt::Alignment alignment_;
    bool muted_;
    QString text_;
};

}  // namespace emca::explorer
