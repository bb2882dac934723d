#include "base/plot_export.h"

#include <QApplication>
#include <QClipboard>
#include <QFileDialog>
#include <QFileInfo>
#include <QImage>
#include <QKeyEvent>
#include <QMenu>
#include <QPainter>
#include <QSaveFile>
#include <QSvgGenerator>
#include <QWidget>
#include <algorithm>
#include <optional>

#include "base/qt_compat.h"
#include "base/table_text.h"

namespace emca::explorer {
namespace {

Error unwritable(const QString& file, const QString& why) {
    return {ErrorCode::fileUnwritable,
            (QStringLiteral("Could not write \"%1\": %2; choose another folder or name").arg(file, why)).toStdString()};
}

QImage pictureOf(QWidget& widget, int scale) {
    scale = std::clamp(scale, 1, 8);
    QImage image(widget.size() * scale, QImage::Format_ARGB32_Premultiplied);
    image.setDevicePixelRatio(scale);
    image.fill(Qt::transparent);
    widget.render(&image);
    return image;
}

void say(const PlotExport& plot, const QString& sentence) {
    if (plot.say) plot.say(sentence);
}

/// Errors: fileUnwritable.
Result<void> exportText(const QString& text, const QString& file) {
    QSaveFile out(file);
    if (!out.open(QIODevice::WriteOnly)) return unwritable(file, out.errorString());
    out.write(text.toUtf8());
    if (!out.commit()) return unwritable(file, out.errorString());
    return {};
}

/// SVG (text and points stay shapes) by the ending .svg, else PNG. Errors: fileUnwritable.
Result<void> exportPicture(QWidget& widget, const QString& file, int scale) {
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
        const QImage image = pictureOf(widget, scale);
        if (!image.save(&out, "PNG")) return unwritable(file, QStringLiteral("the picture could not be encoded"));
    }
    if (!out.commit()) return unwritable(file, out.errorString());
    return {};
}

/// While it lives, the plot shows itself as in a picture.
struct Posing {
    explicit Posing(const PlotExport& exported) : plot(exported) { if (plot.setExporting) plot.setExporting(true); }
    ~Posing() { if (plot.setExporting) plot.setExporting(false); }
    Posing(const Posing&) = delete;
    Posing& operator=(const Posing&) = delete;
    const PlotExport& plot;
};

QWidget& pictured(const PlotExport& plot) { return plot.picture ? *plot.picture : *plot.view; }

void write(const PlotExport& plot, const QString& file, int scale) {
    const Result<void> written = writeExport(plot, file, scale);
    say(plot, written ? QObject::tr("Wrote \"%1\"").arg(file) : toQString(written.error().message));
}

struct Format {
    const char *ending, *filter, *action;
    int scale;
};
constexpr Format kFormats[] = {
    {"svg", QT_TRANSLATE_NOOP("QObject", "SVG drawing (*.svg)"), QT_TRANSLATE_NOOP("QObject", "SVG drawing…"), 1},
    {"png", QT_TRANSLATE_NOOP("QObject", "PNG picture, twice as fine (*.png)"), QT_TRANSLATE_NOOP("QObject", "PNG picture, twice as fine…"), 2},
    {"png", QT_TRANSLATE_NOOP("QObject", "PNG picture, as on screen (*.png)"), QT_TRANSLATE_NOOP("QObject", "PNG picture, as on screen…"), 1},
    {"csv", QT_TRANSLATE_NOOP("QObject", "CSV values (*.csv)"), QT_TRANSLATE_NOOP("QObject", "CSV values…"), 1},
};

void askForFile(const PlotExport& plot, const Format* only) {
    QStringList filters;
    for (const Format& format : kFormats)
        if (!only || only == &format) filters += QObject::tr(format.filter);
    QString chosen;
    QString file = QFileDialog::getSaveFileName(plot.view, QObject::tr("Export plot"), only ? plot.name + '.' + only->ending : plot.name,
                                                filters.join(QStringLiteral(";;")), &chosen);
    if (file.isEmpty()) return;
    const Format* format = only;
    for (const Format& each : kFormats)
        if (!format && QObject::tr(each.filter) == chosen) format = &each;
    if (!format) format = &kFormats[0];
    // An ending that somebody typed wins, else that of the format.
    const QString typed = QFileInfo(file).suffix().toLower();
    const bool known = std::any_of(std::begin(kFormats), std::end(kFormats), [&](const Format& f) { return typed == QLatin1String(f.ending); });
    if (!known || (only && typed != QLatin1String(only->ending))) file += '.' + QLatin1String(format->ending);
    write(plot, file, format->scale);
}

enum class ExportKey { copy, ask };

std::optional<ExportKey> keyOf(const QKeyEvent& event) {
    if (event.matches(QKeySequence::Copy)) return ExportKey::copy;
    if (event.key() == Qt::Key_P && event.modifiers() == (Qt::ControlModifier | Qt::ShiftModifier)) return ExportKey::ask;
    return {};
}

}  // namespace

Result<void> writeExport(const PlotExport& plot, const QString& file, int scale) {
    if (file.endsWith(QLatin1String(".csv"), Qt::CaseInsensitive)) return exportText(plot.csv(), file);
    const Posing posing(plot);
    return exportPicture(pictured(plot), file, scale);
}

void copyValues(const PlotExport& plot) {
    QApplication::clipboard()->setText(tabsFromCsv(plot.csv()));
    say(plot, QObject::tr("Copied the values"));
}

void askForExport(const PlotExport& plot) { askForFile(plot, nullptr); }

void addExportActions(QMenu& menu, const PlotExport& plot) {
    menu.addAction(QObject::tr("Copy values"), menu.parentWidget(), [plot] { copyValues(plot); }, QKeySequence::Copy);
    menu.addAction(QObject::tr("Copy picture"), menu.parentWidget(), [plot] {
        const Posing posing(plot);
        QApplication::clipboard()->setImage(pictureOf(pictured(plot), 2));
        say(plot, QObject::tr("Copied a picture"));
    });
    QMenu* save = menu.addMenu(QObject::tr("Export"));
    for (const Format& format : kFormats)
        save->addAction(QObject::tr(format.action), menu.parentWidget(), [plot, &format] { askForFile(plot, &format); });
    save->addSeparator();
    save->addAction(QObject::tr("Any format…"), menu.parentWidget(), [plot] { askForExport(plot); }, QKeySequence("Ctrl+Shift+P"));
}

bool handleExportKeys(const QKeyEvent& event, const PlotExport& plot) {
    const std::optional<ExportKey> key = keyOf(event);
    if (key == ExportKey::copy) copyValues(plot);
    if (key == ExportKey::ask) askForExport(plot);
    return key.has_value();
}

bool claimExportKeys(QEvent& event) {
    if (event.type() != QEvent::ShortcutOverride || !keyOf(static_cast<QKeyEvent&>(event))) return false;
    event.accept();
    return true;
}

}  // namespace emca::explorer
