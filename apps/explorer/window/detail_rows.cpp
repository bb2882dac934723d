#include "window/detail_rows.h"

#include <QObject>
#include <cmath>

#include "base/qt_compat.h"
#include "emca/analysis/format.h"

namespace emca::explorer {
namespace {

class Rows {
  public:
    void heading(const QString& name) { pending_ = name; }
    void text(const QString& name, const QString& value, bool warning = false) {
        if (!value.isEmpty()) add({name, value, value, std::nullopt, warning});
    }
    void value(const QString& name, const Value& value) {
        DetailRow row{name, toQString(analysis::formatValue(value)), toQString(analysis::formatValueFull(value)), std::nullopt, false};
        for (int i = 0; i < componentCount(typeOf(value)); ++i)
            row.warning = row.warning || !std::isfinite(component(value, static_cast<std::size_t>(i)));
        if (const auto* color = std::get_if<Color>(&value)) row.swatch = *color;
        if (const auto* color = std::get_if<ColorA>(&value)) row.swatch = Color(color->r, color->g, color->b);
        if (row.value.isEmpty()) row.value = QStringLiteral("“”");
        add(std::move(row));
    }
    void vector(const QString& name, Vec3f v) {
        add({name, toQString(analysis::formatVector(v)), toQString(analysis::formatValueFull(Value(v))), std::nullopt, !isFinite(v)});
    }
    std::vector<DetailRow> take() { return std::move(rows_); }

  private:
    /// A heading appears with its first row: empty groups leave no trace.
    void add(DetailRow row) {
        if (!pending_.isEmpty()) rows_.push_back({std::exchange(pending_, {}), {}, {}, std::nullopt, false});
        rows_.push_back(std::move(row));
    }
    QString pending_;
    std::vector<DetailRow> rows_;
};

void addColumns(Rows& rows, const PathSet& paths, Scope scope, Index owner) {
    for (const Column& column : paths.userColumns()) {
        if (column.scope != scope) continue;
        const IndexRange range = column.valuesOf(owner);
        for (Index i = range.first; i < range.last; ++i) {
            const QString name = toQString(column.name);
            rows.value(range.size() > 1 ? QStringLiteral("%1 [%2]").arg(name).arg(i - range.first) : name, paths.value(column, i));
        }
    }
}

QString eventText(const PathSet::Scattering& scattering) {
    QStringList words;
    if (scattering.lobe != Lobe::none) words += toQString(name(scattering.lobe));
    words += toQString(name(scattering.event));
    return words.join(' ');
}

}  // namespace

std::vector<DetailRow> vertexRows(const PathSet& paths, Index vertex, std::span<const Mesh> meshes) {
    Rows rows;
    const auto tr = [](const char* text) { return QObject::tr(text); };
    rows.heading(tr("Vertex"));
    if (paths.isEnvironment(vertex)) rows.text(tr("place"), tr("environment"));
    if (const auto position = paths.position(vertex)) rows.vector(tr("position"), *position);
    if (paths.subpath(vertex) == Subpath::light) rows.text(tr("subpath"), toQString(name(Subpath::light)));
    if (const auto scattering = paths.scattering(vertex)) {
        rows.text(tr("event"), eventText(*scattering));
        rows.text(tr("label"), toQString(scattering->label));
    }
    if (const auto surface = paths.surface(vertex)) {
        const bool known = surface->mesh >= 0 && static_cast<std::size_t>(surface->mesh) < meshes.size();
        const Mesh* mesh = known ? &meshes[static_cast<std::size_t>(surface->mesh)] : nullptr;
        rows.text(tr("surface"), mesh && !mesh->name.empty() ? toQString(mesh->name) : tr("mesh %1").arg(surface->mesh));
        if (mesh) rows.text(tr("material"), toQString(mesh->material));
        rows.text(tr("face"), QString::number(surface->face));
    }
    rows.heading(tr("Light"));
    if (const auto estimate = paths.vertexEstimate(vertex)) rows.value(tr("estimate"), Value(*estimate));
    if (const auto emission = paths.emission(vertex)) rows.value(tr("emission"), Value(*emission));
    const IndexRange contributions = paths.contributions(vertex);
    for (Index i = contributions.first; i < contributions.last; ++i) {
        const Contribution& c = paths.contribution(i);
        rows.value(toQString(paths.text(c.technique)), Value(c.value));
        if (!std::isnan(c.misWeight)) rows.value(tr("  MIS weight"), Value(c.misWeight));
    }
    const IndexRange nextEvents = paths.nextEvents(vertex);
    for (Index i = nextEvents.first; i < nextEvents.last; ++i) {
        const NextEvent& n = paths.nextEvent(i);
        rows.text(tr("light sample"), n.visible ? tr("visible") : tr("occluded"), !n.visible);
        rows.vector(tr("  at"), n.position);
    }
    rows.heading(tr("Data"));
    addColumns(rows, paths, Scope::vertex, vertex);
    return rows.take();
}

std::vector<DetailRow> pathRows(const PathSet& paths, Index path) {
    Rows rows;
    const auto tr = [](const char* text) { return QObject::tr(text); };
    rows.heading(tr("Path"));
    rows.text(tr("pixel"), toQString(analysis::formatPixel(paths.pixel(path))));
    rows.text(tr("sample"), QString::number(paths.sample(path)));
    if (paths.part(path)) rows.text(tr("part"), QString::number(paths.part(path)));
    rows.text(tr("depth"), QString::number(paths.depth(path)));
    rows.text(tr("vertices"), QString::number(paths.vertices(path).size()));
    if (const auto origin = paths.origin(path)) rows.vector(tr("origin"), *origin);
    rows.heading(tr("Light"));
    if (const auto estimate = paths.estimate(path)) {
        rows.value(tr("estimate"), Value(*estimate));
        rows.value(tr("luminance"), Value(luminance(*estimate)));
    }
    const IndexRange splats = paths.splats(path);
    for (Index i = splats.first; i < splats.last; ++i) {
        const Splat& splat = paths.columns().splats[i];
        rows.value(tr("splat at %1").arg(toQString(analysis::formatPixel(splat.pixel))), Value(splat.value));
    }
    rows.heading(tr("Data"));
    addColumns(rows, paths, Scope::path, path);
    return rows.take();
}

}  // namespace emca::explorer
