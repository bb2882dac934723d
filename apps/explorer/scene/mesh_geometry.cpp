#include "mesh_geometry.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "mesh_welding.h"

namespace emca::explorer {
namespace {

bool smoothTogether(Vec3f a, Vec3f b) {
    static const float kCosine = std::cos(kCreaseDegrees * std::numbers::pi_v<float> / 180);
    return dot(a, b) >= kCosine * std::sqrt(dot(a, a) * dot(b, b));
}

/// Area-weighted mean of the normals around a corner that are on the corner's side of all creases.
Vec3f cornerNormal(const Welded& w, std::uint32_t vertex, std::uint32_t face) {
    Vec3f sum;
    for (std::uint32_t i = w.firstFace[vertex]; i < w.firstFace[vertex + 1]; ++i) {
        const Vec3f n = w.faceNormals[w.faces[i]];
        if (w.faces[i] == face || smoothTogether(w.faceNormals[face], n)) sum += n;
    }
    return normalize(sum);
}

void append(const Welded& w, std::array<std::uint8_t, 3> color, ShadedTriangles& out) {
    // A position gets one output vertex per different normal: `next` chains those of one position.
    constexpr std::uint32_t kNone = 0xffffffffu;
    std::vector<std::uint32_t> head(w.positions.size(), kNone), next;
    const auto base = static_cast<std::uint32_t>(out.positions.size());
    for (std::uint32_t f = 0; f < w.triangles.size(); ++f) {
        Triangle made{};
        for (std::size_t c = 0; c < 3; ++c) {
            const std::uint32_t v = w.triangles[f][c];
            const Vec3f n = cornerNormal(w, v, f);
            std::uint32_t found = head[v];
            while (found != kNone && !(out.normals[base + found] == n)) found = next[found];
            if (found == kNone) {
                found = static_cast<std::uint32_t>(next.size());
                next.push_back(head[v]);
                head[v] = found;
                out.positions.push_back(w.positions[v]);
                out.normals.push_back(n);
                out.colors.push_back(color);
            }
            made[c] = base + found;
        }
        out.triangles.push_back(made);
    }
}

/// Borders and creases.
void appendEdges(const Welded& w, std::vector<Edge>& out) {
    BoundingBox box;
    for (const Vec3f& p : w.positions) box.extend(p);
    const float shortest = 1e-4f * box.diagonal();   // below a pixel even when the mesh fills the view
    // Edges from each position to later ones, from the faces around it: a few at a time, however many there are.
    struct Side { std::uint32_t to, face; };
    std::vector<Side> sides;
    for (std::uint32_t from = 0; from < w.positions.size(); ++from) {
        sides.clear();
        for (std::uint32_t i = w.firstFace[from]; i < w.firstFace[from + 1]; ++i)
            for (const std::uint32_t to : w.triangles[w.faces[i]])
                if (to > from) sides.push_back({to, w.faces[i]});
        std::sort(sides.begin(), sides.end(), [](const Side& a, const Side& b) { return a.to != b.to ? a.to < b.to : a.face < b.face; });
        for (std::size_t i = 0; i < sides.size();) {
            std::size_t end = i + 1;
            while (end < sides.size() && sides[end].to == sides[i].to) ++end;
            const bool border = end - i == 1;
            if (border || (end - i == 2 && !smoothTogether(w.faceNormals[sides[i].face], w.faceNormals[sides[i + 1].face])))
                if (const Edge e{w.positions[from], w.positions[sides[i].to]}; length(e.to - e.from) > shortest) out.push_back(e);
            i = end;
        }
    }
}

void keepLongest(std::vector<Edge>& edges) {
    if (edges.size() <= kMaximumEdges) return;
    std::nth_element(edges.begin(), edges.begin() + kMaximumEdges, edges.end(), [](const Edge& a, const Edge& b) {
        return dot(a.to - a.from, a.to - a.from) > dot(b.to - b.from, b.to - b.from);
    });
    edges.resize(kMaximumEdges);
}

float srgb(float linear) {
    linear = std::clamp(linear, 0.f, 1.f);
    return linear <= 0.0031308f ? 12.92f * linear : 1.055f * std::pow(linear, 1 / 2.4f) - 0.055f;
}

/// Lights that hang in or near the core belong to it; with nothing but lights they are the core.
void addNearLights(const std::vector<BoundingBox>& lights, BoundingBox& core) {
    const bool onlyLights = core.empty;
    const Vec3f centre = core.centre();
    const float reach = core.diagonal();
    for (const BoundingBox& light : lights) {
        if (!onlyLights && (length(light.centre() - centre) > reach || light.diagonal() > 2 * reach)) continue;
        core.extend(light.min);
        core.extend(light.max);
    }
}

/// Hue of what it emits, at full brightness and a third of its saturation.
std::array<std::uint8_t, 3> glowColor(Color emission) {
    const float peak = maxComponent(emission);
    std::array<std::uint8_t, 3> out{255, 244, 214};
    if (!isFinite(emission) || !(peak > 0)) return out;
    const float channels[3] = {emission.r, emission.g, emission.b};
    for (std::size_t i = 0; i < 3; ++i)
        out[i] = static_cast<std::uint8_t>(std::lround(255 * (0.6f + 0.4f * srgb(channels[i] / peak))));
    return out;
}

}  // namespace

std::array<std::uint8_t, 3> clayColor(Color diffuse, std::array<std::uint8_t, 3> base) {
    if (!isFinite(diffuse)) return base;
    const Color c{srgb(diffuse.r), srgb(diffuse.g), srgb(diffuse.b)};
    const float grey = luminance(c), clay = luminance(Color{float(base[0]), float(base[1]), float(base[2])}) / 255;
    // Lightness moves only a little around that of the clay, so that black objects keep their form.
    const float level = std::clamp(clay + 0.45f * (grey - 0.6f), 0.6f * clay, std::min(1.25f * clay, 0.95f));
    std::array<std::uint8_t, 3> out{};
    const float channels[3] = {c.r, c.g, c.b};
    for (std::size_t i = 0; i < 3; ++i) {
        const float tint = float(base[i]) / 255 - clay;
        const float value = level + tint + 0.5f * (channels[i] - grey);
        out[i] = static_cast<std::uint8_t>(std::lround(255 * std::clamp(value, 0.f, 1.f)));
    }
    return out;
}

MeshGeometry makeMeshGeometry(std::span<const Mesh> meshes, std::array<std::uint8_t, 3> base,
                              const std::atomic<bool>* cancel) {
    MeshGeometry g;
    std::vector<BoundingBox> lights;
    for (const Mesh& mesh : meshes) {
        if (cancel && *cancel) return g;
        const Welded w = weld(mesh, g.skippedTriangles);
        BoundingBox box;
        for (const Vec3f& p : w.positions) box.extend(p);
        if (!box.empty) {
            g.box.extend(box.min);
            g.box.extend(box.max);
        }
        if (mesh.isEmitter()) {
            if (!box.empty) lights.push_back(box);
            append(w, glowColor(mesh.emission), g.emitters);
            appendEdges(w, g.emitterEdges);
        } else {
            if (!box.empty) {
                g.core.extend(box.min);
                g.core.extend(box.max);
            }
            append(w, clayColor(mesh.diffuse, base), g.surfaces);
            appendEdges(w, g.edges);
            if (g.edges.size() > 4 * kMaximumEdges) keepLongest(g.edges);
        }
    }
    keepLongest(g.edges);
    keepLongest(g.emitterEdges);
    addNearLights(lights, g.core);
    return g;
}

std::optional<float> firstHit(std::span<const Mesh> meshes, Vec3f origin, Vec3f direction) {
    // Moeller and Trumbore 1997.
    float nearest = std::numeric_limits<float>::infinity();
    for (const Mesh& mesh : meshes)
        for (const Triangle& t : mesh.triangles) {
            const std::size_t n = mesh.positions.size();
            if (t[0] >= n || t[1] >= n || t[2] >= n) continue;
            const Vec3f a = mesh.positions[t[0]], ab = mesh.positions[t[1]] - a, ac = mesh.positions[t[2]] - a;
            const Vec3f p = cross(direction, ac), s = origin - a, q = cross(s, ab);
            const float determinant = dot(ab, p), u = dot(s, p) / determinant, v = dot(direction, q) / determinant;
            const float distance = dot(ac, q) / determinant;
            if (u >= 0 && v >= 0 && u + v <= 1 && distance > 0 && distance < nearest) nearest = distance;
        }
    return std::isfinite(nearest) ? std::optional(nearest) : std::nullopt;
}

}  // namespace emca::explorer
