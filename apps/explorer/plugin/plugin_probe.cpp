#include "plugin/plugin_probe.h"

#include <QFileInfo>
#include <QProcessEnvironment>

namespace emca::explorer {

PluginProbe::PluginProbe(const QString& program, const QString& file, std::chrono::milliseconds limit, QObject* parent)
    : QObject(parent), program_(program), file_(file), limit_(limit) {
    QProcessEnvironment environment = QProcessEnvironment::systemEnvironment();
    environment.insert("QT_QPA_PLATFORM", "offscreen");
    process_.setProcessEnvironment(environment);
    process_.setStandardErrorFile(QProcess::nullDevice());
    timer_.setSingleShot(true);
    connect(&process_, &QProcess::readyReadStandardOutput, this, &PluginProbe::read);
    connect(&process_, qOverload<int, QProcess::ExitStatus>(&QProcess::finished), this, [this](int code, QProcess::ExitStatus status) {
        read();
        end(verdict(code, status));
    });
    connect(&process_, &QProcess::errorOccurred, this, [this](QProcess::ProcessError error) {
        if (error == QProcess::FailedToStart)
            end(tr("it could not be tried: the program \"%1\" does not start (%2); install EMCA again.").arg(program_, process_.errorString()));
    });
    connect(&timer_, &QTimer::timeout, this, [this] {
        process_.kill();
        end(tr("it did not come back within %1 s while it was tried (%2).").arg(double(limit_.count()) / 1000).arg(step_));
    });
}

PluginProbe::~PluginProbe() {
    over_ = true;
    process_.kill();
    process_.waitForFinished(2000);
}

void PluginProbe::start() {
    step_ = tr("starting");
    timer_.start(limit_);
    process_.start(program_, {file_});
}

void PluginProbe::read() {
    while (process_.canReadLine()) {
        const QString line = QString::fromUtf8(process_.readLine()).trimmed();
        if (line.startsWith(QLatin1String(kStep))) step_ = line.mid(int(qstrlen(kStep)));
        else if (line == QLatin1String(kGood)) good_ = true;
        else if (line.startsWith(QLatin1String(kBad))) refusal_ = line.mid(int(qstrlen(kBad)));
    }
}

QString PluginProbe::verdict(int code, QProcess::ExitStatus status) const {
    if (!refusal_.isEmpty()) return refusal_;
    if (status == QProcess::CrashExit) return tr("it crashed while it was tried (%1).").arg(step_);
    if (good_ && code == 0) return {};
    return tr("it ended the process with code %1 while it was tried (%2).").arg(code).arg(step_);
}

void PluginProbe::end(const QString& refusal) {
    if (over_) return;
    over_ = true;
    timer_.stop();
    emit ended(refusal);
}

}  // namespace emca::explorer
