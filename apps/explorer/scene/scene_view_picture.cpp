#include <QPainter>

#include <algorithm>

#include "scene_view_impl.h"

// Pictures of the 3D view, of any size.
namespace emca::explorer {

QImage SceneView::renderImage(QSize size) {
    if (!impl_->canvas) return {};
    impl_->setCoarse(false);
    const MeshDetail detail = impl_->meshes->detail();
    impl_->meshes->setDetail(MeshDetail::full);
    // Overlays and the colour bar are laid out in the view's own pixels and enlarged with the lines.
    const double scale = impl_->canvas->height() > 0 ? std::max(1.0, double(size.height()) / impl_->canvas->height()) : 1;
    const QSize inner(std::max(size.width() - int(impl_->barWidth() * scale), 1), size.height());
    const QImage scene = impl_->canvas->renderImage(inner);
    impl_->meshes->setDetail(detail);
    if (scene.isNull()) return scene;
    QImage image(size, QImage::Format_RGB32);
    image.fill(impl_->theme.colors().ground);
    OverlayContent content = impl_->overlayContent({int(inner.width() / scale), int(inner.height() / scale)});
    content.hint.clear();
    content.card.reset();
    content.rectangle.reset();
    QPainter painter(&image);
    painter.drawImage(0, 0, scene);
    painter.scale(scale, scale);
    paintOverlay(painter, QSizeF(inner) / scale, content, impl_->theme);
    double x = inner.width() / scale;
    for (const auto& [bar, bands] : impl_->bars()) {
        paintColorBar(painter, QRectF(x, 0, ColorBar::kTitledWidth, size.height() / scale), bands, impl_->theme);
        x += ColorBar::kTitledWidth;
    }
    return image;
}

Result<void> SceneView::saveImage(const QString& file, QSize size) {
    if (!impl_->canvas)
        return Error{ErrorCode::notSupported, "A picture of the 3D view was asked for, but this display has no OpenGL 3.2."};
    if (size.width() < 1 || size.height() < 1 || size.width() > 16384 || size.height() > 16384)
        return Error{ErrorCode::invalidArgument, "A picture of " + std::to_string(size.width()) + " x " +
                                                     std::to_string(size.height()) + " pixels was asked for; 1 to 16384 work."};
    const QImage image = renderImage(size);
    if (image.isNull() || !image.save(file, "PNG"))
        return Error{ErrorCode::fileUnwritable, "The picture could not be written to '" + file.toStdString() +
                                                    "'; check that the folder exists and may be written."};
    return {};
}

}  // namespace emca::explorer
