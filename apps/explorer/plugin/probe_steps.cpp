#include "plugin/probe_steps.h"

#include <QApplication>
#include <QElapsedTimer>
#include <QTemporaryDir>
#include <cstring>
#include <limits>

#include "base/qt_compat.h"
#include "plugin/plugin_host.h"

namespace emca::explorer {
namespace {

/// There is no window and no renderer.
class NoServices : public PluginServices {
  public:
    Result<void> setObject(const std::string&, const std::string&, SceneObject) override { return {}; }
    void removeObject(const std::string&, const std::string&) override {}
    void removeObjects(const std::string&) override {}
    Subscription onPick(const std::string&, std::function<void(const std::string&, std::size_t)>) override { return {}; }
    std::shared_ptr<client::Connection> connection() override { return nullptr; }
    void say(const QString&) override {}
    void sayError(const QString&) override {}
};

template <typename T>
Column column(const char* name, Scope scope, ValueType type, const std::vector<T>& values, std::vector<Index> owners = {}) {
    Column made;
    made.name = name;
    made.scope = scope;
    made.type = type;
    made.count = static_cast<Index>(values.size());
    std::vector<std::byte> bytes(values.size() * sizeof(T));
    std::memcpy(bytes.data(), values.data(), bytes.size());
    made.bytes = SharedArray<std::byte>(std::move(bytes));
    if (!owners.empty()) made.owners = SharedArray<Index>(std::move(owners));
    return made;
}

constexpr Index kPaths = 3, kDepth = 4, kVertices = kPaths * kDepth;

std::vector<Column> sampleColumns() {
    constexpr float kNaN = std::numeric_limits<float>::quiet_NaN(), kInfinite = std::numeric_limits<float>::infinity();
    std::vector<float> pdf(kVertices);
    std::vector<Color> weight(kVertices);
    std::vector<Vec2f> sample(kVertices);
    std::vector<std::uint32_t> material(kVertices);
    std::vector<std::int64_t> tries(kVertices);
    for (Index v = 0; v < kVertices; ++v) {
        pdf[v] = 0.1f * float(v + 1);
        weight[v] = Color(0.1f * float(v), 0.5f, 1);
        sample[v] = {float(v) / kVertices, 0.5f};
        material[v] = v % 2;
        tries[v] = v;
    }
    pdf[2] = kNaN;
    pdf[5] = kInfinite;
    std::vector<Column> columns;   // ordered by scope, name, type
    columns.push_back(column<std::uint8_t>("left scene", Scope::path, ValueType::boolean, {0, 1, 0}));
    columns.push_back(column("bsdf weight", Scope::vertex, ValueType::color, weight));
    columns.push_back(column("material", Scope::vertex, ValueType::text, material));
    columns.push_back(column("pdf", Scope::vertex, ValueType::float1, pdf));
    columns.push_back(column("random", Scope::vertex, ValueType::float2, sample));
    columns.push_back(column<float>("repeated", Scope::vertex, ValueType::float1, {1, 2, 3}, {1, 1, 6}));
    columns.push_back(column("tries", Scope::vertex, ValueType::integer, tries));
    return columns;
}

}  // namespace

std::shared_ptr<const client::Trace> sampleTrace() {
    PathColumns c;
    std::vector<Pixel> pixels(kPaths, Pixel{1, 2});
    std::vector<std::int64_t> samples;
    std::vector<Index> first{0};
    std::vector<std::int32_t> depths;
    std::vector<Vec3f> positions;
    for (Index path = 0; path < kPaths; ++path) {
        samples.push_back(path);
        for (Index depth = 1; depth <= kDepth; ++depth) {
            depths.push_back(static_cast<std::int32_t>(depth));
            positions.push_back({float(path), float(depth), float(depth * path)});
        }
        first.push_back((path + 1) * kDepth);
    }
    c.pixels = pixels;
    c.samples = samples;
    c.parts = std::vector<std::int32_t>(kPaths);
    c.pathFlags = std::vector<std::uint8_t>(kPaths, PathFlag::hasOrigin | PathFlag::hasEstimate);
    c.origins = std::vector<Vec3f>(kPaths);
    c.estimates = std::vector<Color>{Color(1), Color(0.5f, 0.25f, 0), Color(0)};
    c.firstVertex = first;
    c.depths = depths;
    c.vertexFlags = std::vector<std::uint8_t>(kVertices, VertexFlag::hasPosition);
    c.positions = positions;
    c.columns = sampleColumns();
    c.strings = {"diffuse", ""};
    auto trace = std::make_shared<client::Trace>();
    trace->pixels = {Pixel{1, 2}};
    trace->replays.resize(1);
    trace->samplesPerPixel = kPaths;
    if (auto paths = PathSet::make(std::move(c))) trace->paths = std::move(*paths);
    return trace;
}

QString tryPlugin(const QString& file, const std::function<void(const QString&)>& step) {
    step(QObject::tr("loading"));
    Result<PluginLibrary> library = loadPluginLibrary(file);
    if (!library) return toQString(library.error().message);
    QTemporaryDir folder;
    QSettings settings(folder.filePath("settings.ini"), QSettings::IniFormat);
    client::Dataset dataset;
    client::Selection selection;
    Theme theme;
    theme.applyTo(*qApp);
    NoServices services;
    PluginHost host(std::move(*library), {dataset, selection, theme, services, settings});
    const auto during = [&](const QString& what, const std::function<void()>& change) {
        if (!host.reason().isEmpty()) return;
        step(what);
        change();
        // Timers of the plugin that are short, layout and painting.
        QElapsedTimer clock;
        clock.start();
        do {
            QCoreApplication::sendPostedEvents();
            QCoreApplication::processEvents(QEventLoop::AllEvents, 10);
        } while (clock.elapsed() < 30);
    };
    during(QObject::tr("making its widget"), [&] { host.start(); });
    during(QObject::tr("showing it"), [&] {
        host.view()->resize(480, 360);
        host.view()->show();
    });
    const auto trace = sampleTrace();
    during(QObject::tr("feeding it a pixel"), [&] {
        dataset.addTrace(trace);
        selection.setPixel(Pixel{1, 2});
    });
    const client::PathId path{Pixel{1, 2}, 1, 0};
    during(QObject::tr("selecting a path"), [&] { selection.setPaths({path}); });
    during(QObject::tr("selecting a vertex"), [&] { selection.setVertex({path, 2, Subpath::camera}); });
    during(QObject::tr("selecting what is not there"), [&] { selection.setVertex({{Pixel{9, 9}, 7, 0}, 50, Subpath::light}); });
    during(QObject::tr("changing colours"), [&] { theme.setKind(ThemeKind::light); });
    during(QObject::tr("taking everything away"), [&] {
        selection.clearPaths();
        dataset.clearScene();
    });
    const QString reason = host.reason();
    step(QObject::tr("ending it"));
    if (!host.end(2000) && reason.isEmpty()) return QObject::tr("its work in other threads does not end when it is cancelled (TaskState::cancelled).");
    return reason;
}

}  // namespace emca::explorer
