#include "plugin/plugins_panel.h"

#include <QCheckBox>
#include <QDir>
#include <QFileDialog>
#include <QFileInfo>
#include <QFrame>
#include <QHBoxLayout>
#include <QLabel>
#include <QPushButton>
#include <QScrollArea>
#include <QTimer>
#include <QVBoxLayout>

#include "base/theme.h"
#include "plugin/plugin_manager.h"

namespace emca::explorer {
namespace {

QLabel* line(const QString& text, const QFont& font, const QColor& color) {
    auto* label = new QLabel(text);
    label->setTextFormat(Qt::PlainText);
    label->setWordWrap(true);
    label->setFont(font);
    QPalette palette = label->palette();
    palette.setColor(QPalette::WindowText, color);
    label->setPalette(palette);
    return label;
}

QString stateWord(PluginRecord::State state) {
    switch (state) {
        case PluginRecord::State::checking: return QObject::tr("being tried");
        case PluginRecord::State::running: return QObject::tr("running");
        case PluginRecord::State::stopped: return QObject::tr("stopped");
        case PluginRecord::State::refused: return QObject::tr("refused");
        case PluginRecord::State::off: return QObject::tr("off");
    }
    return {};
}

QColor stateColor(PluginRecord::State state, const ThemeColors& colors) {
    switch (state) {
        case PluginRecord::State::running: return colors.success;
        case PluginRecord::State::stopped: case PluginRecord::State::refused: return colors.error;
        case PluginRecord::State::checking: case PluginRecord::State::off: break;
    }
    return colors.mutedText;
}

}  // namespace

PluginsPanel::PluginsPanel(PluginManager& plugins, Theme& theme, QWidget* parent)
    : QWidget(parent), plugins_(plugins), theme_(theme), list_(new QWidget), cards_(new QVBoxLayout(list_)) {
    auto* scroll = new QScrollArea;
    scroll->setWidgetResizable(true);
    scroll->setFrameShape(QFrame::NoFrame);
    scroll->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
    scroll->setWidget(list_);
    cards_->setContentsMargins(Spacing::medium, Spacing::medium, Spacing::medium, Spacing::medium);
    cards_->setSpacing(Spacing::large);
    auto* add = new QPushButton(tr("Add a plugin…"));
    add->setObjectName("addPlugin");
    add->setToolTip(tr("Load a shared library now. One that lies in a folder of plugins is loaded at each start:\n%1").arg(plugins.folders().join('\n')));
    auto* bar = new QHBoxLayout;
    bar->setContentsMargins(Spacing::medium, Spacing::small, Spacing::medium, Spacing::small);
    bar->addStretch(1);
    bar->addWidget(add);
    auto* layout = new QVBoxLayout(this);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->setSpacing(0);
    layout->addWidget(scroll, 1);
    layout->addLayout(bar);
    connect(add, &QPushButton::clicked, this, &PluginsPanel::askForFile);
    // Later: a card's own button may be the reason.
    const auto later = [this] {
        if (std::exchange(reloading_, true)) return;
        QTimer::singleShot(0, this, [this] {
            reloading_ = false;
            reload();
        });
    };
    connect(&plugins, &PluginManager::changed, this, later);
    connect(&theme, &Theme::themeChanged, this, later);
    reload();
}

void PluginsPanel::reload() {
    while (QLayoutItem* item = cards_->takeAt(0)) {
        delete item->widget();
        delete item;
    }
    const ThemeColors& c = theme_.colors();
    if (plugins_.records().empty())
        cards_->addWidget(line(tr("No plugins. Put shared libraries into one of these folders, or add one:\n%1").arg(plugins_.folders().join('\n')), theme_.font(), c.mutedText));
    for (const auto& record : plugins_.records()) cards_->addWidget(card(*record));
    cards_->addStretch(1);
}

QWidget* PluginsPanel::card(const PluginRecord& record) {
    const ThemeColors& c = theme_.colors();
    auto* made = new QWidget;
    auto* layout = new QVBoxLayout(made);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->setSpacing(Spacing::tiny);
    auto* head = new QHBoxLayout;
    auto* on = new QCheckBox(record.title);
    on->setObjectName("plugin " + record.title);
    on->setFont(theme_.strongFont());
    on->setChecked(record.state != PluginRecord::State::off);
    on->setToolTip(tr("Whether it is loaded, now and at each start"));
    connect(on, &QCheckBox::toggled, this, [this, file = record.file](bool wanted) { plugins_.setOn(file, wanted); });
    auto* state = line(stateWord(record.state), theme_.smallFont(), stateColor(record.state, c));
    state->setWordWrap(false);
    head->addWidget(on, 1);
    head->addWidget(state);
    layout->addLayout(head);
    if (!record.summary.isEmpty()) layout->addWidget(line(record.summary, theme_.font(), c.text));
    if (!record.reason.isEmpty()) layout->addWidget(line(record.reason, theme_.font(), record.state == PluginRecord::State::off ? c.mutedText : c.warning));
    auto* file = line(QFileInfo(record.file).fileName(), theme_.smallFont(), c.mutedText);
    file->setToolTip(record.file);
    auto* foot = new QHBoxLayout;
    foot->addWidget(file, 1);
    if (record.state == PluginRecord::State::refused || record.state == PluginRecord::State::stopped) {
        auto* again = new QPushButton(tr("Try again"));
        again->setObjectName("tryAgain " + record.title);
        connect(again, &QPushButton::clicked, this, [this, path = record.file] { plugins_.tryAgain(path); });
        foot->addWidget(again);
    } else if (record.state == PluginRecord::State::running) {
        auto* show = new QPushButton(tr("Show"));
        show->setToolTip(tr("Bring its panel to the front"));
        connect(show, &QPushButton::clicked, this, [this, id = record.host->library().id] { emit showWanted(id); });
        foot->addWidget(show);
    }
    layout->addLayout(foot);
    return made;
}

void PluginsPanel::askForFile() {
    const QString file = QFileDialog::getOpenFileName(this, tr("Add a plugin"), QString(), tr("Shared libraries (*.so *.dylib *.dll)"));
    if (!file.isEmpty()) plugins_.add(file);
}

}  // namespace emca::explorer
