#include "paths/query_field.h"

#include <QFontDatabase>
#include <QKeyEvent>
#include <QTextBlock>
#include <algorithm>

#include "base/qt_compat.h"
#include "base/theme.h"

namespace emca::explorer {

QueryField::QueryField(Theme& theme, QWidget* parent) : QPlainTextEdit(parent), theme_(theme) {
    setUndoRedoEnabled(false);   // one history for all of the window
    setTabChangesFocus(true);
    setLineWrapMode(QPlainTextEdit::WidgetWidth);
    setVerticalScrollBarPolicy(Qt::ScrollBarAsNeeded);
    setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
    restyle();
    connect(&theme_, &Theme::themeChanged, this, &QueryField::restyle);
}

void QueryField::restyle() {
    QFont mono = QFontDatabase::systemFont(QFontDatabase::FixedFont);
    mono.setPixelSize(std::max(11, QFontInfo(theme_.font()).pixelSize()));
    setFont(mono);
    auto selections = extraSelections();
    for (auto& selection : selections) selection.format.setUnderlineColor(theme_.colors().error);
    setExtraSelections(selections);
}

QSize QueryField::sizeHint() const {
    return {240, 4 * QFontMetrics(font()).lineSpacing() + 2 * Spacing::small + 2};
}

void QueryField::write(const QString& text) {
    if (text == toPlainText()) return;
    QTextCursor cursor(document());
    cursor.select(QTextCursor::Document);
    cursor.insertText(text);
}

void QueryField::underline(query::SourceRange where) {
    const std::string bytes = text();
    const auto place = [&](std::uint32_t byte) {
        return static_cast<int>(QString::fromUtf8(bytes.data(), static_cast<int>(std::min<std::size_t>(byte, bytes.size()))).size());
    };
    int begin = place(where.begin), end = place(where.end);
    // An error at the end of the text has no piece of its own: the character before it shows where.
    if (end <= begin) {
        end = std::min(begin + 1, static_cast<int>(toPlainText().size()));
        begin = std::max(0, end - 1);
    }
    QTextEdit::ExtraSelection selection;
    selection.cursor = QTextCursor(document());
    selection.cursor.setPosition(begin);
    selection.cursor.setPosition(end, QTextCursor::KeepAnchor);
    selection.format.setUnderlineStyle(QTextCharFormat::WaveUnderline);
    selection.format.setUnderlineColor(theme_.colors().error);
    QColor ground = theme_.colors().error;
    ground.setAlpha(48);
    selection.format.setBackground(ground);
    setExtraSelections({selection});
}

void QueryField::removeUnderline() { setExtraSelections({}); }

QString QueryField::underlined() const {
    const auto selections = extraSelections();
    return selections.isEmpty() ? QString() : selections.front().cursor.selectedText();
}

bool QueryField::event(QEvent* event) {
    if (event->type() == QEvent::ShortcutOverride && isUndoKey(*static_cast<QKeyEvent*>(event))) {
        event->ignore();
        return true;
    }
    return QPlainTextEdit::event(event);
}

void QueryField::keyPressEvent(QKeyEvent* event) {
    if ((event->key() == Qt::Key_Return || event->key() == Qt::Key_Enter) && !(event->modifiers() & Qt::ShiftModifier)) {
        emit accepted();
        return;
    }
    QPlainTextEdit::keyPressEvent(event);
}

}  // namespace emca::explorer
