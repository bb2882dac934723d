#include "window/shortcut_panel.h"

#include <QAction>
#include <QApplication>
#include <QHeaderView>
#include <QKeyEvent>
#include <QLabel>
#include <QLineEdit>
#include <QMainWindow>
#include <QMenu>
#include <QMenuBar>
#include <QPainter>
#include <QPainterPath>
#include <QTreeWidget>
#include <QVBoxLayout>
#include <algorithm>

#include "base/theme.h"
#include "base/view_keys.h"

namespace emca::explorer {
namespace {

constexpr int kWidth = 620, kHeight = 640, kKeyWidth = 150;
constexpr int kEntryRole = Qt::UserRole;

QString plain(QString text) {
    text.replace("&&", QStringLiteral("\x01")).remove('&').replace('\x01', '&');
    return text.remove(QStringLiteral("…"));
}

QString keysOf(const QAction& action) {
    QStringList all;
    for (const QKeySequence& keys : action.shortcuts())
        if (!keys.isEmpty()) all << keys.toString(QKeySequence::NativeText);
    return all.join(QStringLiteral(", "));
}

void collect(const QMenu& menu, const QString& group, std::vector<ShortcutPanel::Entry>& out) {
    for (QAction* action : menu.actions()) {
        if (action->isSeparator() || action->text().isEmpty()) continue;
        if (!action->menu()) out.push_back({group, plain(action->text()), keysOf(*action), action});
    }
    // After the menu's own entries, so that its group is there once.
    for (QAction* action : menu.actions())
        if (action->menu()) collect(*action->menu(), group + QStringLiteral("  ›  ") + plain(action->text()), out);
}

}  // namespace

std::vector<ShortcutPanel::Entry> ShortcutPanel::entriesOf(const QMainWindow& window) {
    std::vector<Entry> entries;
    for (const QAction* action : window.menuBar()->actions())
        if (action->menu()) collect(*action->menu(), plain(action->menu()->title()), entries);
    // Actions of views that are in no menu.
    for (QAction* action : window.findChildren<QAction*>()) {
        const bool listed = std::ranges::any_of(entries, [&](const Entry& entry) { return entry.action == action; });
        if (!listed && !action->shortcut().isEmpty() && !action->text().isEmpty())
            entries.push_back({tr("Elsewhere"), plain(action->text()), keysOf(*action), action});
    }
    std::vector<Entry> views;
    for (const QWidget* widget : window.findChildren<QWidget*>()) {
        QString title;
        for (const ViewKey& key : viewKeys(*widget, &title)) {
            Entry entry{title, key.meaning, QKeySequence(key.keys).toString(QKeySequence::NativeText), nullptr};
            // Views of one kind share their keys.
            if (std::ranges::none_of(views, [&](const Entry& e) { return e.group == entry.group && e.keys == entry.keys; })) views.push_back(std::move(entry));
        }
    }
    std::ranges::stable_sort(views, {}, &Entry::group);
    entries.insert(entries.end(), views.begin(), views.end());
    return entries;
}

ShortcutPanel::ShortcutPanel(Theme& theme, QMainWindow* window)
    : QFrame(window), theme_(theme), window_(*window), field_(new QLineEdit), list_(new QTreeWidget), none_(new QLabel(tr("Nothing is called that."))) {
    setObjectName("shortcutPanel");
    field_->setPlaceholderText(tr("Find what can be done, or a key"));
    field_->setToolTip(tr("Words or a key; ↑ ↓ choose, Enter does it, Esc closes"));
    field_->setClearButtonEnabled(true);
    field_->installEventFilter(this);
    list_->setColumnCount(2);
    list_->setHeaderHidden(true);
    list_->setRootIsDecorated(false);
    list_->setIndentation(Spacing::medium);
    list_->setFrameShape(QFrame::NoFrame);
    list_->setFocusPolicy(Qt::NoFocus);
    list_->setUniformRowHeights(true);
    list_->setExpandsOnDoubleClick(false);
    list_->setItemsExpandable(false);
    list_->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
    list_->header()->setStretchLastSection(false);
    list_->header()->setSectionResizeMode(0, QHeaderView::Stretch);
    list_->header()->setSectionResizeMode(1, QHeaderView::Fixed);
    list_->header()->resizeSection(1, kKeyWidth);
    none_->setProperty("role", "muted");
    none_->setAlignment(Qt::AlignCenter);
    auto* layout = new QVBoxLayout(this);
    layout->setContentsMargins(Spacing::medium, Spacing::medium, Spacing::medium, Spacing::medium);
    layout->setSpacing(Spacing::small);
    layout->addWidget(field_);
    layout->addWidget(list_, 1);
    layout->addWidget(none_, 1);
    connect(field_, &QLineEdit::textChanged, this, &ShortcutPanel::find);
    connect(field_, &QLineEdit::returnPressed, this, [this] { run(list_->currentItem()); });
    connect(list_, &QTreeWidget::itemClicked, this, [this](QTreeWidgetItem* item) { run(item); });
    window->installEventFilter(this);
    hide();
}

void ShortcutPanel::toggle() {
    if (isVisible()) return clear();
    before_ = QApplication::focusWidget();
    field_->clear();
    fill();
    show();
    place();
    raise();
    field_->setFocus(Qt::ShortcutFocusReason);
}

void ShortcutPanel::clear() {
    hide();
    if (before_) before_->setFocus(Qt::OtherFocusReason);
    else window_.setFocus(Qt::OtherFocusReason);
}

void ShortcutPanel::fill() {
    entries_ = entriesOf(window_);
    list_->clear();
    QTreeWidgetItem* group = nullptr;
    for (std::size_t i = 0; i < entries_.size(); ++i) {
        const Entry& entry = entries_[i];
        if (!group || group->text(0) != entry.group) {
            group = new QTreeWidgetItem(list_, {entry.group});
            group->setFlags(Qt::ItemIsEnabled);
            group->setFont(0, theme_.strongFont());
            group->setFirstColumnSpanned(true);
        }
        auto* item = new QTreeWidgetItem(group, {entry.text, entry.keys});
        item->setData(0, kEntryRole, static_cast<int>(i));
        item->setFont(1, theme_.numberFont());
        item->setTextAlignment(1, Qt::AlignRight | Qt::AlignVCenter);
        const bool can = entry.action && entry.action->isEnabled();
        const QColor quiet = theme_.colors().mutedText;
        item->setForeground(1, quiet);
        if (!can) item->setForeground(0, quiet);
        item->setToolTip(0, !entry.action ? tr("A key of this view, while it has the focus") : can ? tr("Click, or Enter, does it") : tr("Not possible now"));
    }
    list_->expandAll();
    find();
}

void ShortcutPanel::find() {
    const QStringList words = field_->text().simplified().split(' ', Qt::SkipEmptyParts);
    QTreeWidgetItem* first = nullptr;
    for (int g = 0; g < list_->topLevelItemCount(); ++g) {
        QTreeWidgetItem* group = list_->topLevelItem(g);
        bool any = false;
        for (int i = 0; i < group->childCount(); ++i) {
            QTreeWidgetItem* item = group->child(i);
            const QString all = group->text(0) + ' ' + item->text(0) + ' ' + item->text(1);
            // Without words: what has a key. With words: all that can be done.
            const bool shown = words.isEmpty() ? !item->text(1).isEmpty()
                                               : std::ranges::all_of(words, [&](const QString& word) { return all.contains(word, Qt::CaseInsensitive); });
            item->setHidden(!shown);
            any = any || shown;
            if (shown && !first) first = item;
        }
        group->setHidden(!any);
    }
    list_->setCurrentItem(words.isEmpty() ? nullptr : first);
    list_->setVisible(first != nullptr);
    none_->setVisible(first == nullptr);
}

void ShortcutPanel::run(QTreeWidgetItem* item) {
    if (!item || !item->parent()) return;
    const QPointer<QAction> action = entries_[static_cast<std::size_t>(item->data(0, kEntryRole).toInt())].action;
    if (!action || !action->isEnabled()) return;
    clear();   // first: what is done goes to the view that had the focus
    action->trigger();
}

void ShortcutPanel::step(int by) {
    QTreeWidgetItem* item = list_->currentItem();
    const auto next = [&](QTreeWidgetItem* from) {
        if (!from) return list_->topLevelItem(0);
        return by > 0 ? list_->itemBelow(from) : list_->itemAbove(from);
    };
    for (item = next(item); item && (item->isHidden() || !item->parent());) item = next(item);
    if (item) list_->setCurrentItem(item);
}

void ShortcutPanel::place() {
    const QSize room = window_.size();
    const int width = std::min(kWidth, room.width() - 2 * Spacing::large), height = std::min(kHeight, room.height() - 120);
    setGeometry((room.width() - width) / 2, 80, width, height);
}

/// Esc is a shortcut of the window too; while the card has the focus it is ours.
bool ShortcutPanel::event(QEvent* event) {
    if (event->type() == QEvent::ShortcutOverride && static_cast<QKeyEvent*>(event)->key() == Qt::Key_Escape) {
        event->accept();
        return true;
    }
    return QFrame::event(event);
}

bool ShortcutPanel::eventFilter(QObject* watched, QEvent* event) {
    if (watched == &window_ && event->type() == QEvent::Resize && isVisible()) place();
    if (watched == field_ && event->type() == QEvent::ShortcutOverride && static_cast<QKeyEvent*>(event)->key() == Qt::Key_Escape) {
        event->accept();
        return true;
    }
    if (watched == field_ && event->type() == QEvent::KeyPress) {
        switch (static_cast<QKeyEvent*>(event)->key()) {
            case Qt::Key_Escape: clear(); return true;
            case Qt::Key_Up: step(-1); return true;
            case Qt::Key_Down: step(+1); return true;
            default: break;
        }
    }
    return QFrame::eventFilter(watched, event);
}

void ShortcutPanel::paintEvent(QPaintEvent*) {
    QPainter painter(this);
    painter.setRenderHint(QPainter::Antialiasing);
    const ThemeColors& c = theme_.colors();
    QPainterPath card;
    card.addRoundedRect(QRectF(rect()).adjusted(0.5, 0.5, -0.5, -0.5), 6, 6);
    painter.fillPath(card, c.panel);
    painter.setPen(c.border);
    painter.drawPath(card);
}

}  // namespace emca::explorer
