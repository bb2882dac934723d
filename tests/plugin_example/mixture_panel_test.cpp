// The example's panel with real mouse and keys: both halves of the plugin, the server half beside a light probe that sees
// a mixture that is known.
#include "mixture_panel.h"

#include <gtest/gtest.h>

#include <QComboBox>
#include <QLabel>
#include <QPushButton>
#include <QSpinBox>
#include <QTableWidget>
#include <QTest>
#include <QToolButton>
#include <cmath>

#include "../../plugins/testing/fake_context.h"
#include "emca/probe/light_probe.h"
#include "emca/recorder/recorder.h"
#include "emca/recorder/recording.h"
#include "lobe_picture.h"
#include "server_half.h"
#include "testing/wait.h"

namespace mixture {
namespace {

using namespace emca;
using explorer::FakeContext;
using explorer::waitFor;

const std::vector<Lobe> kTruth{{normalize(Vec3d{1, 1, 1}), 60, 0.7}, {normalize(Vec3d{-1, 0.5, -1}), 20, 0.3}};

class Patient final : public RequestMonitor {
  public:
    bool cancelled() const override { return false; }
    void progress(double) override {}
    void preview(PixelRect, const std::vector<Color>&) override {}
};

class ProbedRenderer final : public ToolHost {
  public:
    Result<std::vector<std::byte>> ask(const std::string&, std::span<const std::byte> bytes, RequestMonitor&) override {
        const auto request = probe::decodeRequest(bytes);
        if (!request) return request.error();
        if (!trouble.empty()) return Error{ErrorCode::rendererFailed, trouble};
        probe::LightProbe found;
        found.map = probe::SphereMap(request->frame, request->width, request->height);
        found.samplesPerPixel = request->samplesPerPixel;
        found.image = Image(request->width, request->height, probe::probeChannels());
        for (std::uint32_t y = 0; y < request->height; ++y)
            for (std::uint32_t x = 0; x < request->width; ++x) {
                const Vec3f d = found.map.direction({x + 0.5, y + 0.5});
                found.image.setColor({x, y}, Color(static_cast<float>(density(kTruth, {double(d.x), double(d.y), double(d.z)}))));
            }
        return probe::encode(found);
    }
    std::string trouble;
};

class MixturePanelTest : public ::testing::Test {
  protected:
    MixturePanelTest() {
        tool.setHost(renderer);
        context.tool = kTool;
        context.answer = [this](const std::string&, const std::vector<std::byte>& bytes) {
            requests.push_back(*decodeRequest(bytes));
            return tool.answer(bytes, monitor);
        };
        context.settings["components"] = 2;
        Recording recording;
        for (std::int64_t sample = 0; sample < 4; ++sample) {
            const RecordScope scope(recording, {2, 3});
            PathRecorder& emca = recorder();
            emca.setPathIndex(sample);
            emca.setPathOrigin(Vec3f{0, 0, 5});
            const float shift = 0.01f * static_cast<float>(sample);
            for (const auto& [depth, position] : {std::pair{1, Vec3f{shift, 0, 0}}, {2, Vec3f{1, 1, shift}}, {3, Vec3f{0, 2, 0}}}) {
                emca.setDepthIndex(depth);
                emca.setIntersectionPos(position);
            }
            emca.setFinalEstimate(Color(1.f));
        }
        client::Trace trace;
        trace.pixels = {{2, 3}};
        trace.paths = std::move(recording.finish()).value();
        context.data.addTrace(std::make_shared<const client::Trace>(std::move(trace)));
    }
    void open() {
        panel = std::make_unique<MixturePanel>(context);
        panel->resize(380, 560);
        panel->show();
        ASSERT_TRUE(QTest::qWaitForWindowExposed(panel.get()));
    }
    void select(std::int64_t sample, std::int32_t depth) { context.selected.setVertex({{{2, 3}, sample, 0}, depth}); }
    template <typename Widget> Widget& find(const char* name = "") {
        Widget* found = *name ? panel->findChild<Widget*>(name) : panel->findChild<Widget*>();
        if (!found) throw std::runtime_error(std::string("no widget ") + name);
        return *found;
    }
    bool fitted(int times) { return waitFor([&] { return context.asked == times && panel->reply() && requests.size() == std::size_t(times); }); }
    /// A dot of the lobe in the picture, as a person sees it.
    QPoint dotOf(std::size_t lobe) {
        const QImage image = find<LobePicture>().grab().toImage();
        const QRgb color = lobeColor(lobe).rgb();
        for (int y = 2; y + 2 < image.height(); ++y)
            for (int x = 2; x + 2 < image.width(); ++x) {
                bool all = true;
                for (int dy = -1; dy <= 1; ++dy)
                    for (int dx = -1; dx <= 1; ++dx) all = all && image.pixel(x + dx, y + dy) == color;
                if (all) return {x, y};
            }
        ADD_FAILURE() << "no dot of lobe " << lobe;
        return {};
    }
    int chosenRow() {
        const auto rows = find<QTableWidget>("mixtureTable").selectionModel()->selectedRows();
        return rows.isEmpty() ? -1 : rows.front().row();
    }

    FakeContext context;
    ProbedRenderer renderer;
    Patient monitor;
    MixtureTool tool;
    std::vector<Request> requests;
    std::unique_ptr<MixturePanel> panel;
};

TEST_F(MixturePanelTest, SaysWhatToDo) {
    const auto answer = std::exchange(context.answer, nullptr);
    open();
    EXPECT_TRUE(context.words.contains("--tool")) << context.words.toStdString();
    context.answer = answer;
    context.data.setInfo(client::ServerInfo());
    EXPECT_TRUE(context.words.contains("Select a vertex")) << context.words.toStdString();
    QTest::mouseClick(&find<QPushButton>("mixtureFit"), Qt::LeftButton);
    EXPECT_EQ(context.asked, 0) << "there is nothing to fit at";
}

TEST_F(MixturePanelTest, ASelectedVertexIsFittedAndShownInPictureTableAndScene) {
    open();
    select(0, 1);
    ASSERT_TRUE(fitted(1));
    EXPECT_TRUE(context.words.isEmpty());
    EXPECT_EQ(requests[0].components, 2u);
    EXPECT_FALSE(requests[0].lightProbe.empty());
    const Fit& fit = panel->reply()->fit;
    ASSERT_EQ(fit.lobes.size(), 2u);
    for (std::size_t k = 0; k < 2; ++k) EXPECT_GT(dot(fit.lobes[k].mean, kTruth[k].mean), std::cos(0.02));
    QTableWidget& table = find<QTableWidget>("mixtureTable");
    ASSERT_EQ(table.rowCount(), 2);
    EXPECT_NEAR(table.item(0, 0)->text().section(' ', 0, 0).toDouble(), 70, 1);
    const auto& arrows = std::get<explorer::ArrowSet>(context.objects.at("arrows").shape);
    ASSERT_EQ(arrows.arrows.size(), 2u);
    const Vec3f along = arrows.arrows[0].to - arrows.arrows[0].from;
    EXPECT_GT(dot(normalize(Vec3d{double(along.x), double(along.y), double(along.z)}), kTruth[0].mean), std::cos(0.02));
    EXPECT_TRUE(context.objects.contains("body"));
}

TEST_F(MixturePanelTest, ALobeIsChosenInThePictureInTheTableOrInTheScene) {
    open();
    select(0, 1);
    ASSERT_TRUE(fitted(1));
    LobePicture& picture = find<LobePicture>();
    const QImage before = picture.grab().toImage();
    QTest::mouseClick(&picture, Qt::LeftButton, {}, dotOf(1));
    EXPECT_EQ(chosenRow(), 1);
    const QImage second = picture.grab().toImage();
    EXPECT_NE(second, before) << "its ring is thicker";
    QTableWidget& table = find<QTableWidget>("mixtureTable");
    QTest::mouseClick(table.viewport(), Qt::LeftButton, {}, table.visualItemRect(table.item(0, 1)).center());
    EXPECT_EQ(chosenRow(), 0);
    EXPECT_NE(picture.grab().toImage(), second);
    table.setFocus();
    QTest::keyClick(&table, Qt::Key_Down);
    EXPECT_EQ(chosenRow(), 1);
    EXPECT_EQ(picture.grab().toImage(), second);
    context.pick("arrows", 0);
    EXPECT_EQ(chosenRow(), 0);
    QTest::mouseClick(&picture, Qt::LeftButton, {}, QPoint(2, picture.height() / 2));
    EXPECT_EQ(chosenRow(), 0) << "beside all lobes: nothing changes";
}

TEST_F(MixturePanelTest, AnotherVertexIsFittedByItselfOrWhenAsked) {
    open();
    select(0, 1);
    ASSERT_TRUE(fitted(1));
    select(0, 2);
    ASSERT_TRUE(fitted(2));
    EXPECT_NE(requests[0].lightProbe, requests[1].lightProbe);
    QToolButton& automatic = find<QToolButton>();
    QTest::mouseClick(&automatic, Qt::LeftButton);
    EXPECT_FALSE(context.settings["auto"].toBool());
    select(1, 1);
    EXPECT_EQ(context.asked, 2);
    EXPECT_TRUE(context.objects.empty()) << "they were those of the vertex before";
    QTest::mouseClick(&find<QPushButton>("mixtureFit"), Qt::LeftButton);
    ASSERT_TRUE(fitted(3));
    EXPECT_FALSE(context.objects.empty());
}

TEST_F(MixturePanelTest, SourceAndNumberOfLobesAreAskedForAndRemembered) {
    open();
    select(0, 1);
    ASSERT_TRUE(fitted(1));
    QSpinBox& lobes = find<QSpinBox>("mixtureComponents");
    lobes.setFocus();
    lobes.selectAll();
    QTest::keyClicks(&lobes, "5");
    QTest::keyClick(&lobes, Qt::Key_Return);
    ASSERT_TRUE(fitted(2));
    EXPECT_EQ(requests[1].components, 5u);
    QComboBox& source = find<QComboBox>("mixtureSource");
    source.setFocus();
    QTest::keyClick(&source, Qt::Key_Down);
    ASSERT_TRUE(fitted(3));
    EXPECT_TRUE(requests[2].lightProbe.empty());
    EXPECT_EQ(requests[2].directions.size(), 4u) << "of four paths within 2 % of the way to the camera";
    EXPECT_EQ(context.settings["components"].toInt(), 5);
    EXPECT_EQ(context.settings["source"].toInt(), 1);
    panel.reset();
    open();
    EXPECT_EQ(find<QComboBox>("mixtureSource").currentIndex(), 1);
    EXPECT_EQ(find<QSpinBox>("mixtureComponents").value(), 5);
}

TEST_F(MixturePanelTest, ATroubleOfTheRendererIsSaidAndTheLobesStay) {
    open();
    select(0, 1);
    ASSERT_TRUE(fitted(1));
    renderer.trouble = "The lamp is broken.";
    QTest::mouseClick(&find<QPushButton>("mixtureFit"), Qt::LeftButton);
    ASSERT_TRUE(waitFor([&] {
        for (const QLabel* label : panel->findChildren<QLabel*>())
            if (label->text().contains("The lamp is broken.")) return true;
        return false;
    }));
    EXPECT_EQ(find<QTableWidget>("mixtureTable").rowCount(), 2);
}

}  // namespace
}  // namespace mixture
