// Renders, previews and image files of SessionController.
#include <QFileInfo>

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

void SessionController::render(const client::RenderOptions& options) {
    renderOptions_ = options;
    if (!connection_ || !dataset_.info()) {
        emit failed(FailedTask::render, tr("Nothing was rendered: no renderer is connected. Connect to one first."));
        return;
    }
    cancelRender();
    auto activity = std::make_shared<Activity>();
    render_ = activity;
    const client::ServerInfo& info = *dataset_.info();
    preview_ = std::make_shared<RenderedImage>();
    preview_->color = Image(info.width, info.height);
    client::ImageEntry entry;
    entry.title = "Render " + std::to_string(++renderCount_) + ", rendering";
    entry.samplesPerPixel = options.samplesPerPixel ? options.samplesPerPixel : info.samplesPerPixel;
    entry.image = preview_;
    entry.preview = true;
    dataset_.addImage(std::move(entry));
    begin();
    workers_.run(
        [connection = connection_, options, activity] {
            return connection->render(options, Activity::observer(activity, options.preview));
        },
        [this, activity](Result<client::Render> result) {
            if (activity == render_) rendered(activity, std::move(result));
        });
}

void SessionController::cancelRender() {
    if (!render_) return;
    *render_->cancel = true;
    const auto activity = std::move(render_);
    render_.reset();
    rendered(activity, Error{ErrorCode::cancelled, {}});
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

void SessionController::rendered(std::shared_ptr<Activity> activity, Result<client::Render> result) {
    drainPreview();
    const auto index = indexOf(preview_);
    render_.reset();
    if (result) {
        lastRequest_ = tr("render in %1, renderer %2")
                           .arg(toQString(analysis::formatDuration(double(activity->clock.nsecsElapsed()) * 1e-9)),
                                toQString(analysis::formatDuration(result->seconds)));
        preview_.reset();
        if (index) dataset_.replaceImage(*index, entryOf(std::move(*result), renderCount_));
        emit renderFinished();
        emit activityChanged();
        return;
    }
    // What has arrived stays to look at; its missing pixels can be compared with nothing.
    if (index) {
        client::ImageEntry entry = dataset_.images()[*index];
        entry.title = "Render " + std::to_string(renderCount_) + ", incomplete";
        entry.preview = false;
        dataset_.replaceImage(*index, std::move(entry));
    }
    preview_.reset();
    const ErrorCode code = result.error().code;
    if (code != ErrorCode::cancelled && code != ErrorCode::connectionLost) fail(FailedTask::render, result.error());
    emit activityChanged();
}

void SessionController::openImage(const QString& file) {
    ++filesBeingRead_;
    emit activityChanged();
    workers_.run([path = std::filesystem::path(file.toStdString())] { return imageio::read(path); },
                 [this, file](Result<Image> result) {
                     --filesBeingRead_;
                     if (!result) {
                         fail(FailedTask::openImage, result.error());
                     } else {
                         client::ImageEntry entry;
                         entry.title = QFileInfo(file).fileName().toStdString();
                         auto image = std::make_shared<RenderedImage>();
                         image->color = std::move(*result);
                         entry.image = std::move(image);
                         dataset_.addImage(std::move(entry));
                         emit imageOpened();
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
