#include "base/state_overlay.h"

#include <QEvent>
#include <QLabel>
#include <QPainter>
#include <QProgressBar>
#include <QPushButton>
#include <QVBoxLayout>
#include <QVariant>
#include <algorithm>

#include "base/theme.h"

namespace emca::explorer {

StateOverlay::StateOverlay(Theme& theme, QWidget* parent)
    : QWidget(parent), theme_(theme), title_(new QLabel), sentence_(new QLabel), bar_(new QProgressBar),
      button_(new QPushButton) {
    title_->setProperty("role", "title");
    sentence_->setProperty("role", "muted");
    for (QLabel* label : {title_, sentence_}) {
        label->setAlignment(Qt::AlignCenter);
        label->setWordWrap(true);
    }
    bar_->setTextVisible(false);
    bar_->setFixedHeight(6);
    auto* layout = new QVBoxLayout(this);
    layout->setContentsMargins(Spacing::large, Spacing::medium, Spacing::large, Spacing::medium);
    layout->setSpacing(Spacing::small);
    layout->addStretch(1);
    layout->addWidget(title_);
    layout->addWidget(sentence_);
    layout->addWidget(bar_);
    layout->addWidget(button_, 0, Qt::AlignHCenter);
    layout->addStretch(1);
    connect(button_, &QPushButton::clicked, this, [this] {
        // A copy: the action may present another state, which replaces the stored one.
        if (const auto action = onAction_) action();
    });
    connect(&theme_, &Theme::themeChanged, this, qOverload<>(&QWidget::update));
    parent->installEventFilter(this);
    hide();
}

void StateOverlay::showEmpty(const QString& title, const QString& sentence, const QString& action,
                             std::function<void()> onAction) {
    present(State::empty, title, sentence, action, std::move(onAction));
}

void StateOverlay::showError(const QString& sentence, const QString& action, std::function<void()> onAction) {
    present(State::error, {}, sentence, action, std::move(onAction));
}

void StateOverlay::showBusy(const QString& sentence, double fraction, const QString& action,
                            std::function<void()> onAction) {
    bar_->setRange(0, fraction < 0 ? 0 : 1000);
    if (fraction >= 0) bar_->setValue(static_cast<int>(std::min(fraction, 1.0) * 1000));
    present(State::busy, {}, sentence, action, std::move(onAction));
}

void StateOverlay::clear() {
    state_ = State::none;
    onAction_ = {};
    hide();
}

QString StateOverlay::sentence() const { return state_ == State::none ? QString() : sentence_->text(); }

void StateOverlay::present(State state, const QString& title, const QString& sentence, const QString& action,
                           std::function<void()> onAction) {
    state_ = state;
    onAction_ = std::move(onAction);
    title_->setText(title);
    title_->setVisible(!title.isEmpty());
    sentence_->setText(sentence);
    bar_->setVisible(state == State::busy);
    button_->setText(action);
    button_->setToolTip(action);
    button_->setVisible(!action.isEmpty());
    place();
    show();
    raise();
    update();
}

void StateOverlay::place() {
    const QSize size = parentWidget()->size();
    if (state_ != State::busy) {
        setGeometry(QRect(QPoint(), size));
        return;
    }
    const int width = std::min(320, std::max(120, size.width() - 2 * Spacing::large));
    layout()->activate();
    const int height = heightForWidth(width) > 0 ? heightForWidth(width) : sizeHint().height();
    setGeometry((size.width() - width) / 2, Spacing::large, width, height);
}

bool StateOverlay::eventFilter(QObject* watched, QEvent* event) {
    if (watched == parentWidget() && event->type() == QEvent::Resize && state_ != State::none) place();
    return QWidget::eventFilter(watched, event);
}

void StateOverlay::paintEvent(QPaintEvent*) {
    QPainter painter(this);
    painter.setRenderHint(QPainter::Antialiasing);
    const ThemeColors& c = theme_.colors();
    if (state_ == State::busy) {
        painter.setPen(c.border);
        painter.setBrush(c.panel);
        painter.drawRoundedRect(QRectF(rect()).adjusted(0.5, 0.5, -0.5, -0.5), Spacing::radius, Spacing::radius);
        return;
    }
    painter.fillRect(rect(), c.ground);
}

}  // namespace emca::explorer
