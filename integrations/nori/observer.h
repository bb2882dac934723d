#pragma once

#include <optional>
#include <unordered_map>
#include <vector>

#include "emca/recorder/path_layers.h"
#include "nori_headers.h"

namespace emca::nori_adapter {

/// The layers that can be collected of any integrator.
const std::vector<LayerDescription>& surfaceLayers();

/// A triangle that a ray was tested against, and met.
struct TriangleHit {
    const nori::Mesh* mesh = nullptr;
    std::uint32_t face = 0;
    float u = 0, v = 0, t = 0;
};

/// Places of the scene's meshes in the list that EMCA got.
using MeshIndices = std::unordered_map<const nori::Mesh*, std::int32_t>;

/// Watches one path of an integrator that knows nothing of EMCA: the rays that it traces, the BSDFs that it asks, the random
/// numbers that it draws. Belongs to one thread.
///
/// Which ray goes on with the path and which one only looks whether light is visible, nobody says. A shadow ray, or a ray of
/// finite length in a direction that no BSDF gave, is a test. A ray in the direction that a BSDF sampled goes on. Any other
/// hit waits: it is a vertex as soon as the integrator does something there, and was a test if it goes back to where it
/// was. BSDF calls belong to the vertex whose direction of incidence they name.
class Observer {
  public:
    Observer(const MeshIndices& meshes, nori::Point3f centre, float radius) : meshes_(meshes), centre_(centre), radius_(radius) {}

    /// \param surface  null, or the same for all paths
    void beginPath(PathRecorder emca, std::int64_t sample, SurfaceRecorder* surface);
    void endPath(const nori::Color3f& radiance);

    void randomNumber(float u);
    void randomNumbers(const nori::Point2f& u);
    /// Before and in between a ray's traversal.
    void beginRay() { hits_.clear(); }
    void triangleHit(const TriangleHit& hit) { hits_.push_back(hit); }
    /// \param hit  null if the ray met nothing
    void rayTraced(const nori::Ray3f& ray, const nori::Intersection* hit, bool shadowRay);
    void bsdfSampled(const nori::BSDF& bsdf, const nori::BSDFQueryRecord& query, const nori::Point2f& u, const nori::Color3f& weight);
    void bsdfValue(const nori::BSDF& bsdf, const nori::BSDFQueryRecord& query, const nori::Color3f& value);
    void bsdfPdf(const nori::BSDF& bsdf, const nori::BSDFQueryRecord& query, float pdf);

  private:
    /// Where the path is, or was.
    struct Vertex {
        nori::Point3f position;
        nori::Frame frame;
        nori::Vector3f wi;                       ///< local direction from which the path came
        const nori::Mesh* mesh = nullptr;
        std::optional<TriangleHit> triangle;
        SurfacePoint point;                      ///< in the layers: a test may start at any vertex
        std::int32_t depth = 0;
        std::optional<nori::Vector3f> sampled;   ///< local direction that its BSDF gave
        bool wentOn = false;
    };

    /// What paths add to the layers.
    struct Tally {
        explicit Tally(SurfaceRecorder& surface);
        PathLayers layers;
        PathTally paths;
        SurfaceLayer shadowed;
        int vertices = 0;  ///< of this path
    };

    Vertex vertexOf(const nori::Ray3f& ray, const nori::Intersection& hit) const;
    /// Position in path_ of the latest vertex from which this ray starts; -1 if from none.
    int startOf(const nori::Ray3f& ray) const;
    bool isSampled(const Vertex& vertex, const nori::Ray3f& ray) const;
    void goOnFrom(int start);
    void enter(const Vertex& vertex);
    void leave(const nori::Ray3f& ray);
    void resolveWaiting(bool isVertex);
    void test(const nori::Ray3f& ray, int start, bool visible);
    Vertex* vertexOf(const nori::BSDFQueryRecord& query);
    /// Makes a vertex the one that values belong to.
    void at(const Vertex& vertex) { emca_.setDepthIndex(vertex.depth); }
    void back();
    nori::Point3f beyond(const nori::Ray3f& ray) const;
    bool near(const nori::Point3f& a, const nori::Point3f& b) const { return (a - b).norm() <= 1e-3f * radius_; }

    const MeshIndices& meshes_;
    nori::Point3f centre_;
    float radius_;

    PathRecorder emca_;
    std::optional<Tally> tally_;         ///< where layers are collected
    std::int64_t sample_ = 0;
    std::int32_t part_ = 0;
    bool begun_ = false, left_ = false;
    std::vector<Vertex> path_;
    std::optional<Vertex> waiting_;      ///< a hit that may be a vertex or a test
    int waitingStart_ = -1;
    std::vector<TriangleHit> hits_;      ///< of the ray that is traced now
};

/// The observer of this thread's current path, or null.
Observer*& currentObserver();

/// From now on, calls of sample(), eval() and pdf() of this BSDF, and of all others of its class, are told to the observer of
/// the calling thread. The object, its class and what they answer stay as they are. Not while anything renders.
///
/// Rewrites three entries of the class' table of virtual functions (Itanium C++ ABI, Linux): a proxy object in the BSDF's place
/// would hide virtual functions that a course adds to nori::BSDF.
void observe(const nori::BSDF& bsdf);

}  // namespace emca::nori_adapter
