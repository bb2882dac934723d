#include "base/text_line.h"

#include <QPainter>

#include "base/theme.h"

namespace emca::explorer {

TextLine::TextLine(const Theme& theme, Qt::Alignment alignment, bool muted, QWidget* parent)
    : QWidget(parent), theme_(theme), alignment_(alignment), muted_(muted) {
    setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
    connect(&theme, &Theme::themeChanged, this, qOverload<>(&QWidget::update));
}

void TextLine::setText(const QString& text) {
    if (text == text_) return;
    text_ = text;
    update();
}

QSize TextLine::sizeHint() const { return {200, QFontMetrics(theme_.font()).height() + 4}; }

void TextLine::paintEvent(QPaintEvent*) {
    QPainter painter(this);
    painter.setFont(theme_.font());
    painter.setPen(muted_ ? theme_.colors().mutedText : theme_.colors().text);
    painter.drawText(rect(), int(alignment_ | Qt::AlignVCenter),
                     QFontMetrics(theme_.font()).elidedText(text_, Qt::ElideRight, width()));
}

}  // namespace emca::explorer
