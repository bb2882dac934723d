#include "image/image_drop.h"

#include <QFileInfo>
#include <QMimeData>
#include <QPainter>
#include <QUrl>

#include "base/theme.h"

namespace emca::explorer {

ImageDrop::ImageDrop(Theme& theme, QWidget* parent) : QWidget(parent), theme_(theme) {
    setAttribute(Qt::WA_TransparentForMouseEvents);
    hide();
}

QStringList ImageDrop::imagesIn(const QMimeData& data) {
    QStringList files;
    for (const QUrl& url : data.urls()) {
        const QString file = url.toLocalFile();
        if (file.isEmpty() || QFileInfo(file).suffix().compare("emca", Qt::CaseInsensitive) == 0) return {};
        files << file;
    }
    return files;
}

void ImageDrop::present(QPointF at) {
    setGeometry(parentWidget()->rect());
    reference_ = isOnReference(at);
    show();
    raise();
    update();
}

void ImageDrop::paintZone(QPainter& painter, const QRectF& box, const QString& title, const QString& sentence, bool chosen) const {
    const ThemeColors& c = theme_.colors();
    QColor ground = c.panel;
    ground.setAlpha(chosen ? 240 : 205);
    painter.setBrush(ground);
    painter.setPen(QPen(chosen ? c.accent : c.border, chosen ? 2 : 1, chosen ? Qt::SolidLine : Qt::DashLine));
    painter.drawRoundedRect(box, Spacing::radius, Spacing::radius);
    painter.setPen(c.text);
    painter.setFont(theme_.strongFont());
    painter.drawText(box.adjusted(8, 0, -8, -22), Qt::AlignCenter, title);
    painter.setPen(c.mutedText);
    painter.setFont(theme_.font());
    painter.drawText(box.adjusted(8, 26, -8, 0), Qt::AlignCenter | Qt::TextWordWrap, sentence);
}

void ImageDrop::paintEvent(QPaintEvent*) {
    QPainter painter(this);
    painter.setRenderHint(QPainter::Antialiasing);
    const double gap = Spacing::small, half = width() / 2.0;
    const QRectF left(gap, gap, half - 1.5 * gap, height() - 2 * gap), right(half + gap / 2, gap, half - 1.5 * gap, height() - 2 * gap);
    paintZone(painter, left, tr("Open"), tr("and look at it"), !reference_);
    paintZone(painter, right, tr("Use as reference"), tr("and compare with the image"), reference_);
}

}  // namespace emca::explorer
