#include "path_text.h"

#include <bit>
#include <sstream>

namespace emca::test {
namespace {

void write(std::ostream& out, float v) { out << std::hex << std::bit_cast<std::uint32_t>(v) << std::dec << ' '; }
void write(std::ostream& out, double v) { out << std::hex << std::bit_cast<std::uint64_t>(v) << std::dec << ' '; }
void write(std::ostream& out, std::int64_t v) { out << v << ' '; }
void write(std::ostream& out, bool v) { out << v << ' '; }
void write(std::ostream& out, const std::string& v) { out << '"' << v << "\" "; }
void write(std::ostream& out, Color v) { write(out, v.r), write(out, v.g), write(out, v.b); }
void write(std::ostream& out, ColorA v) { write(out, Color(v.r, v.g, v.b)), write(out, v.a); }
template <typename T>
void write(std::ostream& out, const Vec2<T>& v) {
    write(out, v.x), write(out, v.y);
}
template <typename T>
void write(std::ostream& out, const Vec3<T>& v) {
    write(out, v.x), write(out, v.y), write(out, v.z);
}
void write(std::ostream& out, const std::vector<float>& v) {
    for (const float f : v) write(out, f);
}

template <typename T>
void optional(std::ostream& out, const char* name, const std::optional<T>& value) {
    out << name << ' ';
    if (value)
        write(out, *value);
    else
        out << "- ";
}

void writeData(std::ostream& out, const PathSet& paths, Scope scope, Index owner) {
    for (const Column& column : paths.userColumns()) {
        if (column.scope != scope) continue;
        const IndexRange values = column.valuesOf(owner);
        for (Index i = values.first; i < values.last; ++i) {
            out << "\n    " << column.name << ' ' << name(column.type) << ' ';
            std::visit([&](const auto& value) { write(out, value); }, paths.value(column, i));
            if (!column.locations.empty()) out << "at " << paths.text(column.locations[i]);
        }
    }
}

void writeVertex(std::ostream& out, const PathSet& paths, Index v) {
    out << "\n  " << name(paths.subpath(v)) << ' ' << paths.depthIndex(v)
        << (paths.isEnvironment(v) ? " environment " : " ");
    optional(out, "position", paths.position(v));
    optional(out, "estimate", paths.vertexEstimate(v));
    optional(out, "emission", paths.emission(v));
    if (const auto surface = paths.surface(v)) out << "surface " << surface->mesh << ' ' << surface->face << ' ';
    if (const auto s = paths.scattering(v)) out << name(s->event) << ' ' << name(s->lobe) << " \"" << s->label << "\" ";
    const IndexRange tests = paths.nextEvents(v), contributions = paths.contributions(v);
    for (Index i = tests.first; i < tests.last; ++i) {
        out << "\n    next event " << paths.nextEvent(i).visible << ' ';
        write(out, paths.nextEvent(i).position);
    }
    for (Index i = contributions.first; i < contributions.last; ++i) {
        const Contribution& c = paths.contribution(i);
        out << "\n    contribution " << name(c.end) << " \"" << paths.text(c.technique) << "\" ";
        write(out, c.value), write(out, c.misWeight);
    }
    writeData(out, paths, Scope::vertex, v);
}

}  // namespace

std::string pathText(const PathSet& paths) {
    std::ostringstream out;
    for (Index p = 0; p < paths.pathCount(); ++p) {
        out << "path " << paths.pixel(p).x << ',' << paths.pixel(p).y << ' ' << paths.sample(p) << '.' << paths.part(p)
            << ' ';
        optional(out, "origin", paths.origin(p));
        optional(out, "estimate", paths.estimate(p));
        const IndexRange splats = paths.splats(p), vertices = paths.vertices(p);
        for (Index i = splats.first; i < splats.last; ++i) {
            const Splat& splat = paths.columns().splats[i];
            out << "\n    splat " << splat.pixel.x << ',' << splat.pixel.y << ' ';
            write(out, splat.value);
        }
        writeData(out, paths, Scope::path, p);
        for (Index v = vertices.first; v < vertices.last; ++v) writeVertex(out, paths, v);
        out << '\n';
    }
    return out.str();
}

}  // namespace emca::test
