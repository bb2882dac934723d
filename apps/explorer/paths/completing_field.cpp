#include "paths/completing_field.h"

#include <QAbstractItemView>
#include <QAction>
#include <QCompleter>
#include <QIcon>
#include <QKeyEvent>
#include <QMouseEvent>
#include <QPainter>
#include <QStandardItemModel>
#include <QStyledItemDelegate>
#include <algorithm>
#include <utility>

#include "base/qt_compat.h"
#include "base/theme.h"

namespace emca::explorer {

namespace {

/// As small as the arrows of combo boxes: an action's icon would fill its square.
QIcon smallArrow() {
    constexpr int kSquare = 16, kArrow = 10, kRatio = 2;
    QPixmap square(kSquare * kRatio, kSquare * kRatio);
    square.fill(Qt::transparent);
    QPainter painter(&square);
    constexpr int kMargin = (kSquare - kArrow) / 2 * kRatio;
    QIcon(QStringLiteral(":/emca/symbols/arrow-down.svg")).paint(&painter, square.rect().adjusted(kMargin, kMargin, -kMargin, -kMargin));
    painter.end();
    square.setDevicePixelRatio(kRatio);
    return square;
}

}  // namespace

CompletingField::CompletingField(QWidget* parent)
    : QLineEdit(parent), model_(new QStandardItemModel(this)), completer_(new QCompleter(model_, this)),
      arrow_(addAction(smallArrow(), QLineEdit::TrailingPosition)) {
    completer_->setCaseSensitivity(Qt::CaseInsensitive);
    completer_->setFilterMode(Qt::MatchContains);
    completer_->setMaxVisibleItems(14);
    setCompleter(completer_);
    completer_->popup()->setObjectName(QStringLiteral("completions"));
    // Its own delegate ignores the style sheet.
    completer_->popup()->setItemDelegate(new QStyledItemDelegate(completer_));
    arrow_->setToolTip(tr("Show all"));
    arrow_->setVisible(false);
    connect(arrow_, &QAction::triggered, this, &CompletingField::showAll);
    connect(this, &QLineEdit::textEdited, this, &CompletingField::edited);
    connect(completer_, qOverload<const QString&>(&QCompleter::activated), this, [this](const QString& text) {
        setText(text);
        emit edited();
    });
}

void CompletingField::setChoices(std::vector<Choice> choices) {
    make_ = nullptr;
    if (choices == choices_) return;
    choices_ = std::move(choices);
    fill();
}

void CompletingField::setChoicesLater(std::function<std::vector<Choice>()> make) {
    make_ = std::move(make);
    arrow_->setVisible(true);
}

void CompletingField::makeChoices() {
    if (!make_) return;
    auto made = std::exchange(make_, nullptr)();
    if (made == choices_) return;
    choices_ = std::move(made);
    fill();
}

void CompletingField::fill() {
    model_->clear();
    for (const Choice& choice : choices_) {
        auto* item = new QStandardItem(choice.text);
        item->setToolTip(choice.meaning);
        item->setEditable(false);
        model_->appendRow(item);
    }
    arrow_->setVisible(!choices_.empty() || make_);
}

void CompletingField::showAll() {
    makeChoices();
    if (choices_.empty()) return;
    setFocus();
    completer_->setCompletionPrefix({});
    int widest = width();
    const QFontMetrics metrics(completer_->popup()->font());
    for (const Choice& choice : choices_) widest = std::max(widest, std::min(420, metrics.horizontalAdvance(choice.text) + 36));
    completer_->complete(QRect(0, 0, widest, height()));
}

void CompletingField::mousePressEvent(QMouseEvent* event) {
    QLineEdit::mousePressEvent(event);
    if (text().isEmpty() && event->button() == Qt::LeftButton) showAll();
}

/// What is undone, the window knows: its history holds all fields.
bool CompletingField::event(QEvent* event) {
    if (event->type() == QEvent::ShortcutOverride && isUndoKey(*static_cast<QKeyEvent*>(event))) {
        event->ignore();
        return true;
    }
    return QLineEdit::event(event);
}

void CompletingField::keyPressEvent(QKeyEvent* event) {
    if (event->key() == Qt::Key_Down && !completer_->popup()->isVisible()) {
        showAll();
        return;
    }
    QLineEdit::keyPressEvent(event);
}

void CompletingField::focusInEvent(QFocusEvent* event) {
    makeChoices();
    QLineEdit::focusInEvent(event);
}

}  // namespace emca::explorer
