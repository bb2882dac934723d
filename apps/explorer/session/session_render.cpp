// Renders, previews and image files of SessionController.
#include <QFileInfo>
#include <algorithm>

#include "base/qt_compat.h"
#include "emca/analysis/format.h"
#include "emca/imageio/imageio.h"
#include "session/session_controller.h"

namespace emca::explorer {
namespace {

client::ImageEntry entryOf(client::Render render, int number) {
    client::ImageEntry entry;
    entry.title = "Render " + std::to_string(number) + ", " + std::to_string(render.samplesPerPixel) + " spp";
    entry.renderId = render.id;
    entry.samplesPerPixel = render.samplesPerPixel;
    entry.seed = render.seed;
    entry.integrator = std::move(render.integrator);
    entry.sampler = std::move(render.sampler);
    entry.image = std::make_shared<const RenderedImage>(std::move(render.image));
    return entry;
}

}  // namespace

std::optional<std::size_t> SessionController::indexOf(const std::shared_ptr<const RenderedImage>& image) const {
    for (std::size_t i = 0; i < dataset_.images().size(); ++i)
        if (dataset_.images()[i].image == image) return i;
    return std::nullopt;
}

/// "all" becomes names. Nothing, and a sentence to the person, if the renderer has none of them.
std::optional<client::RenderOptions> SessionController::withNamedLayers(client::RenderOptions options) {
    if (options.layers.empty()) return options;
    const std::vector<LayerDescription>& offered = dataset_.info()->layers;
    if (offered.empty()) {
        emit failed(FailedTask::render, tr("Nothing was rendered: layers on surfaces were asked for, but %1 offers none. Render without "
                                           "them, or with a renderer that collects data on surfaces.")
                                            .arg(toQString(dataset_.info()->renderer)));
        return std::nullopt;
    }
    const bool literal = std::ranges::any_of(offered, [](const LayerDescription& l) { return l.name == "all"; });
    if (options.layers != std::vector<std::string>{"all"} || literal) return options;
    options.layers.clear();
    for (const LayerDescription& layer : offered) options.layers.push_back(layer.name);
    return options;
}

void SessionController::render(const client::RenderOptions& wanted) {
    renderOptions_ = wanted;
    if (!connection_ || !dataset_.info()) {
        emit failed(FailedTask::render, tr("Nothing was rendered: no renderer is connected. Connect to one first."));
        return;
    }
    const auto options = withNamedLayers(wanted);
    if (!options) return;
    cancelRender();
    rendersUnasked_ = false;
    auto activity = std::make_shared<Activity>();
    render_ = activity;
    const client::ServerInfo& info = *dataset_.info();
    preview_ = std::make_shared<RenderedImage>();
    preview_->color = Image(info.width, info.height);
    client::ImageEntry entry;
    entry.title = "Render " + std::to_string(++renderCount_) + ", rendering";
    entry.samplesPerPixel = options->samplesPerPixel ? options->samplesPerPixel : info.samplesPerPixel;
    entry.image = preview_;
    entry.preview = true;
    dataset_.addImage(std::move(entry));
    begin();
    workers_.run(
        [connection = connection_, options = *options, activity] {
            return connection->render(options, Activity::observer(activity, options.preview));
        },
        [this, activity, withLayers = !options->layers.empty()](Result<client::Render> result) {
            if (activity == render_) rendered(activity, withLayers, std::move(result));
        });
}

/// What the server still keeps of an earlier render, as after connecting anew.
void SessionController::fetchLayers() {
    auto activity = std::make_shared<Activity>();
    layers_ = activity;
    begin();
    workers_.run([connection = connection_, activity] { return connection->surface(0, {}, Activity::observer(activity)); },
                 [this, activity](Result<SurfaceField> result) {
                     if (activity != layers_) return;
                     layers_.reset();
                     if (result) dataset_.setSurface(std::make_shared<const SurfaceField>(std::move(*result)));
                     else if (result.error().code != ErrorCode::connectionLost) fail(FailedTask::surface, result.error());
                     emit activityChanged();
                 });
}

void SessionController::cancelRender() {
    if (!render_) return;
    *render_->cancel = true;
    render_.reset();
    if (finished_) return completeRender(std::nullopt);
    abandonRender(Error{ErrorCode::cancelled, {}});
}

void SessionController::drainPreview() {
    if (!render_ || !preview_) return;
    const auto tiles = render_->takeTiles();
    for (const Activity::Tile& tile : tiles) {
        if (tile.rect.x1 > preview_->color.width() || tile.rect.y1 > preview_->color.height()) continue;
        if (tile.colors.size() != tile.rect.count()) continue;
        std::size_t i = 0;
        for (std::uint32_t y = tile.rect.y0; y < tile.rect.y1; ++y)
            for (std::uint32_t x = tile.rect.x0; x < tile.rect.x1; ++x) preview_->color.setColor({x, y}, tile.colors[i++]);
    }
    const client::ImageEntry* current = dataset_.currentImage();
    if (!tiles.empty() && current && current->image == preview_) dataset_.pixelsChanged();
}

void SessionController::rendered(const std::shared_ptr<Activity>& activity, bool withLayers, Result<client::Render> result) {
    if (!result) return abandonRender(result.error());
    drainPreview();
    lastRequest_ = tr("render in %1, renderer %2")
                       .arg(toQString(analysis::formatDuration(double(activity->clock.nsecsElapsed()) * 1e-9)),
                            toQString(analysis::formatDuration(result->seconds)));
    finished_ = std::move(*result);
    if (!withLayers) return completeRender(std::nullopt);
    activity->fraction = -1;
    workers_.run([connection = connection_, activity, id = finished_->id] { return connection->surface(id, {}, Activity::observer(activity)); },
                 [this, activity](Result<SurfaceField> surface) {
                     if (activity == render_) completeRender(std::move(surface));
                 });
    emit activityChanged();
}

/// The image, and its layers if there are any, come at once: views that show both change once.
void SessionController::completeRender(std::optional<Result<SurfaceField>> surface) {
    const auto index = indexOf(preview_);
    render_.reset();
    preview_.reset();
    client::Render render = std::move(*finished_);
    finished_.reset();
    {
        const client::Dataset::Transaction together(dataset_);
        if (index) {
            client::ImageEntry entry = entryOf(std::move(render), renderCount_);
            if (rendersUnasked_) automaticImage_ = entry.image;
            dataset_.replaceImage(*index, std::move(entry));
        }
        if (surface && *surface) {
            layers_.reset();   // older ones on their way
            dataset_.setSurface(std::make_shared<const SurfaceField>(std::move(**surface)));
        }
    }
    emit renderFinished();
    if (surface && !*surface) {
        const ErrorCode code = surface->error().code;
        if (code != ErrorCode::cancelled && code != ErrorCode::connectionLost) fail(FailedTask::surface, surface->error());
    }
    emit activityChanged();
}

void SessionController::abandonRender(const Error& error) {
    drainPreview();
    const auto index = indexOf(preview_);
    render_.reset();
    // What has arrived stays to look at; its missing pixels can be compared with nothing.
    if (index) {
        client::ImageEntry entry = dataset_.images()[*index];
        entry.title = "Render " + std::to_string(renderCount_) + ", incomplete";
        entry.preview = false;
        dataset_.replaceImage(*index, std::move(entry));
    }
    preview_.reset();
    if (error.code != ErrorCode::cancelled && error.code != ErrorCode::connectionLost) fail(FailedTask::render, error);
    emit activityChanged();
}

void SessionController::openImage(const QString& file) { readImage(file, false); }

void SessionController::openReference(const QString& file) { readImage(file, true); }

void SessionController::readImage(const QString& file, bool asReference) {
    ++filesBeingRead_;
    emit activityChanged();
    workers_.run([path = std::filesystem::path(file.toStdString())] { return imageio::read(path); },
                 [this, file, asReference](Result<Image> result) {
                     --filesBeingRead_;
                     if (!result) {
                         fail(FailedTask::openImage, result.error());
                     } else {
                         client::ImageEntry entry;
                         entry.title = QFileInfo(file).fileName().toStdString();
                         auto image = std::make_shared<RenderedImage>();
                         image->color = std::move(*result);
                         entry.image = image;
                         {
                             const client::Dataset::Transaction once(dataset_);
                             const bool stays = asReference && dataset_.currentImage();
                             const std::size_t current = dataset_.currentImageIndex();
                             dataset_.addImage(std::move(entry));
                             if (stays) dataset_.setCurrentImage(current);
                         }
                         emit imageOpened(file);
                         if (asReference) emit referenceOpened(image);
                     }
                     emit activityChanged();
                 });
}

void SessionController::saveImage(const QString& file) {
    const client::ImageEntry* entry = dataset_.currentImage();
    if (!entry || !entry->image) {
        emit failed(FailedTask::saveImage, tr("Nothing was saved: there is no image yet."));
        return;
    }
    workers_.run(
        // A preview is still written to by this thread: a copy of it is saved.
        [path = std::filesystem::path(file.toStdString()),
         image = entry->preview ? std::make_shared<const RenderedImage>(*entry->image) : entry->image] {
            const bool rendered = !image->samples.empty() && path.extension() == ".exr";
            return rendered ? imageio::write(path, *image) : imageio::write(path, image->color);
        },
        [this, file](Result<void> result) {
            if (result) emit imageSaved(file);
            else fail(FailedTask::saveImage, result.error());
        });
}

}  // namespace emca::explorer
