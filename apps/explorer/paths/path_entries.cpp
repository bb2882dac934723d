#include "paths/path_entries.h"

#include <algorithm>
#include <cmath>

#include "base/qt_compat.h"
#include "emca/analysis/format.h"
#include "emca/analysis/surface_name.h"
#include "emca/core/event.h"

namespace emca::explorer {
namespace {

using Kind = Entry::Kind;

bool matches(const QString& key, const QString& filter) {
    return filter.isEmpty() || key.contains(filter, Qt::CaseInsensitive);
}

void append(const PathSet& paths, const Entry& entry, const QString& filter, std::vector<Entry>& out) {
    if (filter.isEmpty() || matches(keyText(paths, entry), filter)) out.push_back(entry);
}

void appendData(const PathSet& paths, Scope scope, Index owner, const QString& filter, std::vector<Entry>& out) {
    const std::span<const Column> columns = paths.userColumns();
    for (std::uint32_t c = 0; c < columns.size(); ++c) {
        if (columns[c].scope != scope) continue;
        const IndexRange values = columns[c].valuesOf(owner);
        if (values.empty() || !matches(toQString(columns[c].name), filter)) continue;
        for (Index i = values.first; i < values.last; ++i) out.push_back({Kind::data, owner, c, i});
    }
}

/// The core value of an entry as a Value, so that all text and colour rules are stated once.
std::optional<Value> coreValue(const PathSet& paths, const Entry& entry) {
    const auto wrap = [](const auto& value) { return value ? std::optional<Value>(*value) : std::nullopt; };
    switch (entry.kind) {
        case Kind::finalEstimate:
            return wrap(paths.estimate(entry.owner));
        case Kind::luminance: {
            const std::optional<Color> estimate = paths.estimate(entry.owner);
            return estimate ? std::optional<Value>(luminance(*estimate)) : std::nullopt;
        }
        case Kind::depth:
            return Value(std::int64_t(paths.depth(entry.owner)));
        case Kind::origin:
            return wrap(paths.origin(entry.owner));
        case Kind::splat:
            return Value(paths.columns().splats[entry.item].value);
        case Kind::position:
            return wrap(paths.position(entry.owner));
        case Kind::estimate:
            return wrap(paths.vertexEstimate(entry.owner));
        case Kind::emission:
            return wrap(paths.emission(entry.owner));
        case Kind::contribution:
            return Value(paths.contribution(entry.item).value);
        case Kind::nextEvent:
            return Value(paths.nextEvent(entry.item).position);
        case Kind::data:
            return paths.value(paths.userColumns()[entry.column], entry.item);
        case Kind::surface:
            return std::nullopt;
    }
    return std::nullopt;
}

QString surfaceText(const PathSet& paths, const Entry& entry, std::span<const Mesh> meshes) {
    const std::optional<PathSet::Surface> surface = paths.surface(entry.owner);
    return surface ? toQString(analysis::surfaceName(*surface, meshes)) : QString();
}

/// What belongs to the value of some kinds.
QString noteOf(const PathSet& paths, const Entry& entry, bool full) {
    switch (entry.kind) {
        case Kind::contribution: {
            const float weight = paths.contribution(entry.item).misWeight;
            if (std::isnan(weight)) return {};
            const std::string text = full ? analysis::formatFull(weight) : analysis::formatNumber(double(weight));
            return QStringLiteral("MIS ") + toQString(text);
        }
        case Kind::nextEvent:
            return paths.nextEvent(entry.item).visible ? QStringLiteral("visible") : QStringLiteral("occluded");
        case Kind::splat:
            return QStringLiteral("to pixel ") +
                   toQString(analysis::formatPixel(paths.columns().splats[entry.item].pixel));
        default:
            return {};
    }
}

QString withNote(const QString& value, const QString& note) {
    return note.isEmpty() ? value : value + QStringLiteral(", ") + note;
}

void writeEntries(const PathSet& paths, const std::vector<Entry>& entries, std::span<const Mesh> meshes, int indent,
                  QString& out) {
    for (const Entry& entry : entries)
        out += QString(indent, QLatin1Char(' ')) + keyText(paths, entry) + QStringLiteral(": ") +
               fullValueText(paths, entry, meshes) + QLatin1Char('\n');
}

}  // namespace

void appendPathInfo(const PathSet& paths, Index path, const QString& filter, std::vector<Entry>& out) {
    if (paths.estimate(path)) {
        append(paths, {Kind::finalEstimate, path}, filter, out);
        append(paths, {Kind::luminance, path}, filter, out);
    }
    append(paths, {Kind::depth, path}, filter, out);
    if (paths.origin(path)) append(paths, {Kind::origin, path}, filter, out);
    const IndexRange splats = paths.splats(path);
    for (Index i = splats.first; i < splats.last; ++i) append(paths, {Kind::splat, path, 0, i}, filter, out);
}

void appendPathData(const PathSet& paths, Index path, const QString& filter, std::vector<Entry>& out) {
    appendData(paths, Scope::path, path, filter, out);
}

void appendVertexEntries(const PathSet& paths, Index vertex, const QString& filter, std::vector<Entry>& out) {
    const IndexRange contributions = paths.contributions(vertex);
    for (Index i = contributions.first; i < contributions.last; ++i)
        append(paths, {Kind::contribution, vertex, 0, i}, filter, out);
    const IndexRange nextEvents = paths.nextEvents(vertex);
    for (Index i = nextEvents.first; i < nextEvents.last; ++i)
        append(paths, {Kind::nextEvent, vertex, 0, i}, filter, out);
    if (paths.vertexEstimate(vertex)) append(paths, {Kind::estimate, vertex}, filter, out);
    if (paths.emission(vertex)) append(paths, {Kind::emission, vertex}, filter, out);
    if (paths.position(vertex)) append(paths, {Kind::position, vertex}, filter, out);
    if (paths.surface(vertex)) append(paths, {Kind::surface, vertex}, filter, out);
    appendData(paths, Scope::vertex, vertex, filter, out);
}

QString keyText(const PathSet& paths, const Entry& entry) {
    switch (entry.kind) {
        case Kind::finalEstimate:
            return QStringLiteral("final estimate");
        case Kind::luminance:
            return QStringLiteral("luminance");
        case Kind::depth:
            return QStringLiteral("depth");
        case Kind::origin:
            return QStringLiteral("origin");
        case Kind::splat:
            return QStringLiteral("splat");
        case Kind::position:
            return QStringLiteral("position");
        case Kind::estimate:
            return QStringLiteral("estimate so far");
        case Kind::emission:
            return QStringLiteral("emission");
        case Kind::surface:
            return QStringLiteral("surface");
        case Kind::contribution: {
            const std::string_view technique = paths.text(paths.contribution(entry.item).technique);
            return technique.empty() ? QStringLiteral("contribution")
                                     : QStringLiteral("contribution · ") + toQString(technique);
        }
        case Kind::nextEvent:
            return QStringLiteral("next event");
        case Kind::data:
            return toQString(paths.userColumns()[entry.column].name);
    }
    return {};
}

QString valueText(const PathSet& paths, const Entry& entry, std::span<const Mesh> meshes) {
    if (entry.kind == Kind::surface) return surfaceText(paths, entry, meshes);
    const std::optional<Value> value = coreValue(paths, entry);
    return withNote(value ? toQString(analysis::formatValue(*value)) : QString(), noteOf(paths, entry, false));
}

QString fullValueText(const PathSet& paths, const Entry& entry, std::span<const Mesh> meshes) {
    if (entry.kind == Kind::surface) return surfaceText(paths, entry, meshes);
    const std::optional<Value> value = coreValue(paths, entry);
    return withNote(value ? toQString(analysis::formatValueFull(*value)) : QString(), noteOf(paths, entry, true));
}

ValueCells valueCells(const Value& value) {
    ValueCells cells;
    const int components = componentCount(typeOf(value));
    if (components == 0 || std::holds_alternative<bool>(value)) {
        cells.text = toQString(analysis::formatValue(value));
        return cells;
    }
    if (components == 1) {
        cells.numbers.append(toQString(analysis::formatValue(value)));
        return cells;
    }
    const bool integers = std::holds_alternative<Vec2i>(value) || std::holds_alternative<Vec3i>(value);
    for (int i = 0; i < components; ++i) {
        const double x = component(value, static_cast<std::size_t>(i));
        cells.numbers.append(
            toQString(integers ? analysis::formatInteger(std::int64_t(x)) : analysis::formatNumber(x)));
    }
    return cells;
}

ValueCells valueCells(const PathSet& paths, const Entry& entry, std::span<const Mesh> meshes) {
    if (entry.kind == Kind::surface) return {{}, surfaceText(paths, entry, meshes), {}};
    const std::optional<Value> value = coreValue(paths, entry);
    ValueCells cells = value ? valueCells(*value) : ValueCells();
    cells.note = noteOf(paths, entry, false);
    return cells;
}

std::optional<Color> colorOf(const PathSet& paths, const Entry& entry) {
    const std::optional<Value> value = coreValue(paths, entry);
    if (!value) return std::nullopt;
    if (const Color* color = std::get_if<Color>(&*value)) return *color;
    if (const ColorA* color = std::get_if<ColorA>(&*value)) return Color(color->r, color->g, color->b);
    return std::nullopt;
}

Tone toneOf(const PathSet& paths, const Entry& entry) {
    const std::optional<Value> value = coreValue(paths, entry);
    if (value && hasNonFinite(*value)) return Tone::warning;
    if (entry.kind == Kind::contribution && std::isinf(paths.contribution(entry.item).misWeight)) return Tone::warning;
    if (entry.kind == Kind::nextEvent) return paths.nextEvent(entry.item).visible ? Tone::visible : Tone::occluded;
    return Tone::normal;
}

QString pathText(const PathSet& paths, Index path, bool withPixel) {
    QString text = QStringLiteral("Path ") + toQString(analysis::formatInteger(paths.sample(path)));
    if (paths.part(path) != 0) text += QStringLiteral(".%1").arg(paths.part(path));
    if (withPixel) text += QLatin1Char(' ') + toQString(analysis::formatPixel(paths.pixel(path)));
    return text;
}

QString vertexText(const PathSet& paths, Index vertex) {
    QString text = QString::number(paths.depthIndex(vertex));
    if (paths.subpath(vertex) == Subpath::light) text.prepend(QStringLiteral("light "));
    const std::optional<PathSet::Scattering> scattering = paths.scattering(vertex);
    if (scattering && scattering->event != Event::none) {
        text += QStringLiteral(" · ") + QLatin1String(name(scattering->event));
        if (scattering->lobe != Lobe::none) text += QLatin1Char(' ') + QLatin1String(name(scattering->lobe));
    }
    if (paths.isEnvironment(vertex) && !(scattering && scattering->event == Event::background))
        text += QStringLiteral(" · environment");
    if (scattering && !scattering->label.empty()) text += QStringLiteral(" · ") + toQString(scattering->label);
    return text;
}

bool hasNonFinite(const Value& value) {
    if (const auto* spectrum = std::get_if<std::vector<float>>(&value))
        return std::any_of(spectrum->begin(), spectrum->end(), [](float x) { return !std::isfinite(x); });
    const int components = componentCount(typeOf(value));
    for (int i = 0; i < components; ++i)
        if (!std::isfinite(component(value, static_cast<std::size_t>(i)))) return true;
    return false;
}

bool isNonFinite(Color color) { return !isFinite(color); }

QString vertexAsText(const PathSet& paths, Index vertex, std::span<const Mesh> meshes, int indent) {
    QString out = QString(indent, QLatin1Char(' ')) + vertexText(paths, vertex) + QLatin1Char('\n');
    std::vector<Entry> entries;
    appendVertexEntries(paths, vertex, {}, entries);
    writeEntries(paths, entries, meshes, indent + 2, out);
    return out;
}

QString pathAsText(const PathSet& paths, Index path, std::span<const Mesh> meshes) {
    QString out = pathText(paths, path, true) + QLatin1Char('\n');
    std::vector<Entry> entries;
    appendPathInfo(paths, path, {}, entries);
    appendPathData(paths, path, {}, entries);
    writeEntries(paths, entries, meshes, 2, out);
    const IndexRange vertices = paths.vertices(path);
    for (Index vertex = vertices.first; vertex < vertices.last; ++vertex) out += vertexAsText(paths, vertex, meshes, 2);
    return out;
}

std::span<const Mesh> meshesOf(const client::Dataset& dataset) {
    const auto& meshes = dataset.meshes();
    return meshes ? std::span<const Mesh>(*meshes) : std::span<const Mesh>();
}

}  // namespace emca::explorer
