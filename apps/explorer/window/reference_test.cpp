// Comparing images in the real window: files dropped, keys, files that are no image.
#include <QAction>
#include <QApplication>
#include <QDragEnterEvent>
#include <QMimeData>
#include <QFile>
#include <QUrl>

#include "emca/imageio/imageio.h"
#include "image/image_canvas.h"
#include "image/image_view.h"
#include "testing/program.h"
#include "window/history_view.h"
#include "window/toast.h"

namespace emca::explorer {
namespace {

class ReferenceWindowTest : public MainWindowTest {
  protected:
    /// \param share  where over the picture, from its left to its right
    static void drop(ImageView& view, double share, const QString& file) {
        QMimeData data;
        data.setUrls({QUrl::fromLocalFile(file)});
        const QPoint at = view.canvas().mapTo(&view, QPoint(static_cast<int>(share * view.canvas().width()), 40));
        QDragEnterEvent enter(at, Qt::CopyAction, &data, Qt::LeftButton, Qt::NoModifier);
        QCoreApplication::sendEvent(&view, &enter);
        ASSERT_TRUE(enter.isAccepted());
        QDropEvent released(at, Qt::CopyAction, &data, Qt::LeftButton, Qt::NoModifier);
        QCoreApplication::sendEvent(&view, &released);
    }
};

TEST_F(ReferenceWindowTest, AFileDroppedAtTheRightIsComparedByKeys) {
    Program program(settingsFile());
    connectTo(program);
    MainWindow& window = *program.window;
    ImageView& view = *window.views().image;
    const auto rendered = program.dataset.currentImage()->image;
    const QString file = folder.filePath("reference.exr");
    ASSERT_TRUE(imageio::write(file.toStdString(), Image(rendered->color.width(), rendered->color.height())));
    drop(view, 0.8, file);
    ASSERT_TRUE(waitFor([&] { return view.model().reference() != nullptr; }));
    EXPECT_EQ(view.model().referenceTitle(), "reference.exr");
    EXPECT_EQ(program.dataset.currentImage()->image, rendered);
    // No key is taken twice, and in the scene these keys fly.
    const auto key = [&](QWidget& focus, Qt::Key k) {
        window.activateWindow();
        focus.setFocus();
        QTest::keyClick(&focus, k);
    };
    const auto mode = [&] { return view.model().display().mode; };
    key(view.canvas(), Qt::Key_X);
    EXPECT_EQ(mode(), ImageMode::reference);
    key(view.canvas(), Qt::Key_D);
    EXPECT_EQ(mode(), ImageMode::difference);
    key(view.canvas(), Qt::Key_D);
    EXPECT_EQ(mode(), ImageMode::image);
    for (const Qt::Key k : {Qt::Key_X, Qt::Key_D, Qt::Key_W}) key(*window.views().history, k);
    EXPECT_EQ(mode(), ImageMode::image);
    for (QWidget* focus : {static_cast<QWidget*>(window.views().history), static_cast<QWidget*>(&view.canvas())}) {
        key(*focus, Qt::Key_C);
        EXPECT_TRUE(view.model().display().style().falseColor);
        key(*focus, Qt::Key_C);
        EXPECT_FALSE(view.model().display().style().falseColor);
    }
    for (const char* name : {"flipReference", "difference", "splitReference", "openReference", "saveShown", "falseColor", "nextInvalid"})
        EXPECT_TRUE(window.action(name)) << name << " is in a menu";
}

TEST_F(ReferenceWindowTest, AReferenceThatIsNoImageIsASentenceAndTheImageStays) {
    Program program(settingsFile());
    connectTo(program);
    ImageView& view = *program.window->views().image;
    QFile file(folder.filePath("broken.exr"));
    ASSERT_TRUE(file.open(QIODevice::WriteOnly));
    file.write("no image at all");
    file.close();
    drop(view, 0.9, file.fileName());
    ASSERT_TRUE(waitFor([&] { return program.window->toast().isVisible(); }));
    EXPECT_FALSE(view.model().reference());
    EXPECT_EQ(program.dataset.images().size(), 1u);
}

}  // namespace
}  // namespace emca::explorer
