#include "window/main_window.h"

#include <gtest/gtest.h>

#include <QAction>
#include <QApplication>
#include <QDir>
#include <QDropEvent>
#include <QLabel>
#include <QMimeData>
#include <QTemporaryDir>
#include <QUrl>

#include "base/state_overlay.h"
#include "emca/imageio/imageio.h"
#include "image/image_canvas.h"
#include "image/image_view.h"
#include "paths/filter_panel.h"
#include "paths/query_field.h"
#include "program/unattended.h"
#include "testing/program.h"
#include "window/connect_panel.h"
#include "window/history_view.h"
#include "window/panel_dock.h"
#include "window/toast.h"

namespace emca::explorer {
namespace {

TEST_F(MainWindowTest, AClickInTheImageReachesEveryView) {
    Program program(settingsFile());
    connectTo(program);
    ImageCanvas& canvas = program.window->views().image->canvas();
    QTest::mouseClick(&canvas, Qt::LeftButton, {}, canvas.transform().rectOf({7, 5}).center().toPoint());
    ASSERT_TRUE(waitFor([&] { return !program.dataset.paths().empty(); }));
    EXPECT_EQ(program.dataset.paths().pixel(0), (Pixel{7, 5}));
    auto* badge = program.window->findChild<QLabel*>("verdict");
    ASSERT_TRUE(badge);
    EXPECT_EQ(badge->text(), "replay exact");
}

TEST_F(MainWindowTest, ChosenSamplesHoldForTheRenderThatConnectingStarts) {
    Program program(settingsFile());
    program.window->setSamples(2);
    connectTo(program);
    EXPECT_EQ(program.dataset.currentImage()->samplesPerPixel, 2u);
    program.selection.setPixel(Pixel{1, 1});
    ASSERT_TRUE(waitFor([&] { return program.dataset.paths().pathCount() == 2; }));
}

TEST_F(MainWindowTest, KeysStepThroughPathsAndVertices) {
    Program program(settingsFile());
    connectTo(program);
    program.selection.setPixel(Pixel{7, 5});
    ASSERT_TRUE(waitFor([&] { return program.dataset.paths().pathCount() == 4; }));
    MainWindow& window = *program.window;
    const auto key = [&](Qt::Key k) { QTest::keyClick(&window, k); };
    key(Qt::Key_BracketRight);
    EXPECT_EQ(program.selection.state().currentPath->sample, 0);
    key(Qt::Key_BracketRight);
    EXPECT_EQ(program.selection.state().currentPath->sample, 1);
    key(Qt::Key_BracketLeft);
    key(Qt::Key_BracketLeft);
    EXPECT_EQ(program.selection.state().currentPath->sample, 3) << "wraps around";
    key(Qt::Key_Period);
    EXPECT_EQ(program.selection.state().vertex->depth, 1);
    key(Qt::Key_Period);
    key(Qt::Key_Period);
    EXPECT_EQ(program.selection.state().vertex->depth, 2) << "stops at the end";
    key(Qt::Key_Comma);
    EXPECT_EQ(program.selection.state().vertex->depth, 1);
    key(Qt::Key_Escape);
    EXPECT_FALSE(program.selection.state().vertex);
    key(Qt::Key_Escape);
    EXPECT_TRUE(program.selection.state().paths.empty());
    QTest::keyClick(&window, Qt::Key_Z, Qt::ControlModifier);
    EXPECT_EQ(program.selection.state().currentPath->sample, 3);
}

TEST_F(MainWindowTest, AFilterSelectsInEveryView) {
    Program program(settingsFile());
    connectTo(program);
    MainWindow& window = *program.window;
    ImageCanvas& canvas = window.views().image->canvas();
    const auto click = [&](Pixel pixel) {
        QTest::mouseClick(&canvas, Qt::LeftButton, {}, canvas.transform().rectOf(pixel).center().toPoint());
        ASSERT_TRUE(waitFor([&] { return !program.dataset.paths().empty() && program.dataset.paths().pixel(0) == pixel && window.isSettled(); }));
    };
    click({7, 5});
    window.showDock("filter");
    FilterPanel& filter = *window.views().filter;
    filter.field().setFocus();
    // Letters that are keys of the window (R, F, L, [ and .) are text here.
    QTest::keyClicks(&filter.field(), "luminance == max(luminance) and all(v.position.x > -1e9) and depth in (1, 2, 3)");
    EXPECT_EQ(filter.countText(), "1 of 4 paths") << filter.noteText().toStdString();
    EXPECT_TRUE(program.selection.state().paths.empty());
    EXPECT_FALSE(window.action("rectangle")->isChecked());
    QTest::keyClick(&filter.field(), Qt::Key_Return);
    // Sample 2 of every pixel is the strong one.
    EXPECT_EQ(program.selection.state().paths, (std::vector<client::PathId>{{{7, 5}, 2, 0}}));
    filter.setAutomatic(true);
    click({3, 4});
    EXPECT_EQ(program.selection.state().paths, (std::vector<client::PathId>{{{3, 4}, 2, 0}}));
    canvas.setFocus();
    QTest::keyClick(&window, Qt::Key_Escape);
    EXPECT_TRUE(program.selection.state().paths.empty());
    QTest::keyClick(&window, Qt::Key_Z, Qt::ControlModifier);
    EXPECT_EQ(program.selection.state().paths.size(), 1u);
}

TEST_F(MainWindowTest, ADroppedImageIsOpened) {
    Program program(settingsFile());
    const QString file = folder.filePath("dropped.pfm");
    ASSERT_TRUE(imageio::write(file.toStdString(), Image(12, 9)));
    QMimeData data;
    data.setUrls({QUrl::fromLocalFile(file)});
    QDragEnterEvent enter(QPoint(200, 200), Qt::CopyAction, &data, Qt::LeftButton, Qt::NoModifier);
    QApplication::sendEvent(program.window.get(), &enter);
    EXPECT_TRUE(enter.isAccepted());
    QDropEvent drop(QPointF(200, 200), Qt::CopyAction, &data, Qt::LeftButton, Qt::NoModifier);
    QApplication::sendEvent(program.window.get(), &drop);
    ASSERT_TRUE(waitFor([&] { return program.dataset.images().size() == 1; }));
    EXPECT_EQ(program.dataset.currentImage()->title, "dropped.pfm");
    EXPECT_TRUE(program.window->views().image->overlay().sentence().isEmpty());
}

TEST_F(MainWindowTest, EveryStateSaysWhatToDo) {
    Program program(settingsFile());
    StateOverlay& overlay = program.window->views().image->overlay();
    EXPECT_TRUE(overlay.sentence().contains("Connect to a renderer"));
    program.selection.setPixel(Pixel{1, 1});
    EXPECT_TRUE(program.window->toast().sentence().contains("no renderer is connected"));
    program.window->connectTo({"127.0.0.1", 1});
    ASSERT_TRUE(waitFor([&] { return program.session.link() == LinkState::offline; }));
    EXPECT_FALSE(program.window->toast().sentence().isEmpty());
}

TEST_F(MainWindowTest, LayoutThemeAndAddressesAreRemembered) {
    {
        Program program(settingsFile());
        program.window->action("theme")->trigger();
        EXPECT_FALSE(program.theme.isDark());
        program.window->dock("history")->hide();
        program.window->connectPanel().remember({"render.example", 1234});
        program.window->close();
    }
    Program program(settingsFile());
    EXPECT_FALSE(program.theme.isDark());
    EXPECT_FALSE(program.window->dock("history")->isVisibleTo(program.window.get()));
    EXPECT_EQ(program.window->connectPanel().history(), QStringList{"render.example:1234"});
    program.window->resetLayout();
    EXPECT_TRUE(program.window->dock("history")->isVisibleTo(program.window.get()));
}

TEST_F(MainWindowTest, DefaultLayoutGivesTheImageTwoFifthsAndTheSceneMost) {
    Program program(settingsFile());
    program.window->resize(1920, 1080);
    program.window->resetLayout();
    QTest::qWait(50);
    const double image = program.window->dock("image")->width(), scene = program.window->dock("scene")->width();
    EXPECT_NEAR(image / program.window->width(), 0.4, 0.03);
    EXPECT_GT(scene, image);
    EXPECT_GT(program.window->dock("scene")->height(), program.window->dock("paths")->height());
    EXPECT_GT(program.window->dock("paths")->y(), program.window->dock("scene")->y());
    EXPECT_GT(program.window->dock("vertex")->x(), program.window->dock("paths")->x());
    EXPECT_GT(program.window->dock("outliers")->x(), program.window->dock("scene")->x());
}

TEST_F(MainWindowTest, BothThemesRepaintEverything) {
    Program program(settingsFile());
    const auto ground = [&] { return program.window->views().image->canvas().grab().toImage().pixelColor(2, 2); };
    EXPECT_EQ(ground(), darkColors().ground);
    program.theme.setKind(ThemeKind::light);
    EXPECT_EQ(ground(), lightColors().ground);
    program.theme.setKind(ThemeKind::dark);
}

TEST_F(MainWindowTest, TheTourLeavesPicturesAndAStory) {
    Program program(settingsFile());
    auto started = Server::start(renderer);
    ASSERT_TRUE(started);
    Options options;
    options.address = client::Address{"127.0.0.1", (*started)->port()};
    options.tour = folder.filePath("tour");
    Unattended steps(options, program.dataset, program.selection, program.session, *program.window);
    int code = -1;
    QObject::connect(&steps, &Unattended::ended, [&](int ended, const QString& sentence) {
        code = ended;
        EXPECT_TRUE(sentence.isEmpty()) << sentence.toStdString();
    });
    steps.start();
    ASSERT_TRUE(waitFor([&] { return code >= 0; }, 60000));
    EXPECT_EQ(code, 0);
    const QDir tour(options.tour);
    for (const char* file : {"01-window.png", "02-image.png", "03-scene.png", "04-plots-rgb.png"}) EXPECT_FALSE(QImage(tour.filePath(file)).isNull()) << file;
    QFile story(tour.filePath("index.md"));
    ASSERT_TRUE(story.open(QIODevice::ReadOnly));
    const QString text = QString::fromUtf8(story.readAll());
    // Sample 2 of every pixel is the strong one, and its throughput jumps from 1 to 16.
    EXPECT_TRUE(text.contains("sample 2")) << text.toStdString();
    EXPECT_TRUE(text.contains("a factor of 16.00"));
    EXPECT_TRUE(text.contains("*exact*"));
}

TEST_F(MainWindowTest, FailuresOfAnUnattendedRunHaveTheirExitCodes) {
    const auto run = [&](Options options) {
        Program program(settingsFile());
        Unattended steps(options, program.dataset, program.selection, program.session, *program.window);
        std::pair<int, QString> result{-1, {}};
        QObject::connect(&steps, &Unattended::ended, [&](int code, const QString& sentence) { result = {code, sentence}; });
        steps.start();
        EXPECT_TRUE(waitFor([&] { return result.first >= 0; }));
        return result;
    };
    Options options;
    options.screenshot = folder.filePath("out.png");
    options.address = client::Address{"127.0.0.1", 1};
    EXPECT_EQ(run(options).first, 4);
    auto started = Server::start(renderer);
    ASSERT_TRUE(started);
    options.address->port = (*started)->port();
    options.pixel = Pixel{1000, 1};
    const auto outside = run(options);
    EXPECT_EQ(outside.first, 3);
    EXPECT_TRUE(outside.second.contains("24 × 16")) << outside.second.toStdString();
    options.pixel = Pixel{1, 1};
    EXPECT_EQ(run(options).first, 0);
    EXPECT_EQ(QImage(options.screenshot).size(), QSize(1600, 900));
}

}  // namespace
}  // namespace emca::explorer
