#include "plugin/plugin_manager.h"

#include <QCoreApplication>
#include <QCryptographicHash>
#include <QDir>
#include <QFileInfo>
#include <QStandardPaths>
#include <algorithm>

#include "base/qt_compat.h"

namespace emca::explorer {
namespace {

constexpr int kProbesAtOnce = 2;

}  // namespace

PluginManager::Options PluginManager::Options::standard() {
    const QDir program(QCoreApplication::applicationDirPath());
    Options options;
    options.folders << QDir::cleanPath(program.filePath(QStringLiteral(EMCA_PLUGIN_FOLDER)))
                    << QStandardPaths::writableLocation(QStandardPaths::GenericDataLocation) + QStringLiteral("/emca/plugins");
    options.probeProgram = program.filePath(QStringLiteral("emca-plugin-probe"));
    return options;
}

PluginManager::PluginManager(const HostContext::Surroundings& around, Options options, QObject* parent)
    : QObject(parent), around_(around), options_(std::move(options)) {
    PluginGuard::instance().setUnknown([this](const QString& what) {
        emit problem(tr("Something in the window failed with \"%1\"; what was being done may be incomplete.").arg(what));
    });
}

PluginManager::~PluginManager() {
    end(0);
    PluginGuard::instance().setUnknown({});
}

QString PluginManager::markPrefix(const QSettings& settings) { return settings.fileName(); }

QString PluginManager::key(const QString& file, const char* what) const {
    const QByteArray hash = QCryptographicHash::hash(file.toUtf8(), QCryptographicHash::Sha1).toHex().left(16);
    return QStringLiteral("pluginFiles/%1/%2").arg(QString::fromLatin1(hash), QLatin1String(what));
}

void PluginManager::start() {
    QDir().mkpath(QFileInfo(markPrefix(around_.settings)).path());
    readMarks();
    watch_ = std::make_unique<PluginWatch>(markPrefix(around_.settings), options_.blockLimit, options_.probeProgram);
    connect(watch_.get(), &PluginWatch::released, this, [this](const QString& file, double seconds) {
        const PluginRecord* record = find(file);
        emit problem(tr("The plugin %1 kept the window from answering for %2 s. The page \"Plugins\" switches it off.")
                         .arg(record ? record->title : QFileInfo(file).fileName()).arg(seconds, 0, 'f', 1));
    });
    for (const QString& folder : options_.folders)
        for (const QFileInfo& info : QDir(folder).entryInfoList({"*.so", "*.dylib", "*.dll"}, QDir::Files, QDir::Name)) consider(info.absoluteFilePath());
    for (const QString& file : options_.files) consider(QFileInfo(file).absoluteFilePath());
    emit changed();
}

void PluginManager::readMarks() {
    for (const PluginMark& mark : PluginWatch::takeMarks(markPrefix(around_.settings))) {
        const QString reason = mark.kind == PluginMark::Kind::crashed ? tr("The explorer crashed in it the last time.")
                                                                      : tr("It kept the window from answering until the explorer was ended, the last time.");
        around_.settings.setValue(key(mark.file, "off"), reason);
        around_.settings.remove(key(mark.file, "good"));
    }
}

const PluginRecord* PluginManager::find(const QString& file) const {
    for (const auto& record : records_)
        if (record->file == file) return record.get();
    return nullptr;
}

PluginRecord* PluginManager::recordOf(const QString& file) { return const_cast<PluginRecord*>(find(file)); }

void PluginManager::add(const QString& file) {
    consider(QFileInfo(file).absoluteFilePath());
    emit changed();
}

void PluginManager::consider(const QString& file) {
    if (find(file)) return;
    records_.push_back(std::make_unique<PluginRecord>());
    PluginRecord& record = *records_.back();
    record.file = file;
    record.title = QFileInfo(file).completeBaseName();
    if (const QString off = around_.settings.value(key(file, "off")).toString(); !off.isEmpty()) {
        record.state = PluginRecord::State::off;
        record.reason = off;
        return;
    }
    if (around_.settings.value(key(file, "good")).toString() == fileStamp(file)) return load(record);
    waiting_ << file;
    probeNext();
}

void PluginManager::probeNext() {
    while (probing_ < kProbesAtOnce && !waiting_.isEmpty()) {
        auto* probe = new PluginProbe(options_.probeProgram, waiting_.takeFirst(), options_.probeLimit, this);
        ++probing_;
        connect(probe, &PluginProbe::ended, this, [this, probe](const QString& refusal) {
            --probing_;
            probe->deleteLater();
            if (PluginRecord* record = recordOf(probe->file())) {
                if (refusal.isEmpty()) {
                    around_.settings.setValue(key(record->file, "good"), fileStamp(record->file));
                    load(*record);
                } else {
                    refuse(*record, refusal);
                }
            }
            probeNext();
            emit changed();
        });
        probe->start();
    }
}

void PluginManager::refuse(PluginRecord& record, const QString& reason) {
    record.state = PluginRecord::State::refused;
    record.reason = reason;
    emit problem(tr("The plugin %1 was not loaded: %2").arg(record.title, reason));
}

void PluginManager::load(PluginRecord& record) {
    Result<PluginLibrary> library = loadPluginLibrary(record.file);
    if (!library) return refuse(record, toQString(library.error().message));
    for (const auto& other : records_)
        if (other->host && other->host->library().id == library->id)
            return refuse(record, tr("another plugin of the name \"%1\" came from \"%2\".").arg(library->id, other->file));
    record.title = library->title;
    record.summary = library->summary;
    record.host = std::make_unique<PluginHost>(std::move(*library), around_);
    PluginHost* host = record.host.get();
    connect(host, &PluginHost::changed, this, [this, file = record.file] {
        PluginRecord* of = recordOf(file);
        if (!of || !of->host || of->state == PluginRecord::State::off) return;
        of->state = of->host->isRunning() ? PluginRecord::State::running : PluginRecord::State::stopped;
        of->reason = of->host->reason();
        if (!of->reason.isEmpty()) emit problem(tr("The plugin %1 was stopped: %2").arg(of->title, of->reason));
        emit changed();
    });
    host->start();
    emit loaded(host);
}

void PluginManager::setOn(const QString& file, bool on) {
    PluginRecord* record = recordOf(file);
    if (!record || on == (record->state != PluginRecord::State::off)) return;
    if (on) {
        around_.settings.remove(key(file, "off"));
        record->state = PluginRecord::State::checking;
        return tryAgain(file);
    }
    record->state = PluginRecord::State::off;
    record->reason = tr("Switched off.");
    around_.settings.setValue(key(file, "off"), record->reason);
    waiting_.removeAll(file);
    if (record->host) record->host->stop(tr("it was switched off."));
    emit changed();
}

void PluginManager::tryAgain(const QString& file) {
    PluginRecord* record = recordOf(file);
    if (!record) return;
    around_.settings.remove(key(file, "off"));
    record->reason.clear();
    if (record->host) {
        record->state = PluginRecord::State::stopped;
        record->host->startAgain();
    } else if (!waiting_.contains(file)) {
        record->state = PluginRecord::State::checking;
        waiting_ << file;
        probeNext();
    }
    emit changed();
}

bool PluginManager::isWorking() const {
    return std::ranges::any_of(records_, [](const auto& record) { return record->host && record->host->isWorking(); });
}

bool PluginManager::end(int milliseconds) {
    waiting_.clear();
    bool ended = true;
    for (const auto& record : records_)
        if (record->host) ended = record->host->end(milliseconds) && ended;
    watch_.reset();
    return ended;
}

QVariantMap PluginManager::savedSettings() const {
    QVariantMap saved;
    around_.settings.beginGroup("plugins");
    for (const QString& name : around_.settings.allKeys()) saved[name] = around_.settings.value(name);
    around_.settings.endGroup();
    return saved;
}

void PluginManager::restoreSettings(const QVariantMap& settings) {
    around_.settings.remove("plugins");
    for (auto entry = settings.begin(); entry != settings.end(); ++entry) around_.settings.setValue("plugins/" + entry.key(), entry.value());
    for (const auto& record : records_)
        if (record->host) record->host->settingsChanged();
}

}  // namespace emca::explorer
