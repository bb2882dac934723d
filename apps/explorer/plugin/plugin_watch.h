#pragma once

#include <QObject>
#include <QString>
#include <chrono>
#include <condition_variable>
#include <mutex>
#include <optional>
#include <thread>
#include <vector>

namespace emca::explorer {

/// What a plugin did to an explorer that did not come to its end.
struct PluginMark {
    enum class Kind { blocked, crashed };
    Kind kind = Kind::blocked;
    QString file;    ///< of the plugin
};

/// Looks from a thread of its own how long a plugin keeps the window from answering. Nothing can interrupt it there; but
/// it is said whose fault it is, and written down, so that the next start leaves the plugin out. If the call returns
/// after all, the mark goes and `released` tells.
class PluginWatch : public QObject {
    Q_OBJECT
  public:
    /// \param prefix   of the files for marks; the process's number and a kind are added
    /// \param program  shows a BlockedNotice while the window cannot show anything; empty: none
    PluginWatch(const QString& prefix, std::chrono::milliseconds limit, const QString& program, QObject* parent = nullptr);
    ~PluginWatch() override;

    /// Writes a mark if the process crashes inside of a plugin. For the whole process; from main().
    static void markCrashes(const QString& prefix);
    /// Marks of processes that live no more; their files are removed.
    static std::vector<PluginMark> takeMarks(const QString& prefix);

  signals:
    /// The window answers again.
    void released(const QString& file, double seconds);

  private:
    void look();
    void begin(const QString& file, double seconds);
    QString prefix_, program_;
    std::chrono::milliseconds limit_;
    std::mutex mutex_;
    std::condition_variable wake_;
    bool ending_ = false;
    std::thread thread_;
};

}  // namespace emca::explorer
