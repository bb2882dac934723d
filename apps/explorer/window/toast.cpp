#include "window/toast.h"

#include <QEvent>
#include <QHBoxLayout>
#include <QLabel>
#include <QPainter>
#include <QPainterPath>
#include <QPushButton>
#include <QToolButton>
#include <algorithm>

#include "base/theme.h"

namespace emca::explorer {
namespace {
constexpr int kRemarkMilliseconds = 5000, kMaximumWidth = 720, kAboveStatusBar = 40;
}

Toast::Toast(Theme& theme, QWidget* window)
    : QFrame(window), theme_(theme), label_(new QLabel), button_(new QPushButton) {
    label_->setWordWrap(true);
    label_->setTextInteractionFlags(Qt::TextSelectableByMouse);
    auto* close = new QToolButton;
    close->setStyleSheet("padding: 0; font-size: 18px;");
    close->setFixedSize(26, 26);
    close->setText(QStringLiteral("×"));
    close->setToolTip(tr("Close"));
    auto* layout = new QHBoxLayout(this);
    layout->setContentsMargins(Spacing::large, Spacing::small, Spacing::small, Spacing::small);
    layout->setSpacing(Spacing::medium);
    layout->addWidget(label_, 1);
    layout->addWidget(button_);
    layout->addWidget(close);
    connect(close, &QToolButton::clicked, this, &Toast::clear);
    connect(button_, &QPushButton::clicked, this, [this] {
        const auto action = onAction_;
        clear();
        if (action) action();
    });
    timer_.setSingleShot(true);
    connect(&timer_, &QTimer::timeout, this, &Toast::clear);
    window->installEventFilter(this);
    hide();
}

void Toast::showError(const QString& sentence, const QString& action, std::function<void()> onAction) {
    timer_.stop();
    present(sentence, action, std::move(onAction), true);
}

void Toast::showRemark(const QString& sentence) {
    present(sentence, {}, {}, false);
    timer_.start(kRemarkMilliseconds);
}

void Toast::clear() {
    onAction_ = {};
    label_->clear();
    hide();
}

QString Toast::sentence() const { return label_->text(); }

void Toast::present(const QString& sentence, const QString& action, std::function<void()> onAction, bool error) {
    error_ = error;
    onAction_ = std::move(onAction);
    label_->setText(sentence);
    button_->setText(action);
    button_->setToolTip(action);
    button_->setVisible(!action.isEmpty());
    show();
    place();
    raise();
    update();
}

void Toast::place() {
    const QSize window = parentWidget()->size();
    const int natural = label_->fontMetrics().horizontalAdvance(label_->text()) + (button_->isVisible() ? button_->sizeHint().width() : 0) + 110;
    const int width = std::min({natural, kMaximumWidth, window.width() - 2 * Spacing::large});
    layout()->activate();
    const int height = std::max(44, layout()->hasHeightForWidth() ? layout()->heightForWidth(width) : sizeHint().height());
    setGeometry((window.width() - width) / 2, window.height() - height - kAboveStatusBar, width, height);
}

bool Toast::eventFilter(QObject* watched, QEvent* event) {
    if (watched == parentWidget() && event->type() == QEvent::Resize && isVisible()) place();
    return QFrame::eventFilter(watched, event);
}

void Toast::paintEvent(QPaintEvent*) {
    QPainter painter(this);
    painter.setRenderHint(QPainter::Antialiasing);
    const ThemeColors& c = theme_.colors();
    QPainterPath card;
    card.addRoundedRect(QRectF(rect()).adjusted(0.5, 0.5, -0.5, -0.5), 6, 6);
    painter.fillPath(card, c.raised);
    painter.save();
    painter.setClipPath(card);
    painter.fillRect(QRect(0, 0, 4, height()), error_ ? c.error : c.accent);
    painter.restore();
    painter.setPen(c.border);
    painter.drawPath(card);
}

}  // namespace emca::explorer
