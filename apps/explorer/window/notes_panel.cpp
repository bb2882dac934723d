#include "window/notes_panel.h"

#include <QLabel>
#include <QListWidget>
#include <QPlainTextEdit>
#include <QScopedValueRollback>
#include <QVBoxLayout>
#include <QVariant>

#include "base/qt_compat.h"
#include "base/theme.h"
#include "emca/analysis/format.h"
#include "session/session_controller.h"

namespace emca::explorer {
namespace {

constexpr int kListHeight = 132;
constexpr int kPixelRole = Qt::UserRole;

QLabel* title(const QString& text) {
    auto* made = new QLabel(text);
    made->setProperty("role", "title");
    return made;
}

QPlainTextEdit* field(const QString& name, const QString& placeholder, const QString& tip) {
    auto* made = new QPlainTextEdit;
    made->setObjectName(name);
    made->setPlaceholderText(placeholder);
    made->setToolTip(tip);
    made->setTabChangesFocus(true);
    made->setMinimumHeight(48);
    return made;
}

/// Writes a text without moving the cursor of who is typing it.
void put(QPlainTextEdit& where, const std::string& text) {
    if (where.toPlainText().toStdString() != text) where.setPlainText(toQString(text));
}

}  // namespace

NotesPanel::NotesPanel(client::Selection& selection, SessionController& session, Theme& theme, QWidget* parent)
    : QWidget(parent), selection_(selection), session_(session),
      sessionNotes_(field("sessionNotes", tr("What is this about? What was found?"), tr("About the whole session; saved with it (Ctrl+S)"))),
      pixelTitle_(title({})), pixelNotes_(field("pixelNotes", {}, tr("About the selected pixel; saved with the session (Ctrl+S)"))),
      listTitle_(title(tr("Pixels with notes"))), list_(new QListWidget),
      selectionListening_(selection, [this](std::uint32_t parts) {
          if (parts & client::SelectionPart::pixel) showPixel();
      }) {
    list_->setObjectName("notedPixels");
    list_->setToolTip(tr("A click selects the pixel"));
    list_->setFont(theme.numberFont());
    list_->setMaximumHeight(kListHeight);
    list_->setTextElideMode(Qt::ElideRight);
    list_->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
    auto* layout = new QVBoxLayout(this);
    layout->setContentsMargins(Spacing::medium, Spacing::small, Spacing::medium, Spacing::small);
    layout->setSpacing(Spacing::tiny);
    layout->addWidget(title(tr("Session")));
    layout->addWidget(sessionNotes_, 3);
    layout->addSpacing(Spacing::tiny);
    layout->addWidget(pixelTitle_);
    layout->addWidget(pixelNotes_, 2);
    layout->addSpacing(Spacing::tiny);
    layout->addWidget(listTitle_);
    layout->addWidget(list_);
    connect(sessionNotes_, &QPlainTextEdit::textChanged, this, [this] {
        if (!writing_) session_.setNotes(sessionNotes_->toPlainText().toStdString());
    });
    connect(pixelNotes_, &QPlainTextEdit::textChanged, this, [this] {
        if (!writing_ && selection_.state().pixel) session_.setPixelNote(*selection_.state().pixel, pixelNotes_->toPlainText().toStdString());
    });
    connect(list_, &QListWidget::itemClicked, this, [this](QListWidgetItem* item) {
        const QPoint at = item->data(kPixelRole).toPoint();
        selection_.setPixel(Pixel{static_cast<std::uint32_t>(at.x()), static_cast<std::uint32_t>(at.y())});
    });
    connect(list_, &QListWidget::itemActivated, list_, &QListWidget::itemClicked);
    connect(&session_, &SessionController::notesChanged, this, &NotesPanel::showNotes);
    showNotes();
}

void NotesPanel::showNotes() {
    {
        const QScopedValueRollback<bool> guard(writing_, true);
        put(*sessionNotes_, session_.notes());
    }
    showPixel();
    fill();
}

void NotesPanel::showPixel() {
    const QScopedValueRollback<bool> guard(writing_, true);
    const auto pixel = selection_.state().pixel;
    pixelTitle_->setText(pixel ? tr("Pixel %1").arg(toQString(analysis::formatPixel(*pixel))) : tr("Pixel"));
    pixelNotes_->setEnabled(pixel.has_value());
    pixelNotes_->setPlaceholderText(pixel ? tr("What is wrong with it?") : tr("Click a pixel in the image"));
    put(*pixelNotes_, pixel ? session_.pixelNote(*pixel) : std::string());
}

void NotesPanel::fill() {
    list_->clear();
    for (const client::PixelNote& note : session_.pixelNotes()) {
        const QString first = toQString(note.text).section('\n', 0, 0).simplified();
        auto* item = new QListWidgetItem(toQString(analysis::formatPixel(note.pixel)) + QStringLiteral("   ") + first, list_);
        item->setData(kPixelRole, QPoint(static_cast<int>(note.pixel.x), static_cast<int>(note.pixel.y)));
        item->setToolTip(toQString(note.text));
    }
    listTitle_->setVisible(list_->count() > 0);
    list_->setVisible(list_->count() > 0);
}

}  // namespace emca::explorer
