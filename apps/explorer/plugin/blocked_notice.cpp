#include "plugin/blocked_notice.h"

#include <signal.h>

#include <QFile>
#include <QHBoxLayout>
#include <QLabel>
#include <QPushButton>
#include <QVBoxLayout>
#include <cerrno>

#include "base/theme.h"

namespace emca::explorer {

bool isAlive(qint64 process) { return ::kill(static_cast<pid_t>(process), 0) == 0 || errno != ESRCH; }

BlockedNotice::BlockedNotice(Theme& theme, const QString& plugin, const QString& mark, qint64 process) : mark_(mark), process_(process) {
    setWindowTitle(tr("EMCA explorer"));
    setWindowFlag(Qt::WindowStaysOnTopHint);
    auto* title = new QLabel(tr("The plugin %1 keeps the explorer from answering").arg(plugin));
    title->setTextFormat(Qt::PlainText);
    title->setFont(theme.strongFont());
    auto* sentence = new QLabel(tr("Wait until it has done its work, or end the explorer: what was not saved is lost, and the next start leaves this plugin out."));
    sentence->setWordWrap(true);
    auto* wait = new QPushButton(tr("Wait"));
    auto* end = new QPushButton(tr("End the explorer"));
    wait->setDefault(true);
    auto* buttons = new QHBoxLayout;
    buttons->addStretch(1);
    buttons->addWidget(end);
    buttons->addWidget(wait);
    auto* layout = new QVBoxLayout(this);
    layout->setContentsMargins(Spacing::huge, Spacing::large, Spacing::huge, Spacing::large);
    layout->setSpacing(Spacing::medium);
    layout->addWidget(title);
    layout->addWidget(sentence);
    layout->addLayout(buttons);
    setFixedWidth(440);
    connect(wait, &QPushButton::clicked, this, &BlockedNotice::over);
    connect(end, &QPushButton::clicked, this, [this] {
        // Nothing gentler reaches a process whose event loop stands still.
        ::kill(static_cast<pid_t>(process_), SIGKILL);
        emit over();
    });
    connect(&timer_, &QTimer::timeout, this, [this] {
        if (!QFile::exists(mark_) || !isAlive(process_)) emit over();
    });
    timer_.start(200);
}

}  // namespace emca::explorer
