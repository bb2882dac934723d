#pragma once

#include <cmath>
#include <functional>
#include <random>
#include <thread>
#include <utility>
#include <vector>

#include "emca/core/mesh.h"
#include "emca/recorder/surface_recorder.h"

namespace emca::test {

/// The unit square, z = 0, as side x side quads of two triangles each.
inline Mesh grid(std::uint32_t side) {
    Mesh mesh;
    mesh.name = "grid";
    for (std::uint32_t y = 0; y <= side; ++y)
        for (std::uint32_t x = 0; x <= side; ++x) mesh.positions.push_back({float(x) / float(side), float(y) / float(side), 0});
    for (std::uint32_t y = 0; y < side; ++y)
        for (std::uint32_t x = 0; x < side; ++x) {
            const std::uint32_t i = y * (side + 1) + x;
            mesh.triangles.push_back({i, i + 1, i + side + 2});
            mesh.triangles.push_back({i, i + side + 2, i + side + 1});
        }
    return mesh;
}

inline double area(const std::vector<Vec3f>& positions, const Triangle& t) {
    const Vec3f a = positions[t[0]], b = positions[t[1]], c = positions[t[2]];
    return 0.5 * double(length(cross(b - a, c - a)));
}

/// A triangle of `mesh` by area, and barycentric coordinates on it.
struct UniformPoint {
    std::uint32_t face = 0;
    Vec2f uv;
};
class UniformPoints {
  public:
    explicit UniformPoints(const Mesh& mesh, unsigned seed) : random_(seed) {
        std::vector<double> areas;
        for (const Triangle& t : mesh.triangles) areas.push_back(area(mesh.positions, t));
        faces_ = std::discrete_distribution<std::uint32_t>(areas.begin(), areas.end());
    }
    UniformPoint next() {
        UniformPoint p{faces_(random_), {uniform_(random_), uniform_(random_)}};
        if (p.uv.x + p.uv.y > 1) p.uv = {1 - p.uv.x, 1 - p.uv.y};
        return p;
    }

  private:
    std::mt19937 random_;
    std::discrete_distribution<std::uint32_t> faces_;
    std::uniform_real_distribution<float> uniform_;
};

inline Vec3f position(const Mesh& mesh, std::uint32_t face, Vec2f uv) {
    const Triangle t = mesh.triangles[face];
    return mesh.positions[t[0]] * (1 - uv.x - uv.y) + mesh.positions[t[1]] * uv.x + mesh.positions[t[2]] * uv.y;
}

/// A recorder with one density layer and a mean, and what it was given.
struct Collection {
    std::vector<Mesh> meshes;
    SurfaceRecorder recorder;
    SurfaceLayer density, mean;

    explicit Collection(std::vector<Mesh> scene, SurfaceOptions options = {})
        : meshes(std::move(scene)), recorder(meshes, options),
          density(*recorder.addLayer({"density", LayerKind::density, "1/m^2", ""})),
          mean(*recorder.addLayer({"mean", LayerKind::mean, "", ""})) {}

    /// Uniform points on mesh 0; `value` of their position goes to the mean.
    void record(int count, unsigned seed, const std::function<float(Vec3f)>& value = [](Vec3f p) { return p.x; }) {
        UniformPoints points(meshes[0], seed);
        SurfaceCursor& surface = recorder.cursor();
        for (int i = 0; i < count; ++i) {
            const UniformPoint p = points.next();
            const SurfacePoint at = surface.locate(0, p.face, p.uv);
            density.add(at);
            mean.add(at, value(position(meshes[0], p.face, p.uv)));
        }
    }
};

inline void inThreads(int count, const std::function<void(int)>& work) {
    std::vector<std::thread> threads;
    for (int i = 0; i < count; ++i) threads.emplace_back(work, i);
    for (std::thread& thread : threads) thread.join();
}

/// Sum over all refined faces of value times area: what a density layer was given.
inline double integral(const SurfaceField& field, const SurfaceLayerData& layer, const std::vector<Mesh>& meshes) {
    double sum = 0;
    for (std::size_t m = 0; m < meshes.size(); ++m) {
        if (field.meshes[m].faceCount == 0) continue;
        const auto refined = refine(meshes[m], field.meshes[m].subdivision);
        if (!refined) return std::nan("");
        for (std::uint32_t face = 0; face < refined->triangles.size(); ++face) {
            const double a = area(refined->positions, refined->triangles[face]);
            if (a > 0) sum += a * double(field.value(layer, m, face));
        }
    }
    return sum;
}

inline double total(const SharedArray<float>& values) {
    double sum = 0;
    for (const float v : values) sum += double(v);
    return sum;
}

}  // namespace emca::test
