#include "window/layouts.h"

#include <QAction>
#include <QMainWindow>
#include <QMenu>
#include <QSettings>
#include <QUrl>
#include <algorithm>

#include "window/layout_plan.h"
#include "window/name_panel.h"
#include "window/panel_dock.h"

namespace emca::explorer {
namespace {

/// Raised only when a name of a dock changes its meaning: new docks are placed, missing ones are waited for.
constexpr int kVersion = 4;
constexpr const char *kLast = "window", *kOwnLayouts = "layouts";

}  // namespace

Layouts::Layouts(QMainWindow& window, QSettings& settings, std::function<std::vector<PanelDock*>()> docks, Options options, QObject* parent)
    : QObject(parent), window_(window), settings_(settings), docks_(std::move(docks)), options_(std::move(options)),
      name_(new NamePanel(&window)) {}

void Layouts::addTo(QMenu& menu) {
    menu_ = &menu;
    menu.setToolTipsVisible(true);
    int number = 0;
    for (const LayoutPlan& plan : layoutPlans()) {
        QAction* made = menu.addAction(plan.title, this, [this, name = plan.name] { apply(name); });
        made->setObjectName("layout-" + plan.name);
        made->setShortcut(QKeySequence(QStringLiteral("Ctrl+%1").arg(++number)));
        made->setToolTip(plan.meaning);
    }
    menu.addSeparator();
    end_ = menu.addSeparator();
    QAction* save = menu.addAction(tr("Save layout as…"), this, &Layouts::askAndSave);
    save->setObjectName("saveLayout");
    save->setToolTip(tr("Keeps where everything is, and the options of the views, under a name"));
    removal_ = menu.addMenu(tr("Remove layout"));
    removal_->setToolTipsVisible(true);
    fill();
}

void Layouts::fill() {
    if (!menu_) return;
    for (QAction* old : ownActions_) {
        menu_->removeAction(old);
        old->setShortcut({});
        old->deleteLater();   // it may be the one that is under way
    }
    ownActions_.clear();
    removal_->clear();
    int number = static_cast<int>(layoutPlans().size());
    for (const QString& name : own()) {
        QString text = name;
        text.replace('&', "&&");
        auto* made = new QAction(text, this);
        made->setToolTip(tr("A layout of your own"));
        if (++number <= 9) made->setShortcut(QKeySequence(QStringLiteral("Ctrl+%1").arg(number)));
        connect(made, &QAction::triggered, this, [this, name] { apply(name); });
        menu_->insertAction(end_, made);
        ownActions_.push_back(made);
        connect(removal_->addAction(text), &QAction::triggered, this, [this, name] { remove(name); });
    }
    removal_->setEnabled(!ownActions_.empty());
}

QString Layouts::key(const QString& name) const { return QString::fromLatin1(kOwnLayouts) + '/' + QString::fromLatin1(QUrl::toPercentEncoding(name)); }

QStringList Layouts::own() const {
    settings_.beginGroup(QString::fromLatin1(kOwnLayouts));
    QStringList names;
    for (const QString& group : settings_.childGroups()) names << QUrl::fromPercentEncoding(group.toLatin1());
    settings_.endGroup();
    names.sort(Qt::CaseInsensitive);
    return names;
}

bool Layouts::apply(const QString& name) {
    const auto plan = std::ranges::find(layoutPlans(), name, &LayoutPlan::name);
    if (plan != layoutPlans().end()) {
        arrange(window_, docks_(), *plan);
        emit arranged();
        return true;
    }
    return own().contains(name) && read(key(name));
}

void Layouts::saveAs(const QString& name) {
    for (const QString& other : own())
        if (other.compare(name, Qt::CaseInsensitive) == 0) settings_.remove(key(other));
    write(key(name));
    fill();
}

void Layouts::remove(const QString& name) {
    settings_.remove(key(name));
    fill();
}

void Layouts::askAndSave() {
    name_->ask(tr("Save this layout as"), tr("Layout %1").arg(own().size() + 1), own(), [this](const QString& name) { saveAs(name); });
}

void Layouts::keep() { write(QString::fromLatin1(kLast)); }

bool Layouts::restore() { return read(QString::fromLatin1(kLast)); }

void Layouts::write(const QString& group) {
    QStringList known = settings_.value(group + "/docks").toStringList();   // also those that wait to come back
    for (const PanelDock* dock : docks_())
        if (!known.contains(dock->objectName())) known << dock->objectName();
    settings_.setValue(group + "/docks", known);
    settings_.setValue(group + "/state", window_.saveState(kVersion));
    settings_.setValue(group + "/options", options_.read());
}

bool Layouts::read(const QString& group) {
    const QByteArray state = settings_.value(group + "/state").toByteArray();
    if (state.isEmpty() || !window_.restoreState(state, kVersion)) return false;
    const QStringList known = settings_.value(group + "/docks").toStringList();
    const auto docks = docks_();
    for (PanelDock* dock : docks) {
        if (known.contains(dock->objectName())) continue;
        window_.removeDockWidget(dock);
        placeWithTools(window_, docks, *dock);
        dock->show();
    }
    options_.write(settings_.value(group + "/options").toMap());
    emit arranged();
    return true;
}

}  // namespace emca::explorer
