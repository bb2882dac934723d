#include "plugin/plugin_library.h"

#include <QDateTime>
#include <QFileInfo>
#include <QLibrary>
#include <cstring>

namespace emca::explorer {
namespace {

Error refusal(ErrorCode code, const QString& file, const QString& why) {
    return {code, QStringLiteral("\"%1\" %2").arg(QFileInfo(file).fileName(), why).toStdString()};
}

/// Major and minor version of "5.15.8".
std::pair<int, int> versionOf(const QString& text) {
    return {text.section('.', 0, 0).toInt(), text.section('.', 1, 1).toInt()};
}

bool idIsGood(const char* id) {
    if (!id || !*id || std::strlen(id) > 60) return false;
    for (const char* c = id; *c; ++c)
        if (!((*c >= 'a' && *c <= 'z') || (*c >= '0' && *c <= '9') || *c == '-' || *c == '_' || *c == '.')) return false;
    return true;
}

}  // namespace

Result<void> checkEntry(const PluginEntry& entry, const QString& file) {
    if (std::memcmp(entry.magic, "EMCAplug", sizeof entry.magic) != 0)
        return refusal(ErrorCode::fileUnreadable, file, QStringLiteral("is no plugin of EMCA: what it exports begins with other letters."));
    if (entry.interfaceVersion != kPluginInterface || entry.bytes != sizeof(PluginEntry))
        return refusal(ErrorCode::versionMismatch, file,
                       QStringLiteral("was built for version %1 of the plugin interface; this explorer has version %2. Build it again with the headers of EMCA %3.")
                           .arg(entry.interfaceVersion).arg(kPluginInterface).arg(kEmcaVersion));
    if (!entry.emca || !entry.qt || !entry.binary)
        return refusal(ErrorCode::fileUnreadable, file, QStringLiteral("does not say what it was built with; use EMCA_EXPLORER_PLUGIN."));
    const QString emca = QString::fromLatin1(entry.emca), qt = QString::fromLatin1(entry.qt), binary = QString::fromLatin1(entry.binary);
    if (emca != QLatin1String(kEmcaVersion) || entry.layout != layoutOfSharedTypes())
        return refusal(ErrorCode::versionMismatch, file,
                       QStringLiteral("was built for EMCA %1%2; this is %3. Build it again with the headers of this version.")
                           .arg(emca, emca == QLatin1String(kEmcaVersion) ? QStringLiteral(" with types of other sizes") : QString(), QLatin1String(kEmcaVersion)));
    if (versionOf(qt).first != versionOf(qVersion()).first || versionOf(qt).second > versionOf(qVersion()).second)
        return refusal(ErrorCode::versionMismatch, file, QStringLiteral("was built with Qt %1; this explorer runs with Qt %2.").arg(qt, qVersion()));
    if (binary != QLatin1String(binaryInterface()))
        return refusal(ErrorCode::versionMismatch, file,
                       QStringLiteral("was built by another compiler or library (%1); this explorer needs %2.").arg(binary, QLatin1String(binaryInterface())));
    if (!idIsGood(entry.id) || !entry.title || !*entry.title || !entry.summary || !entry.make)
        return refusal(ErrorCode::invalidArgument, file,
                       QStringLiteral("has no id of lower-case letters, digits and \"-\", no title, no summary or no function that makes its widget."));
    return {};
}

Result<PluginLibrary> loadPluginLibrary(const QString& file) {
    const QFileInfo info(file);
    if (!info.isFile()) return Error{ErrorCode::fileNotFound, QStringLiteral("The plugin \"%1\" is not there; check its name.").arg(file).toStdString()};
    QLibrary library(info.absoluteFilePath());
    // What is missing shall be found now, not in the middle of a mouse click.
    library.setLoadHints(QLibrary::ResolveAllSymbolsHint | QLibrary::PreventUnloadHint);
    if (!library.load()) return refusal(ErrorCode::fileUnreadable, file, QStringLiteral("cannot be loaded: %1.").arg(library.errorString()));
    const auto* entry = reinterpret_cast<const PluginEntry*>(library.resolve("emca_explorer_plugin"));
    if (!entry)
        return refusal(ErrorCode::fileUnreadable, file, QStringLiteral("is a shared library, but no plugin of EMCA: it does not export emca_explorer_plugin (see EMCA_EXPLORER_PLUGIN)."));
    if (const auto fits = checkEntry(*entry, file); !fits) return fits.error();
    return PluginLibrary{info.absoluteFilePath(), QString::fromLatin1(entry->id), QString::fromUtf8(entry->title), QString::fromUtf8(entry->summary), entry->place, entry->make};
}

QString fileStamp(const QString& file) {
    const QFileInfo info(file);
    return QStringLiteral("%1 %2 %3 %4 %5").arg(info.size()).arg(info.lastModified().toMSecsSinceEpoch()).arg(kPluginInterface).arg(kEmcaVersion).arg(qVersion());
}

}  // namespace emca::explorer
