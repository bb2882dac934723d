#include "program/unattended.h"

#include <QDir>
#include <QFileInfo>
#include <QMenuBar>
#include <QSaveFile>
#include <QStatusBar>
#include <QToolBar>
#include <algorithm>

#include "base/qt_compat.h"
#include "emca/analysis/format.h"
#include "image/image_canvas.h"
#include "image/image_view.h"
#include "base/path_ids.h"
#include "paths/filter_panel.h"
#include "paths/outlier_panel.h"
#include "paths/path_tree.h"
#include "paths/vertex_table.h"
#include "parallel/parallel_plot.h"
#include "plots/path_plot.h"
#include "program/tour_story.h"
#include "scene/scene_view.h"
#include "scene/surface_panel.h"
#include "window/file_menu.h"
#include "window/history_view.h"
#include "window/main_window.h"
#include "window/panel_dock.h"
#include "window/toast.h"

namespace emca::explorer {
namespace {

constexpr int kTickMilliseconds = 40;
constexpr int kPluginMilliseconds = 60000;   // a light probe of many samples takes its time
constexpr int kSettledTicks = 4;   // drawn things may start others: a flight of the camera, a late layout

int codeOf(FailedTask task) {
    switch (task) {
        case FailedTask::connect: return 4;
        case FailedTask::openImage: case FailedTask::saveImage:
        case FailedTask::openSession: case FailedTask::saveSession: return 3;
        case FailedTask::render: case FailedTask::trace: case FailedTask::scene:
        case FailedTask::surface: return 5;
    }
    return 5;
}

}  // namespace

Unattended::Unattended(Options options, client::Dataset& dataset, client::Selection& selection, SessionController& session,
                       MainWindow& window)
    : options_(std::move(options)), dataset_(dataset), selection_(selection), session_(session), window_(window) {
    timer_.setInterval(kTickMilliseconds);
    connect(&timer_, &QTimer::timeout, this, &Unattended::tick);
    connect(&session_, &SessionController::failed, this, [this](FailedTask task, const QString& sentence) {
        if (options_.unattended()) end(codeOf(task), sentence);
    });
}

void Unattended::start() {
    if (options_.samplesPerPixel) window_.setSamples(options_.samplesPerPixel);
    window_.views().surfaces->setWantedLayers(options_.scene.layers);
    if (options_.onlyScene) onlyScene();
    QStringList files{options_.session, options_.image};
    files.removeAll(QString());
    if (!files.isEmpty()) {
        window_.files().open(files);
        // Before connecting, so that no image is rendered where one is there.
        then([this] { if (options_.address) window_.connectTo(*options_.address); });
    } else if (options_.address) {
        window_.connectTo(*options_.address);
    }
    if (!options_.reference.isEmpty()) {
        then([this] { session_.openReference(options_.reference); });
        then([this] { showComparison(); });
    }
    const bool firefly = options_.firefly || !options_.tour.isEmpty();
    if (options_.region) then([this] { selectRegion(); });
    else if (options_.pixel || firefly) then([this] { selectPixel(); });
    if (options_.firefly) then([this] { selectSuspect(); });
    if (!options_.tour.isEmpty()) then([this] { tour(); });
    then([this] { applyScene(); });
    then([this] {
        for (const QString& name : options_.front) window_.showDock(name);
    });
    if (!options_.screenshot.isEmpty()) then([this] { screenshot(); });
    timer_.start();
}

void Unattended::showComparison() {
    ImageModel& model = window_.views().image->model();
    const std::string wanted = options_.compare.toStdString();
    if (wanted == "reference" || wanted == "split") {
        model.setMode(wanted == "split" ? ImageMode::split : ImageMode::reference);
    } else if (const auto metric = analysis::imageMetricByName(wanted)) {
        model.setMetric(*metric);
        model.setMode(ImageMode::difference);
    }
}

/// The window shrinks to its 3D view, so that the picture is laid out for its size.
void Unattended::onlyScene() {
    for (const auto& [name, dock] : window_.docks()) dock->setVisible(name == "scene");
    window_.menuBar()->hide();
    window_.statusBar()->hide();
    for (QToolBar* bar : window_.findChildren<QToolBar*>()) bar->hide();
}

void Unattended::applyScene() {
    const SceneWishes& wishes = options_.scene;
    SceneView& view = *window_.views().scene;
    SurfaceModel& model = view.surfaces();
    SurfaceStyle style = model.style();
    if (!wishes.showLayer.empty()) style.layer = wishes.showLayer == "none" ? std::string() : wishes.showLayer;
    if (!style.layer.empty() && (!model.surface() || !model.surface()->field->find(style.layer))) {
        const QString sentence = tr("The layer \"%1\" was not collected, so it cannot be shown.").arg(toQString(style.layer));
        if (options_.unattended()) end(5, sentence);
        else window_.toast().showError(sentence);
        return;
    }
    LayerStyle& layer = style.layers[style.layer];
    layer.log = layer.log || wishes.log;
    if (wishes.range) layer.limits = wishes.range;
    if (wishes.percentiles) {
        style.lower = wishes.percentiles->min / 100;
        style.upper = wishes.percentiles->max / 100;
    }
    style.map = wishes.map.value_or(style.map);
    style.exposure = wishes.exposure.value_or(style.exposure);
    style.opacity = wishes.opacity.value_or(style.opacity);
    model.setStyle(style);
    if (!wishes.layers.empty() && !options_.onlyScene) window_.showDock("surfaces");

    SceneOptions options = view.options();
    if (wishes.paths) {
        options.paths = *wishes.paths ? PathChoice::all : PathChoice::none;
        options.cameraGlyph = *wishes.paths;
    }
    if (wishes.opacity) options.surfaceOpacity = *wishes.opacity;
    view.setOptions(options);
    if (!wishes.eye && !wishes.target && !wishes.fieldOfView) return;
    ViewPose pose = view.pose();
    pose.verticalFieldOfView = wishes.fieldOfView.value_or(pose.verticalFieldOfView);
    view.setPose(wishes.eye || wishes.target ? lookingAt(pose, wishes.eye.value_or(pose.position), wishes.target.value_or(pose.focus)) : pose);
}

void Unattended::screenshot() {
    SceneView& view = *window_.views().scene;
    if (options_.onlyScene) {
        const auto saved = view.saveImage(options_.screenshot, options_.size.isValid() ? options_.size : view.size());
        if (!saved) end(3, toQString(saved.error().message));
    } else if (!window_.grab().save(options_.screenshot)) {
        end(3, tr("The picture could not be written to %1; check the folder and its ending.").arg(options_.screenshot));
    }
}

/// Plugins are waited for, too, but not for ever: one that never has enough must not keep a script.
bool Unattended::isSettled() {
    if (!window_.isSettled() || !window_.isPluginWorking()) {
        pluginTicks_ = 0;
        return window_.isSettled();
    }
    return ++pluginTicks_ * kTickMilliseconds > kPluginMilliseconds;
}

void Unattended::tick() {
    settledTicks_ = isSettled() ? settledTicks_ + 1 : 0;
    if (settledTicks_ < kSettledTicks || ended_) return;
    settledTicks_ = 0;
    if (steps_.empty()) {
        timer_.stop();
        if (options_.unattended()) end(0);
        return;
    }
    const auto step = std::move(steps_.front());
    steps_.pop_front();
    step();
}

void Unattended::end(int code, const QString& sentence) {
    if (ended_) return;
    ended_ = true;
    timer_.stop();
    steps_.clear();
    emit ended(code, sentence);
}

void Unattended::selectPixel() {
    // A session was saved with the pixel that matters.
    if (!options_.pixel && !options_.session.isEmpty() && !selection_.pixels().empty() && !dataset_.paths().empty()) return;
    std::optional<Pixel> pixel = options_.pixel;
    const client::ImageEntry* entry = dataset_.currentImage();
    if (!pixel && entry && entry->image)
        if (const auto striking = strikingPixel(entry->image->color)) pixel = striking->pixel;
    if (!pixel) {
        end(5, tr("There is no image to choose a pixel from; give one with --pixel X,Y."));
        return;
    }
    std::uint32_t width = 0, height = 0;
    if (entry && entry->image) {
        width = entry->image->color.width();
        height = entry->image->color.height();
    } else if (dataset_.info()) {
        width = dataset_.info()->width;
        height = dataset_.info()->height;
    }
    if (pixel->x >= width || pixel->y >= height) {
        const QString sentence = tr("The pixel %1 is outside the image of %2 × %3 pixels; (0, 0) is its top left.")
                                     .arg(toQString(analysis::formatPixel(*pixel))).arg(width).arg(height);
        if (options_.unattended()) end(3, sentence);
        else window_.toast().showError(sentence);
        return;
    }
    selection_.setPixel(*pixel);
}

void Unattended::selectRegion() {
    const PixelRect region = *options_.region;
    const client::ImageEntry* entry = dataset_.currentImage();
    const std::uint32_t width = entry && entry->image ? entry->image->color.width() : dataset_.info() ? dataset_.info()->width : 0;
    const std::uint32_t height = entry && entry->image ? entry->image->color.height() : dataset_.info() ? dataset_.info()->height : 0;
    if (region.x1 > width || region.y1 > height) {
        const QString sentence = tr("The region %1,%2,%3,%4 reaches beyond the image of %5 × %6 pixels.")
                                     .arg(region.x0).arg(region.y0).arg(region.x1).arg(region.y1).arg(width).arg(height);
        if (options_.unattended()) end(3, sentence);
        else window_.toast().showError(sentence);
        return;
    }
    selection_.setRegion(client::PixelRegion(region));
    window_.showDock("region");
}

void Unattended::save(QWidget* widget, const QString& file, const QString& caption) {
    if (!widget || ended_) return;
    if (widget->grab().save(QDir(options_.tour).filePath(file))) pictures_.push_back({file, caption});
    else end(3, tr("The picture could not be written to %1; check the folder.").arg(QDir(options_.tour).filePath(file)));
}

/// The strongest path alone and the vertex that made it so: all views follow.
void Unattended::selectSuspect() {
    const auto suspect = findSuspect(dataset_.paths());
    if (!suspect) return;
    selection_.setPaths({pathId(dataset_.paths(), suspect->path)});
    if (suspect->vertex) selection_.setVertex(vertexId(dataset_.paths(), *suspect->vertex));
}

void Unattended::tour() {
    if (!QDir().mkpath(options_.tour)) {
        end(3, tr("The folder %1 could not be made.").arg(options_.tour));
        return;
    }
    const auto suspect = findSuspect(dataset_.paths());
    if (!suspect) {
        end(5, tr("The renderer recorded no path with a final estimate for this pixel, so there is nothing to show."));
        return;
    }
    const Pixel pixel = dataset_.current().front()->pixels.front();
    selectSuspect();
    window_.showDock("outliers");
    then([this] { save(&window_, "01-window.png", tr("The whole window: image, plots, scene, path tree and the data of the vertex")); });
    then([this, pixel] { window_.views().image->canvas().focusOn(pixel); });
    then([this, pixel] {
        save(window_.views().image, "02-image.png", tr("The image around pixel %1").arg(toQString(analysis::formatPixel(pixel))));
        window_.views().image->canvas().fit();
    });
    then([this] { save(window_.views().scene, "03-scene.png", tr("The path in the scene, its vertex marked")); });
    int number = 4;
    const auto show = [&](const QString& dock, QWidget* widget, const QString& file, const QString& caption) {
        if (!widget) return;
        then([this, dock] { window_.showDock(dock); });
        then([this, widget, name = QStringLiteral("%1-%2.png").arg(number, 2, 10, QChar('0')).arg(file), caption] { save(widget, name, caption); });
        ++number;
    };
    Views& views = window_.views();
    for (const Views::Plot& plot : views.plots) show(plot.name, plot.widget, plot.name, tr("%1 of every path of the pixel; the selected path is orange").arg(plot.title == tr("RGB") ? tr("Red, green and blue") : plot.title));
    show("plots-parallel", views.parallel, "parallel-coordinates", tr("Parallel coordinates: an axis for each quantity, a line for each path; the selected path is orange"));
    show("paths", views.paths, "paths", tr("The path as a tree of values"));
    show("vertex", views.vertex, "intersection", tr("Everything that was recorded at the vertex"));
    show("outliers", views.outliers, "outliers", tr("Paths beyond mean + 3 σ"));
    then([this] {
        window_.views().filter->addRule({"luminance", {}, query::RuleOperator::greater, "20 * mean(luminance)"});
        window_.views().filter->addRule({"v.lobe", query::Quantifier::any, query::RuleOperator::equal, "glossy"});
    });
    show("filter", views.filter, "filter", tr("Rules and the query that they stand for"));
    show("history", views.history, "history", tr("The pixels that were traced"));
    if (PanelDock* data = window_.dock("plugin-intersection-data"))
        show(data->objectName(), data->widget(), "intersection-data", tr("What the renderer recorded along the path, over its depth"));
    then([this, pixel, suspect = *suspect] {
        std::vector<std::pair<QString, QString>> pictures;
        for (const Picture& picture : pictures_) pictures.emplace_back(picture.file, picture.caption);
        QSaveFile file(QDir(options_.tour).filePath("index.md"));
        const QByteArray story = tourStory(dataset_, pixel, suspect, pictures).toUtf8();
        if (!file.open(QIODevice::WriteOnly) || file.write(story) != story.size() || !file.commit())
            end(3, tr("The story could not be written to %1.").arg(file.fileName()));
    });
}

}  // namespace emca::explorer
