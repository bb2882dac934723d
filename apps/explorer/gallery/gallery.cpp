// The pictures of docs/explorer/: every view of the real window in a state that shows what it is for.
//   explorer_gallery HOST:PORT OUT_DIR X,Y [PLUGIN]…    the pixel is one with a firefly; run it under Xvfb
#include <QAction>
#include <QDir>
#include <QPushButton>
#include <QTemporaryDir>
#include <cstdio>
#include <functional>

#include "base/path_ids.h"
#include "base/qt_compat.h"
#include "image/image_canvas.h"
#include "image/image_view.h"
#include "image/region_panel.h"
#include "parallel/parallel_plot.h"
#include "paths/filter_panel.h"
#include "paths/outlier_panel.h"
#include "paths/path_tree.h"
#include "plots/path_plot.h"
#include "plugin/plugin_guard.h"
#include "program/options.h"
#include "program/tour_story.h"
#include "scene/scene_view.h"
#include "scene/surface_panel.h"
#include "testing/wait.h"
#include "window/history_view.h"
#include "window/main_window.h"
#include "window/notes_panel.h"
#include "window/panel_dock.h"
#include "window/shortcut_panel.h"
#include "window/window_plugins.h"

using namespace emca;
using namespace emca::explorer;

namespace {

class Gallery {
  public:
    Gallery(MainWindow& window, client::Dataset& dataset, client::Selection& selection, QString folder)
        : window_(window), views_(window.views()), dataset_(dataset), selection_(selection), folder_(std::move(folder)) {}

    bool settle() {
        if (!waitFor([&] { return window_.isSettled(); }, 120000)) return false;
        QTest::qWait(700);  // flights of the camera, late layouts
        return waitFor([&] { return window_.isSettled(); }, 120000);
    }
    void save(const QString& name, QWidget* widget) {
        settle();
        const QString file = QDir(folder_).filePath(name + ".png");
        if (widget != nullptr && widget->isVisible() && widget->grab().save(file)) return void(std::puts(qUtf8Printable(file)));
        std::fprintf(stderr, "explorer_gallery: %s could not be made.\n", qUtf8Printable(file));
        failed_ = true;
    }
    void dock(const QString& name, const QString& picture = {}) {
        window_.showDock(name);
        save(picture.isEmpty() ? name : picture, window_.dock(name));
    }
    /// A view as large as a page shows it: beside the others it would be small.
    void alone(const QString& name, const QString& picture, QSize size) {
        PanelDock* dock = window_.dock(name);
        if (dock == nullptr) return save(picture, nullptr);
        window_.showDock(name);
        dock->setFloating(true);
        dock->resize(size);
        save(picture, dock);
        dock->setFloating(false);
        settle();
    }
    void selectSuspect() {
        const auto suspect = findSuspect(dataset_.paths());
        if (!suspect) return;
        selection_.setPaths({pathId(dataset_.paths(), suspect->path)});
        if (suspect->vertex) selection_.setVertex(vertexId(dataset_.paths(), *suspect->vertex));
        settle();
    }
    bool failed() const { return failed_; }

    void compare(Pixel pixel);
    void paths(Pixel pixel);
    void scene();
    void plugins();
    void regions(Pixel pixel);
    void habits(Pixel pixel);

  private:
    PanelDock* pluginDock(const QString& title) {
        for (const auto& [name, dock] : window_.docks())
            if (dock->windowTitle().compare(title, Qt::CaseInsensitive) == 0) {
                window_.showDock(name);
                return dock;
            }
        return nullptr;
    }

    MainWindow& window_;
    Views& views_;
    client::Dataset& dataset_;
    client::Selection& selection_;
    QString folder_;
    bool failed_ = false;
};

/// Two renders of one scene, one with few samples.
void Gallery::compare(Pixel pixel) {
    const auto many = dataset_.currentImage()->image;
    window_.setSamples(8);
    window_.render();
    settle();
    ImageModel& model = views_.image->model();
    model.setReference(many);
    model.setMode(ImageMode::split);
    views_.image->canvas().fit();
    save("image-split", views_.image);
    model.setMetric(analysis::ImageMetric::ldrFlip);
    model.setMode(ImageMode::difference);
    save("image-difference", views_.image);
    model.setMode(ImageMode::reference);
    views_.image->canvas().focusOn(pixel);
    model.setMode(ImageMode::image);
    model.setReference(nullptr);
    const auto& images = dataset_.images();
    for (std::size_t i = 0; i < images.size(); ++i)
        if (images[i].image == many) dataset_.setCurrentImage(i);
    views_.image->canvas().focusOn(pixel);
    save("image", views_.image);
    views_.image->canvas().fit();
}

void Gallery::paths(Pixel pixel) {
    selection_.setPixel(pixel);
    settle();
    selectSuspect();
    for (const Views::Plot& plot : views_.plots) dock(plot.name);
    dock("outliers");
    dock("paths");
    dock("vertex");
    alone("plots-parallel", "parallel-coordinates", {1280, 560});
    views_.filter->addRule({"luminance", {}, query::RuleOperator::greater, "20 * mean(luminance)"});
    views_.filter->addRule({"v.lobe", query::Quantifier::any, query::RuleOperator::equal, "glossy"});
    dock("filter");
    views_.filter->clear();
    settle();
}

void Gallery::scene() {
    selectSuspect();
    save("scene", views_.scene);
    SceneOptions options = views_.scene->options();
    const SceneOptions before = options;
    selection_.clearVertex();
    selection_.setPaths({});
    options.colors = {"luminance", analysis::ColorMapId::turbo, true, {}};
    options.nextEvents = NextEventChoice::none;
    views_.scene->setOptions(options);
    save("scene-values", views_.scene);
    views_.scene->setOptions(before);
    selectSuspect();
}

void Gallery::plugins() {
    selectSuspect();
    if (const PanelDock* data = pluginDock("Intersection data")) alone(data->objectName(), "intersection-data", {900, 520});
    else save("intersection-data", nullptr);
    if (QWidget* probe = pluginDock("Light probe")) {
        for (QPushButton* button : probe->findChildren<QPushButton*>())
            if (button->text().contains("Render") && button->isEnabled()) button->click();
        QTest::qWait(4000);
        save("light-probe", probe);
    } else {
        save("light-probe", nullptr);
    }
    dock("plugins");
}

void Gallery::regions(Pixel pixel) {
    selection_.setRegion(client::PixelRegion(PixelRect{pixel.x - 4, pixel.y - 4, pixel.x + 4, pixel.y + 4}));
    window_.showDock("region");
    views_.image->canvas().focusOn(pixel);
    save("regions", &window_);
    selection_.setPixel(pixel);
    views_.image->canvas().fit();
    settle();
}

void Gallery::habits(Pixel pixel) {
    selectSuspect();
    if (QAction* keys = window_.action("keys")) {
        keys->trigger();
        save("keys", &window_);
        window_.shortcuts().hide();
    }
    (void)pixel;
}

}  // namespace

int main(int argc, char** argv) {
    if (argc < 4) {
        std::fputs("explorer_gallery HOST:PORT OUT_DIR X,Y [PLUGIN]…\n", stderr);
        return 2;
    }
    const auto options = parseOptions({QString::fromLocal8Bit(argv[1]), "--pixel", argv[3]});
    if (!options || !options->address || !options->pixel) {
        std::fputs("explorer_gallery: give HOST:PORT and a pixel like 12,34.\n", stderr);
        return 2;
    }
    prepareOpenGl();
    QCoreApplication::setOrganizationName("emca");
    QCoreApplication::setApplicationName("emca-explorer");
    GuardedApplication application(argc, argv);
    QTemporaryDir fresh;
    QSettings settings(fresh.filePath("settings.ini"), QSettings::IniFormat);
    Theme theme;
    theme.applyTo(application);
    client::Dataset dataset;
    client::Selection selection;
    SessionController session(dataset, selection);
    MainWindow window(dataset, selection, session, theme, settings);
    PluginManager::Options pluginOptions = PluginManager::Options::standard();
    for (int i = 4; i < argc; ++i) pluginOptions.files += QString::fromLocal8Bit(argv[i]);
    WindowPlugins plugins(window, dataset, selection, session, theme, settings, std::move(pluginOptions));
    plugins.start();
    window.resize(1920, 1080);
    window.show();
    QDir().mkpath(argv[2]);

    Gallery gallery(window, dataset, selection, QString::fromLocal8Bit(argv[2]));
    window.connectTo(*options->address);
    if (!waitFor([&] { return session.link() == LinkState::connected && dataset.currentImage(); }, 120000) || !gallery.settle()) {
        std::fputs("explorer_gallery: nothing to show came from the renderer.\n", stderr);
        return 4;
    }
    gallery.paths(*options->pixel);
    gallery.scene();
    gallery.plugins();
    gallery.regions(*options->pixel);
    gallery.habits(*options->pixel);
    gallery.compare(*options->pixel);
    plugins.manager().end();
    return gallery.failed() ? 1 : 0;
}
