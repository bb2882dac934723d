// Sessions as a person handles them: keys, menu, file dialogs, drops, and the cards that ask and tell.
#include <gtest/gtest.h>

#include <QAction>
#include <QDropEvent>
#include <QFileDialog>
#include <QLabel>
#include <QLineEdit>
#include <QMenu>
#include <QMimeData>
#include <QPushButton>
#include <QUrl>

#include "base/state_overlay.h"
#include "emca/client/session.h"
#include "emca/imageio/imageio.h"
#include "image/image_canvas.h"
#include "image/image_model.h"
#include "image/image_view.h"
#include "program/unattended.h"
#include "scene/scene_view.h"
#include "session_for_tests.h"
#include "testing/program.h"
#include "window/file_menu.h"
#include "window/notice_card.h"
#include "window/panel_dock.h"
#include "window/toast.h"

namespace emca::explorer {
namespace {

class SessionFilesTest : public MainWindowTest {
  protected:
    QString path(const QString& name) const { return folder.filePath(name); }
    static void clickPixel(Program& program, Pixel pixel) {
        ImageCanvas& canvas = program.window->views().image->canvas();
        QTest::mouseClick(&canvas, Qt::LeftButton, {}, canvas.transform().rectOf(pixel).center().toPoint());
    }
    static bool shows(Program& program, Pixel pixel) {
        return waitFor([&] { return program.window->isSettled() && !program.dataset.paths().empty() && program.dataset.paths().pixel(0) == pixel; });
    }
    /// Connected, with two traced pixels, a path and a vertex selected.
    void work(Program& program) {
        connectTo(program);
        for (const Pixel pixel : {Pixel{3, 2}, Pixel{7, 5}}) {
            clickPixel(program, pixel);
            ASSERT_TRUE(shows(program, pixel));
        }
        QTest::keyClick(program.window.get(), Qt::Key_BracketRight);
        QTest::keyClick(program.window.get(), Qt::Key_Period);
        ASSERT_TRUE(program.selection.state().vertex);
    }
    /// Chooses a file in the dialog that a key has opened.
    static void choose(Program& program, const QString& file) {
        QFileDialog* dialog = nullptr;
        ASSERT_TRUE(waitFor([&] {
            dialog = program.window->findChild<QFileDialog*>();
            return dialog && dialog->isVisible();
        }));
        dialog->selectFile(file);
        dialog->findChild<QLineEdit*>("fileNameEdit")->setText(file);
        QTest::keyClick(dialog->findChild<QLineEdit*>("fileNameEdit"), Qt::Key_Return);
        ASSERT_TRUE(waitFor([&] { return !program.window->findChild<QFileDialog*>(); }));
        QApplication::setActiveWindow(program.window.get());
    }
    static void pressSave(Program& program) { QTest::keyClick(program.window.get(), Qt::Key_S, Qt::ControlModifier); }
    void save(Program& program, const QString& file) {
        pressSave(program);
        choose(program, file);
        ASSERT_TRUE(waitFor([&] { return program.window->files().document().file() == file && program.window->isSettled(); }));
    }
    static void drop(Program& program, const QStringList& files) {
        QMimeData data;
        QList<QUrl> urls;
        for (const QString& file : files) urls << QUrl::fromLocalFile(file);
        data.setUrls(urls);
        QDragEnterEvent enter(QPoint(200, 200), Qt::CopyAction, &data, Qt::LeftButton, Qt::NoModifier);
        QApplication::sendEvent(program.window.get(), &enter);
        ASSERT_TRUE(enter.isAccepted());
        QDropEvent dropped(QPointF(200, 200), Qt::CopyAction, &data, Qt::LeftButton, Qt::NoModifier);
        QApplication::sendEvent(program.window.get(), &dropped);
    }
    static bool opened(Program& program, const QString& file) {
        return waitFor([&] { return program.window->files().document().file() == file && program.window->isSettled(); });
    }
    static client::Session now(Program& program) { return client::sessionOf(program.dataset, program.selection); }
    static void press(Program& program, const QString& answer) {
        for (QPushButton* button : program.window->files().card().findChildren<QPushButton*>())
            if (button->isVisible() && button->text() == answer) return QTest::mouseClick(button, Qt::LeftButton);
        ADD_FAILURE() << "no answer " << answer.toStdString();
    }
    static QString card(Program& program) { return program.window->files().card().text(); }
    /// A session of two pixels, made in a window of its own.
    QString savedSession(const QString& name = "saved.emca") {
        Program program(path("other.ini"));
        work(program);
        save(program, path(name));
        return path(name);
    }
};

TEST_F(SessionFilesTest, WhatIsSavedOpensWithoutARendererAndIsTheSame) {
    const QString file = path("work.emca");
    client::Session before;
    {
        Program program(settingsFile());
        EXPECT_FALSE(program.window->action("saveSession")->isEnabled());
        work(program);
        EXPECT_TRUE(program.window->isWindowModified());
        save(program, file);
        EXPECT_FALSE(program.window->isWindowModified());
        EXPECT_TRUE(program.window->windowTitle().startsWith("work.emca")) << program.window->windowTitle().toStdString();
        EXPECT_TRUE(program.window->toast().sentence().contains("Saved work.emca"));
        before = now(program);
    }
    server.reset();
    Program program(path("fresh.ini"));
    QTest::keyClick(program.window.get(), Qt::Key_O, Qt::ControlModifier);
    choose(program, file);
    ASSERT_TRUE(opened(program, file));
    EXPECT_EQ(client::test::difference(now(program), before), "");
    EXPECT_EQ(program.session.link(), LinkState::offline);
    EXPECT_TRUE(program.window->toast().sentence().isEmpty()) << program.window->toast().sentence().toStdString();
    EXPECT_TRUE(card(program).isEmpty());
    EXPECT_FALSE(program.window->isWindowModified());
    EXPECT_EQ(program.window->findChild<QLabel*>("verdict")->text(), "replay exact");

    clickPixel(program, {3, 2});
    ASSERT_TRUE(shows(program, {3, 2}));
    EXPECT_TRUE(program.window->toast().sentence().isEmpty());
    clickPixel(program, {9, 9});
    EXPECT_TRUE(program.window->toast().sentence().contains("no renderer is connected")) << program.window->toast().sentence().toStdString();
    EXPECT_EQ(program.dataset.traces().size(), 2u);
}

TEST_F(SessionFilesTest, ADroppedSessionOpensAndImagesComeAlong) {
    const QString file = savedSession(), image = path("dropped.pfm");
    ASSERT_TRUE(imageio::write(image.toStdString(), Image(12, 9)));
    // What a file is, its content says.
    ASSERT_TRUE(QFile::copy(file, path("renamed.bin")));
    Program program(settingsFile());
    drop(program, {image, path("renamed.bin")});
    ASSERT_TRUE(opened(program, path("renamed.bin")));
    ASSERT_TRUE(waitFor([&] { return program.dataset.images().size() == 2; }));
    EXPECT_EQ(program.dataset.traces().size(), 2u);
}

TEST_F(SessionFilesTest, ACutFileOpensInPartSaysSoAndIsNotWrittenOver) {
    const QString file = savedSession();
    auto bytes = client::test::contents(file.toStdString());
    bytes.resize(bytes.size() * 6 / 10);
    client::test::put(path("cut.emca").toStdString(), bytes);
    Program program(settingsFile());
    drop(program, {path("cut.emca")});
    ASSERT_TRUE(opened(program, path("cut.emca")));
    EXPECT_TRUE(card(program).startsWith("cut.emca is not whole")) << card(program).toStdString();
    EXPECT_GT(card(program).count('\n'), 1);
    EXPECT_TRUE(program.dataset.currentImage());
    EXPECT_TRUE(program.window->windowTitle().contains("in part"));
    const auto overlays = program.window->views().scene->findChildren<StateOverlay*>();
    EXPECT_TRUE(std::any_of(overlays.begin(), overlays.end(), [](const StateOverlay* overlay) {
        return overlay->isVisible() && overlay->sentence().contains("Connect to the renderer");
    })) << "no scene is on its way";
    pressSave(program);   // asks for a name
    QFileDialog* dialog = nullptr;
    ASSERT_TRUE(waitFor([&] { return (dialog = program.window->findChild<QFileDialog*>()) != nullptr; }));
    EXPECT_TRUE(dialog->selectedFiles().front().endsWith("cut (rescued).emca")) << dialog->selectedFiles().front().toStdString();
    choose(program, path("rescued.emca"));
    ASSERT_TRUE(opened(program, path("rescued.emca")));
    EXPECT_EQ(client::test::contents(path("cut.emca").toStdString()), bytes);
    EXPECT_TRUE(client::openSession(path("rescued.emca").toStdString())->whole);
}

TEST_F(SessionFilesTest, AForeignFileIsASentenceAndNothingIsLost) {
    client::test::put(path("foreign.emca").toStdString(), std::vector<std::byte>(5000, std::byte{42}));
    Program program(settingsFile());
    work(program);
    save(program, path("mine.emca"));
    const client::Session before = now(program);
    drop(program, {path("foreign.emca")});
    ASSERT_TRUE(waitFor([&] { return program.window->toast().sentence().contains("foreign.emca"); }));
    EXPECT_EQ(client::test::difference(now(program), before), "");
    EXPECT_EQ(program.window->files().document().file(), path("mine.emca"));
    EXPECT_EQ(program.session.link(), LinkState::connected);
    clickPixel(program, {1, 1});
    EXPECT_TRUE(shows(program, {1, 1})) << "still usable";
}

TEST_F(SessionFilesTest, RecentFilesAreRememberedAndMissingOnesForgotten) {
    const QString first = savedSession("first.emca"), image = path("picture.pfm");
    ASSERT_TRUE(QFile::copy(first, path("second.emca")));
    ASSERT_TRUE(imageio::write(image.toStdString(), Image(24, 16)));
    {
        Program program(settingsFile());
        EXPECT_FALSE(program.window->findChild<QMenu*>("recentFiles")->isEnabled());
        for (const QString& file : {first, path("second.emca")}) {
            drop(program, {file});
            ASSERT_TRUE(opened(program, file));
        }
        drop(program, {image});
        ASSERT_TRUE(waitFor([&] { return program.dataset.images().size() == 2; }));
    }
    Program program(settingsFile());
    const auto entries = [&] {
        QStringList files;
        for (const QAction* entry : program.window->findChild<QMenu*>("recentFiles")->actions())
            if (entry->data().isValid()) files << entry->data().toString();
        return files;
    };
    EXPECT_EQ(entries(), (QStringList{image, path("second.emca"), first}));
    program.window->findChild<QMenu*>("recentFiles")->actions()[2]->trigger();
    ASSERT_TRUE(opened(program, first));
    EXPECT_EQ(entries(), (QStringList{first, image, path("second.emca")}));
    QFile::remove(path("second.emca"));
    program.window->findChild<QMenu*>("recentFiles")->actions()[2]->trigger();
    ASSERT_TRUE(waitFor([&] { return program.window->toast().sentence().contains("second.emca"); }));
    EXPECT_EQ(entries(), (QStringList{first, image}));
    EXPECT_EQ(program.window->files().document().file(), first);
}

TEST_F(SessionFilesTest, ClosingAsksForUnsavedPixelsAndKeepsTheWindowMeanwhile) {
    Program program(settingsFile());
    connectTo(program);
    EXPECT_FALSE(program.window->isWindowModified()) << "nobody asked for the first image";
    clickPixel(program, {3, 2});
    ASSERT_TRUE(shows(program, {3, 2}));
    program.window->close();
    EXPECT_TRUE(program.window->isVisible());
    EXPECT_TRUE(card(program).contains("1 traced pixel is in no file yet")) << card(program).toStdString();
    QTest::keyClick(QApplication::focusWidget(), Qt::Key_Escape);
    EXPECT_TRUE(card(program).isEmpty());
    EXPECT_TRUE(program.selection.state().pixel) << "Esc answered the question and nothing else";
    save(program, path("a.emca"));
    clickPixel(program, {7, 5});
    ASSERT_TRUE(shows(program, {7, 5}));
    program.window->close();
    EXPECT_TRUE(card(program).contains("1 traced pixel is not in the file yet")) << card(program).toStdString();
    QTest::keyClick(QApplication::focusWidget(), Qt::Key_Return);   // Save
    ASSERT_TRUE(waitFor([&] { return !program.window->isVisible(); }));
    EXPECT_EQ(client::openSession(path("a.emca").toStdString())->session.traces.size(), 2u);
}

TEST_F(SessionFilesTest, ClosingWithoutSavingAndClosingWithASaveThatFails) {
    Program program(settingsFile());
    work(program);
    program.window->close();
    press(program, "Save as…");
    choose(program, "/proc/nowhere.emca");
    ASSERT_TRUE(waitFor([&] { return program.window->toast().sentence().contains("nowhere.emca"); }));
    EXPECT_TRUE(program.window->isVisible()) << "what is not saved is still here";
    EXPECT_TRUE(program.window->isWindowModified());
    program.window->close();
    press(program, "Close without saving");
    ASSERT_TRUE(waitFor([&] { return !program.window->isVisible(); }));
}

TEST_F(SessionFilesTest, OpeningAsksBeforeUnsavedPixelsGo) {
    const QString file = savedSession();
    Program program(settingsFile());
    connectTo(program);
    clickPixel(program, {1, 1});
    ASSERT_TRUE(shows(program, {1, 1}));
    drop(program, {file});
    EXPECT_TRUE(card(program).contains("Save before opening saved.emca?")) << card(program).toStdString();
    press(program, "Cancel");
    EXPECT_EQ(program.dataset.paths().pixel(0), (Pixel{1, 1}));
    drop(program, {file});
    press(program, "Open without saving");
    ASSERT_TRUE(opened(program, file));
    EXPECT_EQ(program.dataset.paths().pixel(0), (Pixel{7, 5}));
    EXPECT_EQ(program.session.link(), LinkState::connected) << "the renderer shows the same scene";
    clickPixel(program, {9, 9});
    ASSERT_TRUE(shows(program, {9, 9}));
    EXPECT_EQ(program.window->findChild<QLabel*>("verdict")->text(), "replay exact");
}

TEST_F(SessionFilesTest, ARendererOfAnotherSceneGoesAndDoesNotTakeTheFile) {
    const QString file = savedSession();
    renderer.scene = "another";
    Program program(settingsFile());
    connectTo(program);
    drop(program, {file});
    ASSERT_TRUE(opened(program, file));
    EXPECT_EQ(program.session.link(), LinkState::offline);
    EXPECT_EQ(program.dataset.info()->scene, "fake");
    program.window->connectTo({"127.0.0.1", server->port()});
    ASSERT_TRUE(waitFor([&] { return program.session.link() == LinkState::connected && program.window->isSettled(); }));
    EXPECT_TRUE(program.dataset.traces().empty());
    EXPECT_TRUE(program.window->files().document().target().isEmpty()) << "Ctrl+S would write over the traces of the other scene";
}

TEST_F(SessionFilesTest, APreviewThatWasSavedIsAnImageWhenItIsOpened) {
    const QString file = path("preview.emca");
    {
        Program program(path("other.ini"));
        connectTo(program);
        renderer.rowMilliseconds = 100;
        program.window->render();
        ASSERT_TRUE(waitFor([&] { return program.session.renderFraction() > 0; }));
        pressSave(program);
        choose(program, file);
        ASSERT_TRUE(waitFor([&] { return program.window->files().document().file() == file; }));
        EXPECT_TRUE(program.session.isRendering()) << "saving waits for nothing";
        program.session.cancelRender();
    }
    Program program(settingsFile());
    drop(program, {file});
    ASSERT_TRUE(opened(program, file));
    EXPECT_FALSE(program.dataset.currentImage()->preview);
    EXPECT_EQ(program.dataset.currentImage()->title, "Render 2, incomplete");
}

TEST_F(SessionFilesTest, NotesOutliveOpeningAndSaving) {
    client::Session session = client::test::sampleSession();
    ASSERT_TRUE(client::saveSession(path("notes.emca").toStdString(), session));
    Program program(settingsFile());
    drop(program, {path("notes.emca")});
    ASSERT_TRUE(opened(program, path("notes.emca")));
    EXPECT_TRUE(card(program).contains("The caustic under the glass is too bright."));
    for (client::ImageEntry& entry : session.images)
        if (entry.preview) {
            entry.preview = false;
            entry.title += ", incomplete";
        }
    std::erase_if(session.pixelNotes, [](const client::PixelNote& note) { return note.text.empty(); });  // no note
    pressSave(program);
    ASSERT_TRUE(waitFor([&] { return program.window->toast().sentence().startsWith("Saved"); }));
    const auto again = client::openSession(path("notes.emca").toStdString());
    ASSERT_TRUE(again);
    ASSERT_TRUE(again->session.view);
    EXPECT_EQ(again->session.view->reference, session.view->reference);
    EXPECT_EQ(again->session.view->paths, session.view->paths);
    EXPECT_EQ(again->session.view->vertices, session.view->vertices);
    for (const auto& option : {client::SavedView::Option{"image/mode", "split"}, {"scene/clipAxis", "2"}})
        EXPECT_NE(std::ranges::find(again->session.view->options, option), again->session.view->options.end()) << option.name;
    session.view = again->session.view;
    EXPECT_EQ(client::test::difference(again->session, session), "");
}

/// What was compared with what, and what the 3D view drew; then the same in another window.
TEST_F(SessionFilesTest, TheViewIsAsItWasLeft) {
    const QString file = path("view.emca");
    SceneOptions left;
    RaySwitches rays;
    {
        Program program(settingsFile());
        work(program);
        program.window->action("render")->trigger();
        ASSERT_TRUE(waitFor([&] { return program.dataset.images().size() == 2 && program.window->isSettled(); }));
        ImageModel& model = program.window->views().image->model();
        model.setReference(program.dataset.images()[0].image);
        model.setMetric(analysis::ImageMetric::relativeSquaredError);
        model.setMode(ImageMode::difference);
        SceneView& scene = *program.window->views().scene;
        left = scene.options();
        left.orthographic = true;
        left.clip.axis = ClipAxis::y;
        left.clip.flip = true;
        left.colors.quantity = "luminance";
        left.lightGlyphs = false;
        left.surfaceOpacity = 0.35f;
        left.animate = false;
        scene.setOptions(left);
        rays.set(*scene.currentPathId(), PathRays{true, false});
        rays.set(*scene.currentVertexId(), VertexRays{false, true, true});
        scene.setRaySwitches(rays);
        save(program, file);
    }
    server.reset();
    Program program(path("fresh.ini"));
    drop(program, {file});
    ASSERT_TRUE(opened(program, file));
    const ImageModel& model = program.window->views().image->model();
    ASSERT_EQ(program.dataset.images().size(), 2u);
    EXPECT_EQ(model.reference(), program.dataset.images()[0].image);
    EXPECT_EQ(model.display().mode, ImageMode::difference);
    EXPECT_EQ(model.display().metric, analysis::ImageMetric::relativeSquaredError);
    const SceneView& scene = *program.window->views().scene;
    SceneOptions expected = left;
    expected.animate = scene.options().animate;   // a habit of the other person
    EXPECT_TRUE(scene.options().animate);
    EXPECT_EQ(scene.options(), expected);
    EXPECT_EQ(scene.raySwitches(), rays);
    // Numbers that no version has.
    client::Session session = client::openSession(file.toStdString())->session;
    for (auto& option : session.view->options)
        if (option.name != "image/metric") option.value = "99999";
    ASSERT_TRUE(client::saveSession(path("strange.emca").toStdString(), session));
    drop(program, {path("strange.emca")});
    ASSERT_TRUE(opened(program, path("strange.emca")));
    EXPECT_EQ(scene.options().clip.axis, left.clip.axis);
    EXPECT_EQ(scene.options().colors.map, left.colors.map);
}

TEST_F(SessionFilesTest, TheCommandLineOpensASessionForAPictureAndForTheTour) {
    const QString file = savedSession();
    server.reset();
    const auto run = [&](Options options) {
        Program program(settingsFile());
        Unattended steps(options, program.dataset, program.selection, program.session, *program.window);
        int code = -1;
        QString said;
        QObject::connect(&steps, &Unattended::ended, [&](int ended, const QString& sentence) { code = ended, said = sentence; });
        steps.start();
        EXPECT_TRUE(waitFor([&] { return code >= 0; }, 60000));
        return std::pair(code, said);
    };
    Options options;
    options.session = file;
    options.screenshot = path("a.png");
    EXPECT_EQ(run(options), std::pair(0, QString()));
    EXPECT_FALSE(QImage(options.screenshot).isNull());
    options.screenshot.clear();
    options.tour = path("tour");
    EXPECT_EQ(run(options), std::pair(0, QString()));
    EXPECT_TRUE(QFile::exists(path("tour/index.md")));
    client::test::put(path("foreign.emca").toStdString(), std::vector<std::byte>(100, std::byte{1}));
    options.session = path("foreign.emca");
    EXPECT_EQ(run(options).first, 3);
}

}  // namespace
}  // namespace emca::explorer
