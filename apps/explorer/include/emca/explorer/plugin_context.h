#pragma once

#include <QFont>
#include <QString>
#include <QVariant>
#include <atomic>
#include <chrono>
#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "emca/analysis/tone_map.h"
#include "emca/client/dataset.h"
#include "emca/client/selection.h"
#include "emca/core/result.h"
#include "emca/explorer/look.h"
#include "emca/explorer/plot.h"
#include "emca/explorer/scene_objects.h"

namespace emca::explorer {

/// Ends something when it goes: a registration with a model. Keep it as a member of the widget. Movable.
class Subscription {
  public:
    Subscription() = default;
    explicit Subscription(std::function<void()> end) : end_(std::move(end)) {}
    Subscription(Subscription&& other) noexcept : end_(std::exchange(other.end_, nullptr)) {}
    Subscription& operator=(Subscription&& other) noexcept {
        if (this != &other) {
            reset();
            end_ = std::exchange(other.end_, nullptr);
        }
        return *this;
    }
    ~Subscription() { reset(); }
    void reset() {
        if (const auto end = std::exchange(end_, nullptr)) end();
    }

  private:
    std::function<void()> end_;
};

/// Shared between a task and those who may give it up.
struct TaskState {
    std::atomic<bool> cancelled{false};   ///< work looks at it from time to time
    std::atomic<bool> ended{false};       ///< the answer was given, or nobody wants it
};

/// A request or work that is under way. Its end, or another one in its place, cancels it: `task_ = context.ask(…)` means
/// that the latest question wins. After cancel() its answer does not come any more. GUI thread.
class Task {
  public:
    Task() = default;
    explicit Task(std::shared_ptr<TaskState> state) : state_(std::move(state)) {}
    Task(Task&&) noexcept = default;
    Task& operator=(Task&& other) noexcept {
        if (this != &other) {
            cancel();
            state_ = std::move(other.state_);
        }
        return *this;
    }
    ~Task() { cancel(); }
    void cancel() {
        if (state_) state_->cancelled = true;
        state_.reset();
    }
    bool isRunning() const { return state_ && !state_->ended; }

  private:
    std::shared_ptr<TaskState> state_;
};

/// What a request to a server tool takes besides its bytes.
struct AskOptions {
    std::chrono::milliseconds timeout{30000};       ///< from now to the complete answer; then Error timedOut, and the server is told to stop
    std::function<void(double fraction)> progress;  ///< GUI thread, in [0, 1], as the tool reports it; may be empty
};

/// Everything that a plugin's widget may know and do. One per plugin; outlives its widget. All functions and all
/// callbacks: GUI thread. An exception that leaves a callback stops the plugin, and nothing else: its place in the window
/// says what happened and offers to start it again.
class PluginContext {
  public:
    // What there is (brushing and linking: every view reads these two and nothing else) ------------------------------
    virtual const client::Dataset& dataset() const = 0;
    virtual const client::Selection& selection() const = 0;
    /// \param changed  told once after each change. parts: bits of client::DatasetPart, client::SelectionPart
    [[nodiscard]] virtual Subscription onDataset(std::function<void(std::uint32_t parts)> changed) = 0;
    [[nodiscard]] virtual Subscription onSelection(std::function<void(std::uint32_t parts)> changed) = 0;

    // What is selected; rules and effects are those of client::Selection. Every view follows, this one too. ----------
    virtual void selectPixel(Pixel pixel) = 0;                             ///< it is traced if it was not
    virtual void selectPaths(std::vector<client::PathId> paths) = 0;
    virtual void selectPath(const client::PathId& path) = 0;               ///< the current one
    virtual void selectVertex(const client::VertexId& vertex) = 0;
    virtual void clearVertex() = 0;
    virtual void hover(std::optional<client::VertexId> vertex) = 0;        ///< under the cursor; nothing: not any more

    // 3D view --------------------------------------------------------------------------------------------------------
    /// Adds an object or replaces that of the same id. It gets a switch in the 3D options. All objects go with the
    /// plugin. Errors: invalidArgument (a rule of SceneObject); the object that was there stays.
    virtual Result<void> setObject(const std::string& id, SceneObject object) = 0;
    virtual void removeObject(const std::string& id) = 0;
    virtual void removeObjects() = 0;
    /// \param picked  a person clicked an element of an object of this plugin
    [[nodiscard]] virtual Subscription onPick(std::function<void(const std::string& id, std::size_t element)> picked) = 0;

    // The renderer ---------------------------------------------------------------------------------------------------
    virtual bool isConnected() const = 0;
    /// Whether the renderer has a server tool of this name.
    virtual bool hasTool(const std::string& tool) const = 0;
    /// Sends bytes to a server tool; `answered` is called once with its reply, unless the task was cancelled.
    /// Errors: notSupported (not connected, or the renderer has no such tool), timedOut, connectionLost, and the tool's own.
    [[nodiscard]] virtual Task ask(const std::string& tool, std::vector<std::byte> request, AskOptions options,
                                   std::function<void(Result<std::vector<std::byte>>)> answered) = 0;

    // Work -----------------------------------------------------------------------------------------------------------
    /// Computes something in another thread: what takes more than some 10 ms belongs there, since nothing can interrupt
    /// a plugin that blocks the window. `work` must not touch the context, widgets, Dataset or Selection (copy what it needs: PathSet
    /// and traces are shared, immutable values); it should look at state.cancelled. `done` gets its result in the GUI
    /// thread, unless the task was cancelled; an exception arrives there as Error internal.
    template <typename T>
    [[nodiscard]] Task run(std::function<T(const TaskState& state)> work, std::function<void(Result<T>)> done) {
        return start([work = std::move(work)](const TaskState& state) -> std::shared_ptr<void> { return std::make_shared<T>(work(state)); },
                     [done = std::move(done)](const std::shared_ptr<void>& result, const Error& error) {
                         if (result) done(Result<T>(std::move(*std::static_pointer_cast<T>(result))));
                         else done(Result<T>(error));
                     });
    }

    // Look -----------------------------------------------------------------------------------------------------------
    virtual const ThemeColors& colors() const = 0;
    virtual bool isDark() const = 0;
    virtual QFont font() const = 0;
    virtual QFont smallFont() const = 0;         ///< captions
    virtual QFont strongFont() const = 0;        ///< current values
    virtual QFont numberFont() const = 0;        ///< digits of equal width
    virtual QFont smallNumberFont() const = 0;
    /// How the image view shows radiance now: exposure and transfer.
    virtual const analysis::ToneMap& toneMap() const = 0;
    /// Colours or tone map changed: paint again. Palette and style sheet of the program are already the new ones.
    [[nodiscard]] virtual Subscription onLook(std::function<void()> changed) = 0;
    /// A plot as the explorer's own. \param parent  owns it; never null
    virtual Plot& makePlot(QWidget* parent) = 0;

    // Words ----------------------------------------------------------------------------------------------------------
    // In the place of the widget (busy: a card above it, one can go on with it), as every view of the explorer has them.
    virtual void showEmpty(const QString& title, const QString& sentence) = 0;
    virtual void showError(const QString& sentence, const QString& action = {}, std::function<void()> onAction = {}) = 0;
    /// \param fraction  in [0, 1]; negative: unknown  \param onCancel  a button; empty: none
    virtual void showBusy(const QString& sentence, double fraction = -1, std::function<void()> onCancel = {}) = 0;
    virtual void showContent() = 0;              ///< the widget again
    /// At the lower edge of the window, for a few seconds.
    virtual void say(const QString& sentence) = 0;
    /// The same for errors; stays until it is closed.
    virtual void sayError(const QString& sentence) = 0;

    // Settings: kept for the next start, and saved with the window's layouts ------------------------------------------
    /// \param key  any name; the plugin's own
    virtual QVariant setting(const QString& key, const QVariant& otherwise = {}) const = 0;
    /// \param value  of a type that QSettings stores: numbers, bool, QString, QStringList, QByteArray, …
    virtual void setSetting(const QString& key, const QVariant& value) = 0;
    /// A layout was loaded: settings are others than before.
    [[nodiscard]] virtual Subscription onSettings(std::function<void()> changed) = 0;

  protected:
    virtual ~PluginContext() = default;

  private:
    virtual Task start(std::function<std::shared_ptr<void>(const TaskState&)> work,
                       std::function<void(const std::shared_ptr<void>&, const Error&)> done) = 0;
};

}  // namespace emca::explorer
