// docs/tour.md, click by click: the real window, the real renderer, the real mouse.
#include <gtest/gtest.h>

#include <QAction>
#include <QCheckBox>
#include <QFile>
#include <QMenu>
#include <QPlainTextEdit>
#include <QPushButton>
#include <QRegularExpression>
#include <QTabBar>
#include <QTimer>
#include <cmath>
#include <map>

#include "base/path_ids.h"
#include "image/image_canvas.h"
#include "image/image_view.h"
#include "paths/filter_panel.h"
#include "paths/outlier_panel.h"
#include "paths/vertex_table.h"
#include "paths/vertex_table_model.h"
#include "plots/path_plot.h"
#include "process.h"
#include "scene/scene_view.h"
#include "scene/surface_panel.h"
#include "session/session_controller.h"
#include "testing/program.h"
#include "window/notes_panel.h"
#include "window/panel_dock.h"
#include "window/selection_steps.h"
#include "window/shortcut_panel.h"

namespace emca::explorer {
namespace {

using Steps = std::map<QString, std::function<void()>>;

/// The bold words that begin each numbered line below the headings, in order.
QStringList stepsOf(const QStringList& headings) {
    QFile page(EMCA_SOURCE_DIR "/docs/tour.md");
    EXPECT_TRUE(page.open(QIODevice::ReadOnly));
    static const QRegularExpression step("^\\d+\\. \\*\\*(.+?)\\*\\*");
    QStringList found;
    bool here = false;
    for (const QString& line : QString::fromUtf8(page.readAll()).split('\n')) {
        if (line.startsWith("## ")) here = headings.contains(line.mid(3));
        if (const auto match = step.match(line); here && match.hasMatch()) found << match.captured(1);
    }
    return found;
}

class TourTest : public testing::Test {
  protected:
    void serve(const std::string& scene, const std::vector<std::string>& more = {}) {
        std::vector<std::string> command{EMCA_RENDER, EMCA_SOURCE_DIR "/scenes/" + scene + "/scene.xml", "--serve", "0"};
        command.insert(command.end(), more.begin(), more.end());
        renderer = std::make_unique<emca::test::ServingProcess>(command);
        ASSERT_FALSE(renderer->address().empty());
        program = std::make_unique<Program>(folder.filePath("settings.ini"));
        program->window->resize(1920, 1080);
        program->window->connectTo({"127.0.0.1", static_cast<std::uint16_t>(renderer->port())});
        ASSERT_TRUE(waitFor([&] { return settled() && program->dataset.currentImage() && !program->dataset.currentImage()->preview; }, 120000));
    }
    bool settled() const { return program->session.link() == LinkState::connected && program->window->isSettled(); }

    /// Does what the page says, in its order; each step that is known here is there, and the other way round.
    void follow(const QStringList& headings, Steps steps, int mostClicks) {
        const QStringList written = stepsOf(headings);
        EXPECT_EQ(written.size(), int(steps.size()));
        EXPECT_LT(written.size(), mostClicks);
        for (const QString& step : written) {
            const auto found = steps.find(step);
            ASSERT_NE(found, steps.end()) << "docs/tour.md has a step that is not tested: " << step.toStdString();
            found->second();
            QTest::qWait(20);
            ASSERT_TRUE(waitFor([&] { return settled(); }, 60000)) << step.toStdString();
            if (HasFailure()) FAIL() << "in the step " << step.toStdString();
        }
    }
    void clickPixel(Pixel pixel) {
        ImageCanvas& canvas = program->window->views().image->canvas();
        QTest::mouseClick(&canvas, Qt::LeftButton, {}, canvas.transform().rectOf(pixel).center().toPoint());
        ASSERT_TRUE(waitFor([&] { return !paths().empty() && paths().pixel(0) == pixel && settled(); }, 60000));
    }
    void clickTab(const QString& title) {
        for (QTabBar* bar : program->window->findChildren<QTabBar*>())
            for (int i = 0; i < bar->count(); ++i) {
                if (bar->tabText(i) != title) continue;
                const QPoint at = bar->tabRect(i).center();
                ASSERT_TRUE(bar->rect().contains(at)) << title.toStdString() << " is not in sight";
                QTest::mouseClick(bar, Qt::LeftButton, {}, at);
                QTest::qWait(60);
                return;
            }
        FAIL() << "no tab " << title.toStdString();
    }
    static void press(QWidget& inside, const QString& text) {
        for (QPushButton* button : inside.findChildren<QPushButton*>())
            if (button->text().startsWith(text) && button->isVisible()) {
                ASSERT_TRUE(button->isEnabled()) << text.toStdString();
                QTest::mouseClick(button, Qt::LeftButton);
                return;
            }
        FAIL() << "no button " << text.toStdString();
    }
    void key(Qt::Key key, Qt::KeyboardModifiers modifiers = {}) {
        QWidget* focus = QApplication::focusWidget();
        QTest::keyClick(focus ? focus : program->window.get(), key, modifiers);
    }
    const PathSet& paths() const { return program->dataset.paths(); }
    const client::Selection::State& selection() const { return program->selection.state(); }
    /// A number of the intersection view as it stands there.
    double shown(const QString& quantity) const {
        const VertexTableModel& model = program->window->views().vertex->model();
        for (int row = 0; row < model.rowCount(); ++row)
            if (model.quantity(row) == quantity) return model.cell(row, VertexTableModel::kThis).full.section(',', 0, 0).remove('(').toDouble();
        ADD_FAILURE() << "no " << quantity.toStdString();
        return std::nan("");
    }

    QTemporaryDir folder;
    std::unique_ptr<emca::test::ServingProcess> renderer;
    std::unique_ptr<Program> program;
};

TEST_F(TourTest, TheFireflyAndWhatFollows) {
    serve("firefly");
    MainWindow& window = *program->window;
    double strongest = 0;
    Steps why, keep;
    why["Click the burning pixel"] = [&] {
        clickPixel({146, 97});
        EXPECT_EQ(paths().pathCount(), 64u);
        EXPECT_EQ(program->dataset.current().front()->replays.front().verdict, Verdict::exact);
    };
    why["Press “Select in views”"] = [&] {
        press(*window.views().outliers, "Select in views");
        ASSERT_EQ(selection().paths.size(), 1u);
        const Index path = *findPath(paths(), selection().paths.front());
        strongest = double(luminance(*paths().estimate(path)));
        double sum = 0;
        for (Index i = 0; i < paths().pathCount(); ++i) sum += double(luminance(*paths().estimate(i)));
        EXPECT_GT(strongest, 0.9 * sum) << "one path is nearly all of the pixel";
    };
    why["Press `.`"] = [&] {
        window.views().image->canvas().setFocus();
        key(Qt::Key_Period);
        ASSERT_TRUE(selection().vertex);
        const Index vertex = *findVertex(paths(), *selection().vertex);
        const IndexRange tests = paths().nextEvents(vertex);
        ASSERT_FALSE(tests.empty());
        for (Index i = tests.first; i < tests.last; ++i) EXPECT_FALSE(paths().nextEvent(i).visible);
        EXPECT_LT(shown("BSDF pdf"), 0.2) << "rarely chosen";
    };
    why["Press `.` again"] = [&] {
        const double before = shown("throughput");
        key(Qt::Key_Period);
        EXPECT_TRUE(std::isfinite(before));
        EXPECT_TRUE(std::isfinite(shown("throughput")));
    };
    follow({"Why does a pixel burn?"}, why, 10);
    if (HasFailure()) return;

    keep["Right-click the brightest point"] = [&] {
        clickTab("Luminance");
        PathPlot& plot = *window.views().plots[1].widget;
        ScatterPlot& row = plot.row(0);
        // The menu runs its own loop: the choice is made from inside.
        QTimer::singleShot(0, &window, [&] {
            ASSERT_TRUE(waitFor([] { return QApplication::activePopupWidget() != nullptr; }));
            auto* menu = qobject_cast<QMenu*>(QApplication::activePopupWidget());
            auto* filter = menu->findChild<QMenu*>("filterByValue");
            ASSERT_TRUE(filter);
            EXPECT_TRUE(filter->actions().front()->text().startsWith("luminance ≥"));
            filter->actions().front()->trigger();
            menu->close();
        });
        const Index path = *findPath(paths(), selection().paths.front());
        emit row.menuRequested(row.mapToGlobal(row.rect().center()), path);
        QApplication::setActiveWindow(&window);   // without a window manager nobody else does
        EXPECT_EQ(window.views().filter->rowCount(), 1u);
        EXPECT_EQ(window.views().filter->countText(), "1 of 64 paths");
        EXPECT_TRUE(window.views().filter->queryText().startsWith("luminance >= "));
    };
    keep["Tick “select on new pixels”."] = [&] {
        QTest::qWait(60);
        for (QCheckBox* box : window.views().filter->findChildren<QCheckBox*>())
            if (box->text() == "select on new pixels") QTest::mouseClick(box, Qt::LeftButton, {}, {8, box->height() / 2});
        EXPECT_TRUE(window.views().filter->isAutomatic());
    };
    keep["Click another pixel."] = [&] {
        clickPixel({150, 90});
        EXPECT_TRUE(window.views().filter->countText().endsWith("of 64 paths"));
    };
    keep["Press `Ctrl+Z`"] = [&] {
        window.views().image->canvas().setFocus();
        for (int i = 0; i < 10 && selection().pixel != Pixel{146, 97}; ++i) key(Qt::Key_Z, Qt::ControlModifier);
        EXPECT_EQ(selection().pixel, (Pixel{146, 97}));
        ASSERT_TRUE(waitFor([&] { return paths().pixel(0) == Pixel{146, 97}; }));
        key(Qt::Key_Z, Qt::ControlModifier | Qt::ShiftModifier);
        EXPECT_EQ(selection().pixel, (Pixel{150, 90}));
        for (int i = 0; i < 10 && selection().pixel != Pixel{146, 97}; ++i) key(Qt::Key_Z, Qt::ControlModifier);
    };
    keep["Press `Ctrl+4`"] = [&] {
        key(Qt::Key_4, Qt::ControlModifier);
        QTest::qWait(60);
        EXPECT_GT(window.dock("scene")->width(), window.width() / 2);
    };
    keep["Write a note"] = [&] {
        window.notes().pixelNotes().setFocus();
        QTest::keyClicks(&window.notes().pixelNotes(), "the sun, found by the BSDF alone");
        EXPECT_EQ(program->session.pixelNote({146, 97}), "the sun, found by the BSDF alone");
    };
    keep["Press `F1`"] = [&] {
        key(Qt::Key_F1);
        EXPECT_TRUE(window.shortcuts().isVisible());
        key(Qt::Key_Escape);
        EXPECT_FALSE(window.shortcuts().isVisible());
    };
    follow({"Is it this pixel alone?", "Keep it"}, keep, 10);
}

TEST_F(TourTest, TheLightThatIsHalfSampled) {
    serve("light-sampling-bug", {"--spp", "16"});
    MainWindow& window = *program->window;
    Steps steps;
    steps["Click the tab “Surfaces”."] = [&] { clickTab("Surfaces"); };
    steps["Tick “next-event density”"] = [&] {
        QCheckBox* box = window.views().surfaces->findChild<QCheckBox*>("collect:next-event density");
        ASSERT_TRUE(box);
        ASSERT_TRUE(waitFor([&] { return box->visibleRegion().contains({8, box->height() / 2}); }));
        QTest::mouseClick(box, Qt::LeftButton, {}, {8, box->height() / 2});
    };
    steps["Press “Render with 1 layer”."] = [&] {
        press(*window.views().surfaces, "Render with 1 layer");
        ASSERT_TRUE(waitFor([&] { return program->dataset.surface() && settled(); }, 120000));
        EXPECT_EQ(window.views().scene->surfaces().style().layer, "next-event density");
    };
    steps["Look at the light from below."] = [&] {
        // What one sees there: faces of the light without a single point, and their share of its area.
        const auto field = program->dataset.surface();
        const auto meshes = program->dataset.meshes();
        ASSERT_TRUE(field && meshes);
        const auto light = std::ranges::find_if(*meshes, [](const Mesh& mesh) { return maxComponent(mesh.emission) > 0; });
        ASSERT_NE(light, meshes->end());
        const auto& part = field->meshes[static_cast<std::size_t>(light - meshes->begin())];
        const auto refined = refine(*light, part.subdivision);
        ASSERT_TRUE(refined);
        double empty = 0, whole = 0, most = 0;
        for (std::size_t f = 0; f < part.faceCount; ++f) most = std::max(most, double(field->layers.front().values[part.firstFace + f]));
        for (std::size_t f = 0; f < refined->triangles.size(); ++f) {
            const Triangle& t = refined->triangles[f];
            const auto& p = refined->positions;
            const double area = double(length(cross(p[t[1]] - p[t[0]], p[t[2]] - p[t[0]])));
            whole += area;
            if (!(double(field->layers.front().values[part.firstFace + f]) > 0.05 * most)) empty += area;
        }
        EXPECT_NEAR(empty / whole, 0.5, 0.1) << "half of the light is never sampled";
        ViewPose pose = window.views().scene->pose();
        window.views().scene->setPose(lookingAt(pose, {2.78, 3.6, 1.5}, {2.78, 5.4, 2.8}));
    };
    follow({"Why are the shadows wrong?"}, steps, 10);
}

}  // namespace
}  // namespace emca::explorer
