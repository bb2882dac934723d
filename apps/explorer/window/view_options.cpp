#include "window/view_options.h"

#include <QHeaderView>
#include <QSplitter>
#include <string>
#include <type_traits>

#include "base/qt_compat.h"
#include "image/image_view.h"
#include "paths/filter_panel.h"
#include "paths/outlier_panel.h"
#include "paths/path_tree.h"
#include "paths/vertex_table.h"
#include "parallel/parallel_plot.h"
#include "plots/path_plot.h"
#include "scene/scene_options.h"
#include "scene/scene_view.h"
#include "window/history_view.h"
#include "window/views.h"

namespace emca::explorer {
namespace {

/// Calls f(name, member) for those of the 3D view's options that say what is seen.
template <typename Options, typename F>
void eachSight(Options& o, F f) {
    f("surfaceOpacity", o.surfaceOpacity);
    f("backFaces", o.backFaces);
    f("ownColors", o.ownColors);
    f("edges", o.edges);
    f("clipAxis", o.clip.axis);
    f("clipPosition", o.clip.position);
    f("clipFlip", o.clip.flip);
    f("clipPaths", o.clip.paths);
    f("paths", o.paths);
    f("nextEvents", o.nextEvents);
    f("wholePath", o.wholePath);
    f("incoming", o.incoming);
    f("outgoing", o.outgoing);
    f("lineWidth", o.lineWidth);
    f("pathOpacity", o.pathOpacity);
    f("colors", o.colors.quantity);
    f("colorMap", o.colors.map);
    f("colorLog", o.colors.log);
    f("arrows", o.arrows);
    f("depthLabels", o.depthLabels);
    f("cameraGlyph", o.cameraGlyph);
    f("lightGlyphs", o.lightGlyphs);
    f("axes", o.axes);
    f("legend", o.legend);
    f("orthographic", o.orthographic);
}

/// For those that serve a person or a machine, whatever is looked at.
template <typename Options, typename F>
void eachHabit(Options& o, F f) {
    f("fullDetail", o.fullDetail);
    f("maximumPaths", o.maximumPaths);
    f("depthPeeling", o.depthPeeling);
    f("smoothEdges", o.smoothEdges);
    f("flyToSelection", o.flyToSelection);
    f("animate", o.animate);
}

template <typename T>
QVariant toVariant(T value) {
    if constexpr (std::is_enum_v<T>) return static_cast<int>(value);
    else if constexpr (std::is_same_v<T, std::string>) return toQString(value);
    else return QVariant::fromValue(value);
}

/// The last member of an enumeration: files may hold any number.
template <typename T> constexpr int kLast = -1;
template <> constexpr int kLast<BackFaces> = int(BackFaces::hide);
template <> constexpr int kLast<PathChoice> = int(PathChoice::none);
template <> constexpr int kLast<NextEventChoice> = int(NextEventChoice::allPaths);
template <> constexpr int kLast<ClipAxis> = int(ClipAxis::view);
template <> constexpr int kLast<analysis::ColorMapId> = int(analysis::kColorMapCount) - 1;

/// Settings in files come back as texts.
template <typename T>
void read(const QVariantMap& from, const QString& name, T& value) {
    const auto found = from.find(name);
    if (found == from.end()) return;
    bool ok = true;
    if constexpr (std::is_same_v<T, bool>) value = found->toBool();
    else if constexpr (std::is_same_v<T, std::string>) value = found->toString().toStdString();
    else if constexpr (std::is_enum_v<T>) {
        const int number = found->toInt(&ok);
        if (ok && number >= 0 && number <= kLast<T>) value = static_cast<T>(number);
    } else if constexpr (std::is_floating_point_v<T>) {
        const double number = found->toDouble(&ok);
        if (ok && number >= 0 && number < 1e6) value = static_cast<T>(number);
    } else {
        const uint number = found->toUInt(&ok);
        if (ok) value = static_cast<T>(number);
    }
}

/// Headers and splitters of a view, by their order in it.
template <typename F>
void eachPart(const Views& views, F f) {
    const std::initializer_list<std::pair<const char*, QWidget*>> all{{"image", views.image}, {"paths", views.paths}, {"vertex", views.vertex},
                                                    {"outliers", views.outliers}, {"filter", views.filter}, {"history", views.history}};
    for (const auto& entry : all) {
        const char* name = entry.first;
        QWidget* view = entry.second;
        int number = 0;
        for (QHeaderView* header : view->findChildren<QHeaderView*>())
            if (header->orientation() == Qt::Horizontal) f(QStringLiteral("%1/header%2").arg(name).arg(number++), *header);
        number = 0;
        for (QSplitter* splitter : view->findChildren<QSplitter*>()) f(QStringLiteral("%1/splitter%2").arg(name).arg(number++), *splitter);
    }
}

}  // namespace

QVariantMap viewOptions(const Views& views) {
    QVariantMap options;
    for (const Views::Plot& plot : views.plots) options[plot.name + "/log"] = plot.widget->isLog();
    options["parallel/axes"] = views.parallel->layoutText();
    SceneOptions scene = views.scene->options();
    const auto keep = [&](const char* name, auto value) { options[QStringLiteral("scene/") + name] = toVariant(value); };
    eachSight(scene, keep);
    eachHabit(scene, keep);
    eachPart(views, [&](const QString& name, auto& part) { options[name] = part.saveState(); });
    return options;
}

void setViewOptions(const Views& views, const QVariantMap& options) {
    for (const Views::Plot& plot : views.plots) {
        bool log = plot.widget->isLog();
        read(options, plot.name + "/log", log);
        plot.widget->setLog(log);
    }
    if (const QString axes = options.value("parallel/axes").toString(); !axes.isEmpty()) views.parallel->setLayoutText(axes);
    SceneOptions scene = views.scene->options();
    const auto take = [&](const char* name, auto& value) { read(options, QStringLiteral("scene/") + name, value); };
    eachSight(scene, take);
    eachHabit(scene, take);
    views.scene->setOptions(scene);
    eachPart(views, [&](const QString& name, auto& part) {
        if (const QByteArray state = options.value(name).toByteArray(); !state.isEmpty()) part.restoreState(state);
    });
}

QVariantMap sceneSight(const SceneOptions& options) {
    QVariantMap sight;
    eachSight(options, [&](const char* name, const auto& value) { sight[QStringLiteral("scene/") + name] = toVariant(value); });
    return sight;
}

void setSceneSight(SceneOptions& options, const QVariantMap& sight) {
    eachSight(options, [&](const char* name, auto& value) { read(sight, QStringLiteral("scene/") + name, value); });
}

}  // namespace emca::explorer
