#include "plots/plot_export.h"

#include <QImage>
#include <QPainter>
#include <QSaveFile>
#include <QSvgGenerator>
#include <QWidget>

namespace emca::explorer {
namespace {

Error unwritable(const QString& file, const QString& why) {
    return {ErrorCode::fileUnwritable,
            (QStringLiteral("Could not write \"%1\": %2; choose another folder or name").arg(file, why)).toStdString()};
}

}  // namespace

Result<void> exportText(const QString& text, const QString& file) {
    QSaveFile out(file);
    if (!out.open(QIODevice::WriteOnly)) return unwritable(file, out.errorString());
    out.write(text.toUtf8());
    if (!out.commit()) return unwritable(file, out.errorString());
    return {};
}

Result<void> exportPicture(QWidget& widget, const QString& file) {
    QSaveFile out(file);
    if (!out.open(QIODevice::WriteOnly)) return unwritable(file, out.errorString());
    if (file.endsWith(QLatin1String(".svg"), Qt::CaseInsensitive)) {
        QSvgGenerator generator;
        generator.setOutputDevice(&out);
        generator.setSize(widget.size());
        generator.setViewBox(widget.rect());
        // In the widget's own resolution, so that fonts keep their size.
        generator.setResolution(widget.logicalDpiX());
        QPainter painter(&generator);
        widget.render(&painter);
    } else {
        constexpr int kScale = 2;
        QImage image(widget.size() * kScale, QImage::Format_ARGB32_Premultiplied);
        image.setDevicePixelRatio(kScale);
        image.fill(Qt::transparent);
        widget.render(&image);
        if (!image.save(&out, "PNG")) return unwritable(file, QStringLiteral("the picture could not be encoded"));
    }
    if (!out.commit()) return unwritable(file, out.errorString());
    return {};
}

}  // namespace emca::explorer
