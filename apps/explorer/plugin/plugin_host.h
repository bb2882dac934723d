#pragma once

#include <QObject>
#include <memory>

#include "plugin/host_context.h"
#include "plugin/plugin_library.h"
#include "plugin/plugin_view.h"

namespace emca::explorer {

/// One plugin that runs, or did until it failed: its widget, its context and its place in the window.
class PluginHost : public QObject {
    Q_OBJECT
  public:
    /// \param around  outlives this
    PluginHost(PluginLibrary library, const HostContext::Surroundings& around, QObject* parent = nullptr);
    ~PluginHost() override;

    const PluginLibrary& library() const { return library_; }
    /// The place; whoever puts it into a window may delete it. Null after that.
    PluginView* view() const { return view_; }
    bool isRunning() const { return context_ != nullptr && reason_.isEmpty(); }
    /// It waits for an answer or for work of its own.
    bool isWorking() const { return isRunning() && context_->isWorking(); }
    /// Why it does not run; empty while it does.
    const QString& reason() const { return reason_; }

    /// Makes the widget. Does nothing while it runs.
    void start();
    /// Forgets why it was stopped, and starts it.
    void startAgain();
    /// Cuts it off at once; takes its widget away and says why in its place as soon as the running event has ended.
    void stop(const QString& reason);
    /// Ends it for good. \return false if its work in other threads does not end: see HostContext
    bool end(int milliseconds);
    void settingsChanged();

  signals:
    void changed();

  private:
    void retire();
    void discard();
    PluginLibrary library_;
    HostContext::Surroundings around_;
    QPointer<PluginView> view_;
    PluginGuard::Slot slot_;
    QString reason_;
    std::unique_ptr<HostContext> context_;
    std::vector<std::shared_ptr<HostContext>> retired_;   ///< their widgets may still have events before them
};

}  // namespace emca::explorer
