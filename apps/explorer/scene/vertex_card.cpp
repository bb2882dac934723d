#include "vertex_card.h"

#include "base/path_ids.h"
#include "base/qt_compat.h"
#include "emca/analysis/format.h"

namespace emca::explorer {
namespace {

constexpr std::size_t kMaximumRows = 9;

QString text(const std::string& s) { return toQString(s); }

QString eventText(const PathSet::Scattering& s) {
    QString words = QString::fromUtf8(name(s.event));
    if (s.lobe != Lobe::none) words += QString(", ") + QString::fromUtf8(name(s.lobe));
    if (!s.label.empty()) words += " · " + toQString(s.label);
    return words;
}

}  // namespace

QString pathTitle(const PathSet& paths, Index path) {
    QString title = "path " + QString::number(paths.sample(path));
    if (paths.part(path) != 0) title += "." + QString::number(paths.part(path));
    if (severalPixels(paths)) title += " of " + text(analysis::formatPixel(paths.pixel(path)));
    return title;
}

OverlayContent::Card vertexCard(const PathSet& paths, Index vertex, QPointF at) {
    OverlayContent::Card card{at, {}, {}};
    card.title = QString("Depth %1  ·  %2").arg(paths.depthIndex(vertex)).arg(pathTitle(paths, paths.pathOf(vertex)));
    if (paths.subpath(vertex) == Subpath::light) card.title += "  ·  light subpath";
    const auto row = [&](const QString& key, const QString& value) { card.rows.emplace_back(key, value); };
    if (const auto s = paths.scattering(vertex)) row("event", eventText(*s));
    else if (paths.isEnvironment(vertex)) row("event", "environment");
    if (const auto p = paths.position(vertex)) row("position", text(analysis::formatVector(*p)));
    if (const auto c = paths.vertexEstimate(vertex)) row("estimate", text(analysis::formatColor(*c)));
    if (const auto c = paths.emission(vertex); c && !isBlack(*c)) row("emission", text(analysis::formatColor(*c)));
    const IndexRange tests = paths.nextEvents(vertex);
    if (!tests.empty()) {
        Index visible = 0;
        for (Index i = tests.first; i < tests.last; ++i) visible += paths.nextEvent(i).visible != 0;
        row("next event", tests.size() == 1 ? QString(visible ? "visible" : "occluded")
                                            : QString("%1 of %2 visible").arg(visible).arg(tests.size()));
    }
    for (const Column& column : paths.userColumns()) {
        if (column.scope != Scope::vertex || card.rows.size() >= kMaximumRows) continue;
        if (const auto value = paths.last(column, vertex)) row(toQString(column.name), text(analysis::formatValue(*value, 4)));
    }
    return card;
}

}  // namespace emca::explorer
