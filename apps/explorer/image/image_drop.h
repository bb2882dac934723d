#pragma once

#include <QStringList>
#include <QWidget>

class QMimeData;

namespace emca::explorer {

class Theme;

/// What files become that are dragged over the picture: its left half opens them, its right half makes the first one the
/// reference. Lies over its parent while files are over it.
class ImageDrop : public QWidget {
    Q_OBJECT
  public:
    ImageDrop(Theme& theme, QWidget* parent);

    /// Files on this machine; empty if there are others, or sessions, which are the window's.
    static QStringList imagesIn(const QMimeData& data);
    void present(QPointF at);
    bool isOnReference(QPointF at) const { return at.x() > width() / 2.0; }

  protected:
    void paintEvent(QPaintEvent* event) override;

  private:
    void paintZone(QPainter& painter, const QRectF& box, const QString& title, const QString& sentence, bool chosen) const;
    Theme& theme_;
    bool reference_ = false;
};

}  // namespace emca::explorer
