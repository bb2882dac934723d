#pragma once

#include <QObject>
#include <QSettings>
#include <QThreadPool>
#include <map>
#include <memory>

#include "base/theme.h"
#include "plugin/plugin_guard.h"
#include "plugin/plugin_services.h"

namespace emca::explorer {

class PluginView;

/// What the explorer gives to a plugin. Everything that calls back into the plugin goes through the guard, and nothing
/// comes any more after close().
class HostContext : public QObject, public PluginContext {
    Q_OBJECT
  public:
    struct Surroundings {
        client::Dataset& dataset;
        client::Selection& selection;
        Theme& theme;
        PluginServices& services;
        QSettings& settings;
    };
    /// \param id  of the plugin  \param view  its place in the window; outlives this
    HostContext(const Surroundings& around, const QString& id, PluginGuard::Slot slot, PluginView& view);
    ~HostContext() override;

    /// A question or work that it waits for.
    bool isWorking() const;
    /// Ends callbacks, tasks and objects. What the plugin still calls has no effect.
    void close();
    /// Waits for work in other threads. \return false if it does not end: then its threads are left alone, for good
    bool waitForWork(int milliseconds);
    void settingsChanged();

    const client::Dataset& dataset() const override { return around_.dataset; }
    const client::Selection& selection() const override { return around_.selection; }
    Subscription onDataset(std::function<void(std::uint32_t)> changed) override;
    Subscription onSelection(std::function<void(std::uint32_t)> changed) override;
    void selectPixel(Pixel pixel) override;
    void selectPaths(std::vector<client::PathId> paths) override;
    void selectPath(const client::PathId& path) override;
    void selectVertex(const client::VertexId& vertex) override;
    void clearVertex() override;
    void hover(std::optional<client::VertexId> vertex) override;
    Result<void> setObject(const std::string& id, SceneObject object) override;
    void removeObject(const std::string& id) override;
    void removeObjects() override;
    Subscription onPick(std::function<void(const std::string&, std::size_t)> picked) override;
    bool isConnected() const override;
    bool hasTool(const std::string& tool) const override;
    Task ask(const std::string& tool, std::vector<std::byte> request, AskOptions options,
             std::function<void(Result<std::vector<std::byte>>)> answered) override;
    const ThemeColors& colors() const override { return around_.theme.colors(); }
    bool isDark() const override { return around_.theme.isDark(); }
    QFont font() const override { return around_.theme.font(); }
    QFont smallFont() const override { return around_.theme.smallFont(); }
    QFont strongFont() const override { return around_.theme.strongFont(); }
    QFont numberFont() const override { return around_.theme.numberFont(); }
    QFont smallNumberFont() const override { return around_.theme.smallNumberFont(); }
    const analysis::ToneMap& toneMap() const override { return around_.theme.toneMap(); }
    Subscription onLook(std::function<void()> changed) override;
    Plot& makePlot(QWidget* parent) override;
    void showEmpty(const QString& title, const QString& sentence) override;
    void showError(const QString& sentence, const QString& action, std::function<void()> onAction) override;
    void showBusy(const QString& sentence, double fraction, std::function<void()> onCancel) override;
    void showContent() override;
    void say(const QString& sentence) override;
    void sayError(const QString& sentence) override;
    QVariant setting(const QString& key, const QVariant& otherwise) const override;
    void setSetting(const QString& key, const QVariant& value) override;
    Subscription onSettings(std::function<void()> changed) override;

  private:
    using Bytes = std::vector<std::byte>;
    Task start(std::function<std::shared_ptr<void>(const TaskState&)> work,
               std::function<void(const std::shared_ptr<void>&, const Error&)> done) override;
    /// Calls the plugin unless it is closed.
    template <typename Call>
    void call(Call callee) {
        if (*open_) PluginGuard::instance().run(slot_, std::move(callee));
    }
    /// Calls EMCA from inside of the plugin, unless it is closed.
    template <typename Call>
    void change(Call callee) {
        if (!*open_) return;
        const PluginGuard::Scope scope(PluginGuard::instance(), PluginGuard::kNobody);
        callee();
    }
    Subscription listen(std::map<int, std::function<void()>>& listeners, std::function<void()> changed);
    void tell(std::map<int, std::function<void()>>& listeners);
    std::function<void()> guarded(std::function<void()> callback);
    /// Later, in the GUI thread; from any thread.
    template <typename Call>
    static void post(const std::shared_ptr<QObject>& mailbox, Call callee);

    Surroundings around_;
    QString group_;
    std::string owner_;
    PluginGuard::Slot slot_;
    PluginView& view_;
    /// False after close(). Shared, as subscriptions and threads may outlive the context.
    std::shared_ptr<bool> open_ = std::make_shared<bool>(true);
    std::shared_ptr<QObject> mailbox_;       ///< where threads send their results
    std::shared_ptr<QThreadPool> pool_;
    std::shared_ptr<TaskState> newTask();
    std::vector<std::weak_ptr<TaskState>> tasks_;
    std::map<int, std::function<void()>> lookListeners_, settingListeners_;
    int nextListener_ = 0;
};

}  // namespace emca::explorer
