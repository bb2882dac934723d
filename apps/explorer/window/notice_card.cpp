#include "window/notice_card.h"

#include <QApplication>
#include <QHBoxLayout>
#include <QKeyEvent>
#include <QLabel>
#include <QPainter>
#include <QPainterPath>
#include <QPushButton>
#include <QToolBar>
#include <QToolButton>
#include <QVBoxLayout>
#include <algorithm>

#include "base/theme.h"

namespace emca::explorer {
namespace {
constexpr int kWidth = 600;
}

NoticeCard::NoticeCard(Theme& theme, QWidget* window)
    : QFrame(window), theme_(theme), title_(new QLabel), lines_(new QLabel), row_(new QWidget), answers_(new QHBoxLayout(row_)) {
    setObjectName("noticeCard");
    title_->setObjectName("noticeTitle");
    title_->setProperty("role", "title");
    lines_->setObjectName("noticeLines");
    for (QLabel* label : {title_, lines_}) {
        label->setWordWrap(true);
        label->setTextFormat(Qt::PlainText);
        label->setTextInteractionFlags(Qt::TextSelectableByMouse);
        label->setFocusPolicy(Qt::NoFocus);
    }
    auto* close = new QToolButton;
    close->setObjectName("noticeClose");
    close->setStyleSheet("padding: 0; font-size: 18px;");
    close->setFixedSize(26, 26);
    close->setText(QStringLiteral("×"));
    close->setToolTip(tr("Close (Esc)"));
    auto* head = new QHBoxLayout;
    head->setSpacing(Spacing::medium);
    head->addWidget(title_, 1);
    head->addWidget(close, 0, Qt::AlignTop);
    answers_->setContentsMargins(0, Spacing::small, Spacing::small, Spacing::tiny);
    answers_->setSpacing(Spacing::small);
    auto* layout = new QVBoxLayout(this);
    layout->setContentsMargins(Spacing::large + 4, Spacing::small, Spacing::small, Spacing::small);
    layout->setSpacing(Spacing::tiny);
    layout->addLayout(head);
    layout->addWidget(lines_);
    layout->addWidget(row_);
    connect(close, &QToolButton::clicked, this, &NoticeCard::clear);
    window->installEventFilter(this);
    hide();
}

void NoticeCard::present(Tone tone, const QString& title, const QStringList& lines, std::vector<Answer> answers) {
    tone_ = tone;
    title_->setText(title);
    QStringList shown = lines.mid(0, kLines);
    if (lines.size() > kLines) shown << tr("… and %1 more.").arg(lines.size() - kLines);
    lines_->setText(shown.join('\n'));
    lines_->setVisible(!shown.isEmpty());
    for (QPushButton* old : row_->findChildren<QPushButton*>()) old->deleteLater();
    while (QLayoutItem* item = answers_->takeAt(0)) delete item;
    answers_->addStretch(1);
    QPushButton* first = nullptr;
    for (Answer& answer : answers) {
        auto* button = new QPushButton(answer.text, row_);
        button->setProperty("primary", answer.primary);
        button->setToolTip(answer.primary ? tr("%1 (Enter)").arg(answer.text) : answer.text);
        button->setAutoDefault(true);   // Return presses the one that has the focus
        connect(button, &QPushButton::clicked, this, [this, run = std::move(answer.run)] {
            const auto chosen = run;    // clear() ends this button
            clear();
            if (chosen) chosen();
        });
        answers_->addWidget(button);
        if (answer.primary || !first) first = button;
    }
    row_->setVisible(first != nullptr);
    show();
    place();
    raise();
    update();
    if (first) first->setFocus(Qt::OtherFocusReason);
}

void NoticeCard::clear() {
    if (isHidden()) return;
    const bool focused = isAncestorOf(QApplication::focusWidget());
    hide();
    title_->clear();
    lines_->clear();
    if (focused) parentWidget()->setFocus(Qt::OtherFocusReason);
}

QString NoticeCard::text() const {
    if (isHidden()) return {};
    return lines_->text().isEmpty() ? title_->text() : title_->text() + '\n' + lines_->text();
}

void NoticeCard::place() {
    const QWidget& window = *parentWidget();
    const QToolBar* bar = window.findChild<QToolBar*>("toolBar");
    const int top = bar && bar->isVisible() ? bar->geometry().bottom() + 1 + Spacing::medium : Spacing::medium;
    const int width = std::min(kWidth, window.width() - 2 * Spacing::large);
    layout()->activate();
    const int height = layout()->hasHeightForWidth() ? layout()->totalHeightForWidth(width) : sizeHint().height();
    setGeometry((window.width() - width) / 2, top, width, height);
}

/// Esc is a shortcut of the window too; while the card has the focus it is ours.
bool NoticeCard::event(QEvent* event) {
    if (event->type() == QEvent::ShortcutOverride && static_cast<QKeyEvent*>(event)->key() == Qt::Key_Escape) {
        event->accept();
        return true;
    }
    return QFrame::event(event);
}

void NoticeCard::keyPressEvent(QKeyEvent* event) {
    if (event->key() == Qt::Key_Escape) clear();
    else QFrame::keyPressEvent(event);
}

bool NoticeCard::eventFilter(QObject* watched, QEvent* event) {
    if (watched == parentWidget() && event->type() == QEvent::Resize && isVisible()) place();
    return QFrame::eventFilter(watched, event);
}

void NoticeCard::paintEvent(QPaintEvent*) {
    QPainter painter(this);
    painter.setRenderHint(QPainter::Antialiasing);
    const ThemeColors& c = theme_.colors();
    QPainterPath card;
    card.addRoundedRect(QRectF(rect()).adjusted(0.5, 0.5, -0.5, -0.5), 6, 6);
    painter.fillPath(card, c.panel);   // its buttons are raised
    painter.save();
    painter.setClipPath(card);
    painter.fillRect(QRect(0, 0, 4, height()), tone_ == Tone::warning ? c.warning : c.accent);
    painter.restore();
    painter.setPen(c.border);
    painter.drawPath(card);
}

}  // namespace emca::explorer
