// The panel with real mouse and keys; probes come from the reference renderer, in the scene of the firefly.
#include "probe_panel.h"

#include <gtest/gtest.h>

#include <QComboBox>
#include <QLabel>
#include <QPushButton>
#include <QSpinBox>
#include <QToolButton>
#include <QWheelEvent>
#include <cstdlib>
#include <filesystem>

#include "../testing/fake_context.h"
#include "emca/imageio/imageio.h"
#include "emca/recorder/recorder.h"
#include "emca/recorder/recording.h"
#include "emca/render/image_renderer.h"
#include "emca/render/light_probe.h"
#include "emca/render/scene_loader.h"
#include "testing/wait.h"

namespace emca::light_probe {
namespace {

using explorer::FakeContext;
using explorer::waitFor;

std::shared_ptr<const render::Scene> scene() {
    static const auto loaded = render::loadScene(std::string(EMCA_SOURCE_DIR) + "/scenes/cornell-box/scene.xml", {});
    EXPECT_TRUE(loaded) << (loaded ? "" : loaded.error().message);
    return *loaded;
}

Result<std::vector<std::byte>> answerOf(const std::vector<std::byte>& bytes) {
    const auto request = probe::decodeRequest(bytes);
    if (!request) return request.error();
    const auto probe = render::renderLightProbe(*scene(), *request, scene()->integrator(), render::SamplerKind::sobol);
    if (!probe) return probe.error();
    return probe::encode(*probe);
}

class LightProbePanel : public ::testing::Test {
  protected:
    explicit LightProbePanel(explorer::ThemeKind kind = explorer::ThemeKind::dark) : context(kind) {
        context.tool = probe::kLightProbeTool;
        context.answer = [this](const std::string&, const std::vector<std::byte>& request) {
            requests.push_back(*probe::decodeRequest(request));
            return answerOf(request);
        };
        context.settings["width"] = 64;
        context.settings["samples"] = 1;
    }

    void load() {
        const Pixel pixel{scene()->width() / 2, scene()->height() * 19 / 20};   // the floor
        RecordingOptions recorded;
        recorded.pixels = {pixel};
        Recording recording(recorded);
        render::RenderOptions options = render::sceneOptions(*scene());
        options.samplesPerPixel = 64;
        {
            const RecordScope scope(recording, pixel);
            ASSERT_TRUE(render::ImageRenderer(scene(), 1).renderPixel(pixel, options));
        }
        auto paths = recording.finish();
        ASSERT_TRUE(paths);
        client::Trace trace;
        trace.pixels = {pixel};
        trace.paths = std::move(paths).value();
        context.data.setCamera(scene()->camera().view());
        context.data.setMeshes(std::make_shared<const std::vector<Mesh>>(scene()->meshes()));
        context.data.addTrace(std::make_shared<const client::Trace>(std::move(trace)));
    }

    /// A vertex of a path that goes on for two more, and that sees the light.
    client::VertexId vertex(std::int32_t depth = 1) const {
        const PathSet& paths = context.data.paths();
        for (Index path = 0; path < paths.pathCount(); ++path) {
            const auto next = paths.findVertex(path, depth + 2);
            if (next && paths.position(*next) && seesLight(*paths.findVertex(path, depth)))
                return {{paths.pixel(path), paths.sample(path), paths.part(path)}, depth};
        }
        ADD_FAILURE() << "No path is long enough.";
        return {};
    }
    bool seesLight(Index vertex) const {
        const PathSet& paths = context.data.paths();
        const IndexRange events = paths.nextEvents(vertex);
        for (Index i = events.first; i < events.last; ++i)
            if (paths.nextEvent(i).visible) return true;
        return false;
    }

    void open() {
        panel = std::make_unique<ProbePanel>(context);
        panel->resize(364, 560);
        panel->show();
        ASSERT_TRUE(QTest::qWaitForWindowExposed(panel.get()));
    }
    bool waitForProbe() {
        return waitFor([&] { return panel->probe() && !panel->isStale(); });
    }
    void clickOn(QPointF at) { QTest::mouseClick(&panel->canvas(), Qt::LeftButton, {}, at.toPoint()); }
    template <typename Widget>
    Widget* find(const char* name) {
        auto* found = panel->findChild<Widget*>(name);
        EXPECT_TRUE(found) << name;
        return found;
    }

    FakeContext context;
    std::vector<probe::LightProbeRequest> requests;
    std::unique_ptr<ProbePanel> panel;
};

TEST_F(LightProbePanel, SaysWhatToDo) {
    const auto answer = context.answer;
    context.answer = nullptr;
    open();
    EXPECT_TRUE(context.words.contains("connect to a renderer"));
    context.answer = answer;
    context.tool = "other";
    context.data.setInfo(client::ServerInfo());
    EXPECT_TRUE(context.words.contains("no server tool"));
    context.tool = probe::kLightProbeTool;
    context.data.setInfo(client::ServerInfo());
    EXPECT_TRUE(context.words.contains("Select a vertex"));
    EXPECT_EQ(context.asked, 0);
}

TEST_F(LightProbePanel, FollowsTheSelectionWhereItIsAskedTo) {
    load();
    open();
    context.selected.setVertex(vertex(1));
    ASSERT_TRUE(waitForProbe());
    EXPECT_TRUE(context.words.isEmpty());
    ASSERT_EQ(requests.size(), 1u);
    EXPECT_EQ(requests[0].width, 64u);
    EXPECT_EQ(requests[0].height, 32u);
    EXPECT_EQ(requests[0].samplesPerPixel, 1u);
    EXPECT_EQ(requests[0].maximumDepth, 0);
    const PathSet& paths = context.data.paths();
    const auto path = paths.findPath(vertex(1).path.pixel, vertex(1).path.sample);
    EXPECT_EQ(requests[0].position, *paths.position(*paths.findVertex(*path, 1)));
    EXPECT_NEAR(length(requests[0].normal), 1, 1e-5);

    QTest::mouseClick(find<QToolButton>("probeAuto"), Qt::LeftButton);
    context.selected.setVertex(vertex(2));
    QTest::qWait(30);
    EXPECT_TRUE(panel->isStale());
    EXPECT_EQ(context.asked, 1);
    QTest::keyClick(&panel->canvas(), Qt::Key_U);
    ASSERT_TRUE(waitForProbe());
    EXPECT_EQ(context.asked, 2);
    EXPECT_NE(requests[1].position, requests[0].position);
    // Back to automatic: the stale one is renewed at once.
    context.selected.setVertex(vertex(1));
    QTest::keyClick(&panel->canvas(), Qt::Key_A);
    ASSERT_TRUE(waitForProbe());
    EXPECT_EQ(context.asked, 3);
}

TEST_F(LightProbePanel, AsksForWhatIsSet) {
    context.settings["auto"] = false;
    load();
    context.selected.setVertex(vertex());
    open();
    EXPECT_TRUE(context.words.contains("Press U"));
    find<QComboBox>("probeSize")->setCurrentIndex(1);
    find<QSpinBox>("probeSamples")->setValue(3);
    find<QSpinBox>("probeDepth")->setValue(1);
    EXPECT_EQ(context.asked, 0);
    context.showContent();
    QTest::mouseClick(find<QPushButton>("probeUpdate"), Qt::LeftButton);
    EXPECT_EQ(find<QPushButton>("probeUpdate")->text(), "Stop");
    ASSERT_TRUE(waitForProbe());
    EXPECT_EQ(find<QPushButton>("probeUpdate")->text(), "Update");
    ASSERT_EQ(requests.size(), 1u);
    EXPECT_EQ(requests[0].width, 128u);
    EXPECT_EQ(requests[0].samplesPerPixel, 3u);
    EXPECT_EQ(requests[0].maximumDepth, 1);
    EXPECT_EQ(context.settings["samples"].toInt(), 3);
    // Stopped before it is there: nothing comes.
    QTest::mouseClick(find<QPushButton>("probeUpdate"), Qt::LeftButton);
    QTest::mouseClick(find<QPushButton>("probeUpdate"), Qt::LeftButton);
    QTest::qWait(30);
    EXPECT_EQ(requests.size(), 1u);
}

TEST_F(LightProbePanel, DirectionsArePaintedWhereTheyLeadAndCanBeFollowed) {
    load();
    context.selected.setVertex(vertex());
    open();
    ASSERT_TRUE(waitForProbe());
    const auto answer = probeVertex(context.data, context.selected);
    ASSERT_TRUE(answer.vertex);
    const auto& directions = answer.vertex->directions;
    const auto outgoing = std::find_if(directions.begin(), directions.end(), [](const Direction& d) { return d.kind == DirectionKind::outgoing; });
    ASSERT_NE(outgoing, directions.end());
    const PathSet& paths = context.data.paths();
    const auto path = *paths.findPath(vertex().path.pixel, vertex().path.sample);
    const Vec3f here = *paths.position(*paths.findVertex(path, 1)), next = *paths.position(*paths.findVertex(path, 2));
    EXPECT_NEAR(length(outgoing->towards - normalize(next - here)), 0, 1e-6);
    EXPECT_TRUE(std::any_of(directions.begin(), directions.end(), [](const Direction& d) { return d.kind == DirectionKind::incoming; }));
    EXPECT_TRUE(std::any_of(directions.begin(), directions.end(), [](const Direction& d) { return d.kind == DirectionKind::nextEventVisible; }));
    // A pixel is small: all its paths are here.
    EXPECT_GT(std::count_if(directions.begin(), directions.end(), [](const Direction& d) { return d.kind == DirectionKind::other; }), 30);

    // Others hidden, so that none lies under the cursor instead.
    QTest::mouseClick(find<QToolButton>("probeShow-other"), Qt::LeftButton);
    const auto at = panel->canvas().positionOf(outgoing->towards);
    ASSERT_TRUE(at);
    QTest::mouseMove(&panel->canvas(), at->toPoint());
    ASSERT_TRUE(waitFor([&] { return panel->canvas().hoveredDirection() != nullptr; }));
    EXPECT_TRUE(find<QLabel>("probePlace")->text().startsWith("outgoing"));
    clickOn(*at);
    ASSERT_TRUE(context.selected.state().vertex);
    EXPECT_EQ(context.selected.state().vertex->depth, 2);
    EXPECT_TRUE(waitForProbe()) << "the probe follows";
    EXPECT_EQ(context.asked, 2);
}

TEST_F(LightProbePanel, AClickMarksADirectionInTheScene) {
    load();
    context.selected.setVertex(vertex());
    open();
    ASSERT_TRUE(waitForProbe());
    for (const char* name : {"probeShow-other", "probeShow-outgoing", "probeShow-incoming", "probeShow-visible", "probeShow-occluded", "probeShow-emitter"})
        QTest::mouseClick(find<QToolButton>(name), Qt::LeftButton);
    const QPointF at(200, panel->canvas().height() / 2.0 - 20);
    clickOn(at);
    ASSERT_TRUE(panel->canvas().marked());
    ASSERT_EQ(context.objects.count("direction"), 1u);
    const auto& arrows = std::get<explorer::ArrowSet>(context.objects["direction"].shape).arrows;
    ASSERT_EQ(arrows.size(), 1u);
    EXPECT_NEAR(length(normalize(arrows[0].to - arrows[0].from) - *panel->canvas().marked()), 0, 1e-5);
    EXPECT_EQ(arrows[0].from, requests[0].position);
    EXPECT_TRUE(find<QLabel>("probeValues")->text().contains("Y "));
    QTest::keyClick(&panel->canvas(), Qt::Key_Escape);
    EXPECT_TRUE(context.objects.empty());
}

TEST_F(LightProbePanel, ZoomsAtTheCursorPansAndFits) {
    load();
    context.selected.setVertex(vertex());
    open();
    ASSERT_TRUE(waitForProbe());
    ProbeCanvas& canvas = panel->canvas();
    const QPointF at(120, canvas.height() / 2.0);
    const QPointF there = canvas.transform().toPlane(at);
    QWheelEvent wheel(at, canvas.mapToGlobal(at.toPoint()), {}, {0, 480}, Qt::NoButton, Qt::NoModifier, Qt::NoScrollPhase, false);
    QApplication::sendEvent(&canvas, &wheel);
    EXPECT_GT(canvas.transform().zoom(), 1.5);
    EXPECT_NEAR(canvas.transform().toWidget(there).x(), at.x(), 1e-6);
    QTest::mousePress(&canvas, Qt::MiddleButton, {}, {150, 100});
    QMouseEvent move(QEvent::MouseMove, QPointF(130, 100), Qt::NoButton, Qt::MiddleButton, Qt::NoModifier);
    QApplication::sendEvent(&canvas, &move);
    QTest::mouseRelease(&canvas, Qt::MiddleButton, {}, {130, 100});
    EXPECT_NEAR(canvas.transform().toWidget(there).x(), at.x() - 20, 1e-6);
    QTest::keyClick(&canvas, Qt::Key_0);
    EXPECT_EQ(canvas.transform().zoom(), 1);
    QTest::keyClick(&canvas, Qt::Key_F);
    EXPECT_GE(canvas.transform().zoom(), 4);
}

TEST_F(LightProbePanel, OrientationTurnsTheNormalUp) {
    load();
    context.selected.setVertex(vertex());
    open();
    ASSERT_TRUE(waitForProbe());
    find<QComboBox>("probeOrientation")->setCurrentIndex(1);
    ASSERT_TRUE(waitFor([&] { return requests.size() == 2 && panel->probe()->map.frame() == requests[1].frame; })) << "rendered anew, so that pixels stay pixels";
    EXPECT_NEAR(dot(requests[1].frame.pole, requests[1].normal), 1, 1e-5);
    find<QComboBox>("probeProjection")->setCurrentIndex(2);
    const auto middle = panel->canvas().positionOf(requests[1].normal);
    ASSERT_TRUE(middle);
    EXPECT_NEAR(middle->x(), panel->canvas().width() / 2.0, 1);
    EXPECT_FALSE(panel->canvas().positionOf(-requests[1].normal));
}

TEST_F(LightProbePanel, KeysChangeWhatIsShown) {
    load();
    context.selected.setVertex(vertex());
    open();
    ASSERT_TRUE(waitForProbe());
    ProbeCanvas& canvas = panel->canvas();
    const QImage before = canvas.grab().toImage();
    QTest::keyClick(&canvas, Qt::Key_E);
    EXPECT_EQ(context.settings["exposure"].toDouble(), 0.5);
    const QImage brighter = canvas.grab().toImage();
    EXPECT_NE(brighter, before);
    QTest::keyClick(&canvas, Qt::Key_E, Qt::ShiftModifier);
    EXPECT_EQ(context.settings["exposure"].toDouble(), 0);
    EXPECT_EQ(canvas.grab().toImage(), before);
    QTest::keyClick(&canvas, Qt::Key_C);
    EXPECT_TRUE(context.settings["falseColor"].toBool());
    const QImage logarithmic = canvas.grab().toImage();
    QTest::keyClick(&canvas, Qt::Key_L);
    EXPECT_FALSE(context.settings["log"].toBool());
    EXPECT_NE(canvas.grab().toImage(), logarithmic);
    // Without focus here F is the window's; with it, it is ours.
    QKeyEvent wanted(QEvent::ShortcutOverride, Qt::Key_F, Qt::NoModifier), foreign(QEvent::ShortcutOverride, Qt::Key_R, Qt::NoModifier);
    wanted.ignore(), foreign.ignore();
    QApplication::sendEvent(&canvas, &wanted);
    QApplication::sendEvent(&canvas, &foreign);
    EXPECT_TRUE(wanted.isAccepted());
    EXPECT_FALSE(foreign.isAccepted());
}

TEST_F(LightProbePanel, TooManyOtherPathsAreThinnedOut) {
    const Pixel pixel{1, 1};
    Recording recording;
    {
        const RecordScope scope(recording, pixel);
        PathRecorder& emca = recorder();
        for (int i = 0; i < 10000; ++i) {
            emca.setPathIndex(i);
            emca.setPathOrigin(Vec3f{0, 0, 1});
            emca.setDepthIndex(1);
            emca.setIntersectionPos(Vec3f{});
            emca.setDepthIndex(2);
            emca.setIntersectionPos(Vec3f{1, static_cast<float>(i), 1});
            emca.endPath();
        }
    }
    client::Trace trace;
    trace.pixels = {pixel};
    trace.paths = *recording.finish();
    context.data.addTrace(std::make_shared<const client::Trace>(std::move(trace)));
    context.selected.setVertex({{pixel, 5000}, 1});
    const auto found = probeVertex(context.data, context.selected);
    ASSERT_TRUE(found.vertex);
    std::size_t others = 0;
    for (const Direction& direction : found.vertex->directions) others += direction.kind == DirectionKind::other;
    EXPECT_EQ(others, kMostOthers);
    EXPECT_EQ(found.vertex->directions.size(), kMostOthers + 2) << "its own outgoing and incoming are there";
    // The last of them is near the end: they are picked evenly.
    EXPECT_GT(found.vertex->directions[kMostOthers - 1].end->path.sample, 9900);
}

TEST_F(LightProbePanel, SavesRadianceAndPicture) {
    load();
    context.selected.setVertex(vertex());
    EXPECT_FALSE(ProbePanel(context).saveTo("early.exr"));
    open();
    ASSERT_TRUE(waitForProbe());
    const auto folder = std::filesystem::path(EMCA_BINARY_DIR) / "light_probe_test";
    std::filesystem::create_directories(folder);
    ASSERT_TRUE(panel->saveTo(QString::fromStdString((folder / "probe.exr").string())));
    const auto read = imageio::read(folder / "probe.exr");
    ASSERT_TRUE(read);
    ASSERT_EQ(read->width(), 64u);
    EXPECT_EQ(read->color({20, 10}), panel->probe()->image.color({20, 10}));
    ASSERT_TRUE(panel->saveTo(QString::fromStdString((folder / "probe.png").string())));
    EXPECT_EQ(QImage(QString::fromStdString((folder / "probe.png").string())).size(), panel->canvas().size());
}

TEST_F(LightProbePanel, ErrorsOfTheRendererAreSaid) {
    load();
    open();
    context.answer = [](const std::string&, const std::vector<std::byte>&) -> Result<std::vector<std::byte>> {
        return Error{ErrorCode::rendererFailed, "The lamp is broken."};
    };
    context.selected.setVertex(vertex());
    EXPECT_TRUE(waitFor([&] { return context.words == "The lamp is broken."; }));
    context.answer = [](const std::string&, const std::vector<std::byte>&) -> Result<std::vector<std::byte>> { return std::vector<std::byte>(100); };
    panel->requestProbe();
    EXPECT_TRUE(waitFor([&] { return context.words.contains("A light probe was expected"); }));
}

/// Not a test of anything: pictures for people, into the folder that the environment names.
TEST_F(LightProbePanel, Pictures) {
    const char* folder = std::getenv("EMCA_PROBE_PICTURES");
    if (!folder) GTEST_SKIP() << "EMCA_PROBE_PICTURES names no folder.";
    context.settings["width"] = 256;
    context.settings["samples"] = 32;
    load();
    context.selected.setVertex(vertex());
    for (const auto kind : {explorer::ThemeKind::dark, explorer::ThemeKind::light}) {
        context.theme.setKind(kind);
        context.theme.applyTo(*qobject_cast<QApplication*>(QCoreApplication::instance()));
        const QString name = QString(folder) + (kind == explorer::ThemeKind::dark ? "/dark-" : "/light-");
        open();
        ASSERT_TRUE(waitForProbe());
        panel->grab().save(name + "lat-long.png");
        find<QComboBox>("probeOrientation")->setCurrentIndex(1);
        ASSERT_TRUE(waitFor([&] { return panel->probe()->map.frame().pole == requests.back().normal; }));
        find<QComboBox>("probeProjection")->setCurrentIndex(1);
        QTest::keyClick(&panel->canvas(), Qt::Key_C);
        QTest::mouseMove(&panel->canvas(), {90, 150});
        QTest::qWait(50);
        panel->grab().save(name + "hemispheres.png");
        QTest::mouseClick(find<QToolButton>("probeAuto"), Qt::LeftButton);
        context.selected.setVertex(vertex(2));
        QTest::qWait(20);
        panel->grab().save(name + "stale.png");
        panel.reset();
        context.selected.setVertex(vertex(1));
        for (const char* key : {"orientation", "projection"}) context.settings[key] = 0;
        context.settings["falseColor"] = false;
        context.settings["auto"] = true;
    }
}

}  // namespace
}  // namespace emca::light_probe
