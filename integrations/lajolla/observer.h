#pragma once

#include <optional>

#include "emca/recorder/recorder.h"
#include "loaded_scene.h"
#include "surface_tally.h"

namespace emca::lajolla {

/// Watches one path of an integrator that knows nothing of EMCA: every call that it makes of lajolla's functions is told
/// here (wrapped_functions.cpp), and becomes positions, shadow tests, densities and values. Belongs to one thread.
///
/// A hit is not a vertex yet: a path in a medium may scatter before it. So the vertex begins with the first call that
/// speaks about its position; until then, what is said belongs to the vertex before.
class Observer {
  public:
    /// \param medium  the integrator may scatter between surfaces, and the scene has media
    Observer(const LoadedScene& scene, bool medium) : loaded_(scene), scene_(scene.scene()), medium_(medium) {}

    /// \param tally  null unless layers are collected
    void beginPath(PathRecorder emca, SurfaceTally* tally);
    void endPath(const Spectrum& radiance);

    void cameraRay(const Vector2& screen, const Ray& ray);
    void intersected(const Ray& ray, const std::optional<PathVertex>& hit);
    void shadowTested(const Ray& ray, bool occluded);
    void lightChosen(Real u, int light);
    void lightProbability(int light, Real probability);
    void lightSampled(const Light& light, const Vector3& from, const Vector2& u, Real uTriangle, const PointAndNormal& point);
    void lightPdf(const Light& light, const PointAndNormal& point, Real pdf);
    /// \param hit  null where a light was asked directly
    void emitted(const Light* light, const PathVertex* hit, const PointAndNormal& point, const Spectrum& emission);
    void bsdfSampled(const PathVertex& at, const Vector2& u, Real uLobe, const std::optional<BSDFSampleRecord>& sample);
    void bsdfValue(const Vector3& direction, const PathVertex& at, const Spectrum& value);
    void bsdfPdf(const Vector3& direction, const PathVertex& at, Real pdf);
    void phaseSampled(const Vector2& u, const std::optional<Vector3>& direction);
    void phaseValue(const Vector3& direction, const Spectrum& value);
    void phasePdf(const Vector3& direction, Real pdf);

  private:
    /// A direction that was sampled, and what became known of it.
    struct Sampled {
        Vector3 direction;
        std::optional<Vector2> random;
        std::optional<Spectrum> value;
        std::optional<Real> pdf;
        bool weightSaid = false;
    };

    bool near(const Vector3& a, const Vector3& b) const;
    /// The path speaks about a place: the hit that waited, a point in a medium, or where it is already.
    void arriveAt(const Vector3& position);
    void beginVertex();
    void beginSurfaceVertex(const PathVertex& hit);
    void beginMediumVertex(const Vector3& position);
    void beginBackgroundVertex();
    void sayScattering();
    void saySampled(Sampled& sampled);
    bool isShadowRay(const Ray& ray) const;
    void endShadowChain();
    Vector3 lightPosition(const Ray& ray) const;

    const LoadedScene& loaded_;
    const ::Scene& scene_;
    bool medium_;

    PathRecorder emca_;
    SurfaceTally* tally_ = nullptr;
    int depth_ = 0;
    bool begun_ = false;                       ///< the camera's ray was traced
    std::optional<Vector3> here_;              ///< of the vertex that is open; nothing before the first
    bool hereIsMedium_ = false;
    std::optional<PathVertex> waiting_;        ///< a hit that is no vertex yet
    std::optional<Ray> leaving_;               ///< a ray that hit nothing
    std::optional<Sampled> sampled_;           ///< from here
    std::optional<Sampled> phase_;             ///< of a scattering in a medium whose place is not known yet
    struct LightPoint { Vector3 position; bool infinite; };  ///< position: a direction where infinite
    std::optional<LightPoint> light_;
    struct LightChoice { Real u; int light; };
    std::optional<LightChoice> choice_;        ///< of a point that was not asked for yet
    std::optional<Vector3> shadowChain_;       ///< light of shadow rays that go through borders between media
};

/// The observer of this thread's current path, or null. Set while a path is traced that somebody wants to see.
Observer*& currentObserver();
/// What the next camera rays of this thread are instead of the camera's, or null: for light probes.
const Ray*& cameraRayOverride();

}  // namespace emca::lajolla
