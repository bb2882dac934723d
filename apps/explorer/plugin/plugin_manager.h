#pragma once

#include <QObject>
#include <QStringList>
#include <chrono>
#include <memory>
#include <vector>

#include "plugin/plugin_host.h"
#include "plugin/plugin_probe.h"
#include "plugin/plugin_watch.h"

namespace emca::explorer {

/// A plugin that was found, whether it runs or not.
struct PluginRecord {
    enum class State { checking, running, stopped, refused, off };
    QString file;                        ///< absolute
    QString title, summary;              ///< title: the file's name before it is known
    State state = State::checking;
    QString reason;                      ///< a sentence for stopped, refused and off; else empty
    std::unique_ptr<PluginHost> host;    ///< null before it was loaded
};

/// Finds plugins, tries each new one in a process of its own, loads those that fit, and stops those that fail. What it
/// knows of files (tried and good, switched off by a person, to blame for a crash) is in the settings. GUI thread.
class PluginManager : public QObject {
    Q_OBJECT
  public:
    struct Options {
        QStringList folders;             ///< looked through in this order; of two files of one id the first wins
        QStringList files;               ///< besides
        QString probeProgram;            ///< the child of PluginProbe
        std::chrono::milliseconds probeLimit{20000};
        std::chrono::milliseconds blockLimit{5000};
        /// The installation's folder and that of the person; the program stands beside ours.
        static Options standard();
    };
    PluginManager(const HostContext::Surroundings& around, Options options, QObject* parent = nullptr);
    ~PluginManager() override;

    void start();
    /// A file that a person names now. Found again at the next start only if it lies in a folder.
    void add(const QString& file);
    /// By the record's file. Off: it is stopped now and not loaded at the next start.
    void setOn(const QString& file, bool on);
    /// Once more, with a new trial: refused ones, and those that were stopped.
    void tryAgain(const QString& file);

    const std::vector<std::unique_ptr<PluginRecord>>& records() const { return records_; }
    const PluginRecord* find(const QString& file) const;
    const QStringList& folders() const { return options_.folders; }
    /// Nothing is being tried.
    bool isSettled() const { return probing_ == 0 && waiting_.empty(); }
    /// A plugin waits for an answer, or for work of its own.
    bool isWorking() const;

    /// Ends all plugins. \return false if some work of theirs does not end: then leave the process by std::_Exit
    bool end(int milliseconds = 2000);
    /// Settings of all plugins, for a saved layout; and back.
    QVariantMap savedSettings() const;
    void restoreSettings(const QVariantMap& settings);
    /// Where marks of crashes and blocked windows are kept: beside the settings.
    static QString markPrefix(const QSettings& settings);

  signals:
    void changed();
    /// A plugin runs for the first time: put host.view() somewhere.
    void loaded(emca::explorer::PluginHost* host);
    /// A sentence for the window.
    void problem(const QString& sentence);

  private:
    PluginRecord* recordOf(const QString& file);
    void consider(const QString& file);
    void probeNext();
    void load(PluginRecord& record);
    void refuse(PluginRecord& record, const QString& reason);
    void readMarks();
    QString key(const QString& file, const char* what) const;

    HostContext::Surroundings around_;
    Options options_;
    std::vector<std::unique_ptr<PluginRecord>> records_;
    QStringList waiting_;                ///< to be tried
    int probing_ = 0;
    std::unique_ptr<PluginWatch> watch_;
};

}  // namespace emca::explorer
