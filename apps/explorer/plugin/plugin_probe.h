#pragma once

#include <QObject>
#include <QProcess>
#include <QTimer>
#include <chrono>

namespace emca::explorer {

/// Tries a plugin in a process of its own before the window loads it: there it may hang, crash or end the process, and
/// nobody is harmed. The child (program/plugin_probe.cpp) loads the library, makes the widget off screen and feeds it a
/// small pixel, a selection, other colours, and nothing again. What a plugin does later, on other data, this cannot know.
class PluginProbe : public QObject {
    Q_OBJECT
  public:
    /// \param program  the child  \param file  the plugin
    PluginProbe(const QString& program, const QString& file, std::chrono::milliseconds limit, QObject* parent = nullptr);
    ~PluginProbe() override;
    void start();
    const QString& file() const { return file_; }

    /// What the child writes to its standard output: a line for each step, and at last kGood or kBad and a sentence.
    static constexpr const char* kStep = "emca-plugin-probe step ";
    static constexpr const char* kGood = "emca-plugin-probe good";
    static constexpr const char* kBad = "emca-plugin-probe bad ";

  signals:
    /// \param refusal  a sentence; empty: the plugin may be loaded
    void ended(const QString& refusal);

  private:
    void read();
    void end(const QString& refusal);
    QString verdict(int code, QProcess::ExitStatus status) const;

    QString program_, file_, step_, refusal_;
    bool good_ = false, over_ = false;
    std::chrono::milliseconds limit_;
    QProcess process_;
    QTimer timer_;
};

}  // namespace emca::explorer
