#pragma once

#include <QApplication>
#include <QTimer>
#include <map>
#include <memory>
#include <string>
#include <thread>

#include "base/theme.h"
#include "emca/explorer/plugin.h"

namespace emca::explorer {

/// A context without a window, for tests of plugins: it holds real models and a real theme, remembers what the plugin
/// says and answers its requests, a little later, with a function of the test.
class FakeContext final : public PluginContext {
  public:
    using Answer = std::function<Result<std::vector<std::byte>>(const std::string& tool, const std::vector<std::byte>& request)>;

    explicit FakeContext(ThemeKind kind = ThemeKind::dark) : theme(kind) { theme.applyTo(*qobject_cast<QApplication*>(QCoreApplication::instance())); }

    // For the test.
    client::Dataset data;
    client::Selection selected;
    Theme theme;
    Answer answer;                       ///< null: not connected
    std::string tool;                    ///< the one that the renderer has
    int asked = 0;
    std::map<std::string, SceneObject> objects;
    QString words;                       ///< of the last empty or error state; empty while the widget is shown
    QString said;
    std::map<QString, QVariant> settings;
    std::function<void(const std::string&, std::size_t)> pick;

    const client::Dataset& dataset() const override { return data; }
    const client::Selection& selection() const override { return selected; }
    Subscription onDataset(std::function<void(std::uint32_t)> changed) override { return listening(data, std::move(changed)); }
    Subscription onSelection(std::function<void(std::uint32_t)> changed) override { return listening(selected, std::move(changed)); }
    void selectPixel(Pixel pixel) override { selected.setPixel(pixel); }
    void selectPaths(std::vector<client::PathId> paths) override { selected.setPaths(std::move(paths)); }
    void selectPath(const client::PathId& path) override { selected.setCurrentPath(path); }
    void selectVertex(const client::VertexId& vertex) override { selected.setVertex(vertex); }
    void clearVertex() override { selected.clearVertex(); }
    void hover(std::optional<client::VertexId> vertex) override { selected.setHovered(vertex); }
    Result<void> setObject(const std::string& id, SceneObject object) override {
        objects[id] = std::move(object);
        return {};
    }
    void removeObject(const std::string& id) override { objects.erase(id); }
    void removeObjects() override { objects.clear(); }
    Subscription onPick(std::function<void(const std::string&, std::size_t)> picked) override {
        pick = std::move(picked);
        return Subscription([this] { pick = nullptr; });
    }
    bool isConnected() const override { return answer != nullptr; }
    bool hasTool(const std::string& name) const override { return answer && name == tool; }
    Task ask(const std::string& name, std::vector<std::byte> request, AskOptions options,
             std::function<void(Result<std::vector<std::byte>>)> answered) override {
        ++asked;
        auto state = std::make_shared<TaskState>();
        QTimer::singleShot(0, &timers_, [this, name, request = std::move(request), options = std::move(options), answered = std::move(answered), state] {
            if (state->cancelled) return;
            if (options.progress) options.progress(0.5);
            auto reply = answer(name, request);
            if (state->cancelled) return;
            state->ended = true;
            answered(std::move(reply));
        });
        return Task(state);
    }
    const ThemeColors& colors() const override { return theme.colors(); }
    bool isDark() const override { return theme.isDark(); }
    QFont font() const override { return theme.font(); }
    QFont smallFont() const override { return theme.smallFont(); }
    QFont strongFont() const override { return theme.strongFont(); }
    QFont numberFont() const override { return theme.numberFont(); }
    QFont smallNumberFont() const override { return theme.smallNumberFont(); }
    const analysis::ToneMap& toneMap() const override { return theme.toneMap(); }
    Subscription onLook(std::function<void()> changed) override {
        const auto a = QObject::connect(&theme, &Theme::themeChanged, &timers_, changed);
        const auto b = QObject::connect(&theme, &Theme::toneMapChanged, &timers_, changed);
        return Subscription([a, b] { QObject::disconnect(a), QObject::disconnect(b); });
    }
    Plot& makePlot(QWidget*) override { qFatal("These tests have no plots."); }
    void showEmpty(const QString&, const QString& sentence) override { words = sentence; }
    void showError(const QString& sentence, const QString&, std::function<void()>) override { words = sentence; }
    void showBusy(const QString&, double, std::function<void()>) override {}
    void showContent() override { words.clear(); }
    void say(const QString& sentence) override { said = sentence; }
    void sayError(const QString& sentence) override { said = sentence; }
    QVariant setting(const QString& key, const QVariant& otherwise) const override {
        const auto found = settings.find(key);
        return found == settings.end() ? otherwise : found->second;
    }
    void setSetting(const QString& key, const QVariant& value) override { settings[key] = value; }
    Subscription onSettings(std::function<void()>) override { return Subscription(); }

  private:
    template <typename Model>
    static Subscription listening(Model& model, std::function<void(std::uint32_t)> changed) {
        return Subscription([&model, id = model.listen(std::move(changed))] { model.unlisten(id); });
    }
    Task start(std::function<std::shared_ptr<void>(const TaskState&)> work,
               std::function<void(const std::shared_ptr<void>&, const Error&)> done) override {
        auto state = std::make_shared<TaskState>();
        QTimer::singleShot(0, &timers_, [work = std::move(work), done = std::move(done), state] {
            const auto result = work(*state);
            state->ended = true;
            if (!state->cancelled) done(result, Error());
        });
        return Task(state);
    }
    QObject timers_;   ///< its end ends what is still to come
};

}  // namespace emca::explorer
