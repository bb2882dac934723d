#include <QGuiApplication>
#include <QOffscreenSurface>
#include <QOpenGLContext>
#include <QSurfaceFormat>
#include <QVTKOpenGLNativeWidget.h>

#include "scene_view.h"

namespace emca::explorer {

void prepareOpenGl() {
    QSurfaceFormat format = QVTKOpenGLNativeWidget::defaultFormat();
    format.setSamples(0);
    QSurfaceFormat::setDefaultFormat(format);
}

bool hasOpenGl() {
    static const bool works = [] {
        // Qt's offscreen platform may crash in a context that it promised.
        if (!qGuiApp || QGuiApplication::platformName() == "offscreen" || QGuiApplication::platformName() == "minimal")
            return false;
        QOpenGLContext context;
        context.setFormat(QVTKOpenGLNativeWidget::defaultFormat());
        QOffscreenSurface surface;
        surface.setFormat(context.format());
        surface.create();
        if (!context.create() || !surface.isValid() || !context.makeCurrent(&surface)) return false;
        const bool enough = context.format().version() >= qMakePair(3, 2);
        context.doneCurrent();
        return enough;
    }();
    return works;
}

}  // namespace emca::explorer
