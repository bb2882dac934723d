#include "window/saved_view.h"

#include <QVariantMap>
#include <algorithm>
#include <array>

#include "base/qt_compat.h"
#include "image/image_model.h"
#include "image/image_view.h"
#include "scene/scene_view.h"
#include "window/view_options.h"
#include "window/views.h"

namespace emca::explorer {
namespace {

constexpr std::array<const char*, 4> kModes{"image", "reference", "split", "difference"};   // of ImageMode
const QString kMode = QStringLiteral("image/mode"), kMetric = QStringLiteral("image/metric");

client::SavedView::PathRays saved(const client::PathId& path, PathRays rays) { return {path, rays.line, rays.nextEvents}; }
client::SavedView::VertexRays saved(const client::VertexId& vertex, VertexRays rays) { return {vertex, rays.incoming, rays.outgoing, rays.nextEvents}; }

}  // namespace

client::SavedView savedView(const Views& views, const client::Dataset& dataset) {
    client::SavedView view;
    const ImageModel& model = views.image->model();
    if (model.reference()) {
        const auto found = std::ranges::find(dataset.images(), model.reference(), &client::ImageEntry::image);
        if (found != dataset.images().end()) view.reference = static_cast<std::size_t>(found - dataset.images().begin());
    }
    QVariantMap options = sceneSight(views.scene->options());
    options[kMode] = kModes[static_cast<std::size_t>(model.display().mode)];
    options[kMetric] = toQString(analysis::name(model.display().metric));
    for (auto option = options.begin(); option != options.end(); ++option) view.options.push_back({option.key().toStdString(), option.value().toString().toStdString()});
    for (const auto& [path, rays] : views.scene->raySwitches().paths()) view.paths.push_back(saved(path, rays));
    for (const auto& [vertex, rays] : views.scene->raySwitches().vertices()) view.vertices.push_back(saved(vertex, rays));
    return view;
}

void show(const client::SavedView& saved, Views& views, const client::Dataset& dataset) {
    QVariantMap options;
    for (const client::SavedView::Option& option : saved.options) options[toQString(option.name)] = toQString(option.value);
    ImageModel& model = views.image->model();
    model.setReference(saved.reference && *saved.reference < dataset.images().size() ? dataset.images()[*saved.reference].image : nullptr);
    if (const auto metric = analysis::imageMetricByName(options.value(kMetric).toString().toStdString())) model.setMetric(*metric);
    const auto mode = std::ranges::find(kModes, options.value(kMode).toString().toStdString());
    if (mode != kModes.end()) model.setMode(static_cast<ImageMode>(mode - kModes.begin()));

    SceneOptions scene = views.scene->options();
    setSceneSight(scene, options);
    views.scene->setOptions(scene);
    RaySwitches rays;
    for (const client::SavedView::PathRays& one : saved.paths) rays.set(one.path, PathRays{one.line, one.nextEvents});
    for (const client::SavedView::VertexRays& one : saved.vertices) rays.set(one.vertex, VertexRays{one.incoming, one.outgoing, one.nextEvents});
    views.scene->setRaySwitches(rays);
}

}  // namespace emca::explorer
