#include "plugin/plugin_watch.h"

#include <fcntl.h>
#include <unistd.h>

#include <QCoreApplication>
#include <QDir>
#include <QFile>
#include <QFileInfo>
#include <QProcess>
#include <csignal>
#include <cstdio>
#include <cstring>

#include "plugin/blocked_notice.h"
#include "plugin/plugin_guard.h"

namespace emca::explorer {
namespace {

constexpr const char* kBlocked = ".plugin-blocks";
constexpr const char* kCrashed = ".plugin-crash";
char crashFile[4096];   // prepared, since a signal handler may not allocate

QString fileName(const QString& prefix, const char* kind) {
    return prefix + QStringLiteral(".%1").arg(QCoreApplication::applicationPid()) + QLatin1String(kind);
}

/// Async-signal-safe functions only (POSIX.1-2017, 2.4.3).
void onCrash(int signal) {
    const char* plugin = PluginGuard::instance().fileOf(PluginGuard::instance().current());
    if (*plugin) {
        const int file = ::open(crashFile, O_WRONLY | O_CREAT | O_TRUNC, 0600);
        if (file >= 0) {
            [[maybe_unused]] const auto written = ::write(file, plugin, std::strlen(plugin));
            ::close(file);
        }
    }
    std::signal(signal, SIG_DFL);
    std::raise(signal);
}

}  // namespace

PluginWatch::PluginWatch(const QString& prefix, std::chrono::milliseconds limit, const QString& program, QObject* parent)
    : QObject(parent), prefix_(prefix), program_(program), limit_(limit), thread_([this] { look(); }) {}

PluginWatch::~PluginWatch() {
    {
        const std::lock_guard lock(mutex_);
        ending_ = true;
    }
    wake_.notify_all();
    thread_.join();
}

void PluginWatch::begin(const QString& plugin, double seconds) {
    const QString mark = fileName(prefix_, kBlocked), name = QFileInfo(plugin).completeBaseName();
    QFile file(mark);
    if (file.open(QIODevice::WriteOnly)) file.write(plugin.toUtf8());
    file.close();
    std::fprintf(stderr, "emca-explorer: the plugin \"%s\" keeps the window from answering for %.1f s now. If the explorer is ended, the next start leaves it out.\n",
                 qUtf8Printable(name), seconds);
    if (!program_.isEmpty()) QProcess::startDetached(program_, {"--blocked", name, mark, QString::number(QCoreApplication::applicationPid())});
}

void PluginWatch::look() {
    using Clock = std::chrono::steady_clock;
    PluginGuard& guard = PluginGuard::instance();
    QString marked;
    std::chrono::nanoseconds begun{0};
    PluginGuard::Slot slot = PluginGuard::kNobody;
    std::unique_lock lock(mutex_);
    while (!wake_.wait_for(lock, limit_ / 8, [this] { return ending_; })) {
        const PluginGuard::Slot now = guard.current();
        const std::chrono::nanoseconds since = guard.since(), at = Clock::now().time_since_epoch();
        if (marked.isEmpty() && now != PluginGuard::kNobody && at - since > limit_) {
            begun = since;
            slot = now;
            marked = QString::fromUtf8(guard.fileOf(now));
            begin(marked, std::chrono::duration<double>(at - since).count());
        } else if (!marked.isEmpty() && (now != slot || since != begun)) {
            QFile::remove(fileName(prefix_, kBlocked));
            emit released(marked, std::chrono::duration<double>(since - begun).count());
            marked.clear();
        }
    }
    if (!marked.isEmpty()) QFile::remove(fileName(prefix_, kBlocked));
}

void PluginWatch::markCrashes(const QString& prefix) {
    const QByteArray name = QFile::encodeName(fileName(prefix, kCrashed));
    if (std::size_t(name.size()) >= sizeof crashFile) return;
    std::memcpy(crashFile, name.constData(), std::size_t(name.size()) + 1);
    PluginGuard::instance();   // made before the first signal
    for (const int signal : {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT}) std::signal(signal, onCrash);
}

std::vector<PluginMark> PluginWatch::takeMarks(const QString& prefix) {
    std::vector<PluginMark> marks;
    const QFileInfo info(prefix);
    const QString stem = info.fileName() + QLatin1Char('.');
    for (const QFileInfo& found : info.dir().entryInfoList({stem + "*" + kBlocked, stem + "*" + kCrashed}, QDir::Files | QDir::Hidden)) {
        bool isNumber = false;
        const qint64 process = found.fileName().mid(stem.size()).section('.', 0, 0).toLongLong(&isNumber);
        if (!isNumber || isAlive(process)) continue;
        QFile file(found.filePath());
        if (!file.open(QIODevice::ReadOnly)) continue;
        const bool crashed = found.fileName().endsWith(QLatin1String(kCrashed));
        marks.push_back({crashed ? PluginMark::Kind::crashed : PluginMark::Kind::blocked, QString::fromUtf8(file.read(PluginGuard::kNameBytes))});
        file.remove();
    }
    return marks;
}

}  // namespace emca::explorer
