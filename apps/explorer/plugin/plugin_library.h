#pragma once

#include <QString>

#include "emca/core/result.h"
#include "emca/explorer/plugin.h"

namespace emca::explorer {

/// A plugin that may be called: its library is loaded and says that it fits.
struct PluginLibrary {
    QString file;                       ///< absolute
    QString id, title, summary;
    PluginPlace place = PluginPlace::tools;
    QWidget* (*make)(PluginContext&) = nullptr;
};

/// Whether a plugin fits this program: reads the entry's plain data and calls nothing.
/// Errors: fileUnreadable (no plugin's entry), versionMismatch, invalidArgument (a text or the function is missing).
/// \param file  for the sentence
Result<void> checkEntry(const PluginEntry& entry, const QString& file);

/// Loads a shared library and checks its entry. The library stays in the process to its end: Qt may keep pointers to
/// texts and types of it, so there is no safe moment to unload it.
/// Loading runs the library's static initialisers; so a stranger's file is loaded by a child process first (PluginProbe).
/// Errors: those of checkEntry; fileNotFound; fileUnreadable (no shared library, or one that lacks others).
Result<PluginLibrary> loadPluginLibrary(const QString& file);

/// What tells one build of a program and a file from another: a verdict about a file holds as long as it is the same.
QString fileStamp(const QString& file);

}  // namespace emca::explorer
