#include "hit_watch.h"

#include "inside.h"

namespace emca::pbrt4 {

namespace {

constinit thread_local HitWatch* watch = nullptr;

using Hit = pstd::optional<pbrt::ShapeIntersection>;

}  // namespace

// Free functions with the object as first parameter have the calling convention of its member functions (Itanium C++
// ABI, section 3.1). The names are the build's: CMakeLists.txt reads them from the library.
Hit realIntersect(const pbrt::Primitive* self, const pbrt::Ray& ray,
                  pbrt::Float tMax) asm("__real_" EMCA_PBRT_INTERSECT);
bool realIntersectP(const pbrt::Primitive* self, const pbrt::Ray& ray,
                    pbrt::Float tMax) asm("__real_" EMCA_PBRT_INTERSECT_P);
pbrt::BSDF realGetBsdf(pbrt::SurfaceInteraction* self, const pbrt::RayDifferential& ray,
                       pbrt::SampledWavelengths& lambda, pbrt::Camera camera, pbrt::ScratchBuffer& scratch,
                       pbrt::Sampler sampler) asm("__real_" EMCA_PBRT_GET_BSDF);

Hit wrapIntersect(const pbrt::Primitive* self, const pbrt::Ray& ray,
                  pbrt::Float tMax) asm("__wrap_" EMCA_PBRT_INTERSECT);
bool wrapIntersectP(const pbrt::Primitive* self, const pbrt::Ray& ray,
                    pbrt::Float tMax) asm("__wrap_" EMCA_PBRT_INTERSECT_P);
pbrt::BSDF wrapGetBsdf(pbrt::SurfaceInteraction* self, const pbrt::RayDifferential& ray,
                       pbrt::SampledWavelengths& lambda, pbrt::Camera camera, pbrt::ScratchBuffer& scratch,
                       pbrt::Sampler sampler) asm("__wrap_" EMCA_PBRT_GET_BSDF);

/// What is done at the calls that the linker sends here.
struct WrappedCalls {
    /// The scene's ray: all of its primitives are tested in here, those of a BVH by calls that come here too.
    static Hit traceScene(HitWatch& w, const pbrt::Primitive& scene, const pbrt::Ray& ray, pbrt::Float tMax) {
        w.hit_ = {};
        // A scene of one primitive has no aggregate around it.
        const Hit hit = tracePart(w, scene, ray, tMax);
        if (w.watcher_) w.watcher_->traced(ray, tMax, hit ? &hit->intr : nullptr, w.hit_);
        return hit;
    }

    /// A hit that a primitive returns is nearer than those before, since aggregates shorten the ray.
    static Hit tracePart(HitWatch& w, const pbrt::Primitive& part, const pbrt::Ray& ray, pbrt::Float tMax) {
        if (inside::isLeaf(part)) {
            Hit hit = realIntersect(&part, ray, tMax);
            if (hit) w.hit_ = {part, {}};
            return hit;
        }
        if (!inside::isInstance(part)) return realIntersect(&part, ray, tMax);

        const HitChain before = w.hit_;
        w.hit_ = {};
        Hit hit = realIntersect(&part, ray, tMax);
        if (!hit) {
            w.hit_ = before;
            return hit;
        }
        // What an instance places it calls directly: if that is no aggregate, nothing came here.
        pbrt::Primitive end = inside::placed(part), middle = w.hit_.instances[0];
        if (inside::isInstance(end)) {
            middle = end;
            end = inside::placed(end);
        }
        w.hit_ = {w.hit_.leaf ? w.hit_.leaf : end, {part, middle}};
        return hit;
    }

    static Hit intersect(HitWatch& w, const pbrt::Primitive& primitive, const pbrt::Ray& ray, pbrt::Float tMax) {
        return primitive == w.scene_ ? traceScene(w, primitive, ray, tMax) : tracePart(w, primitive, ray, tMax);
    }
    static bool intersectP(HitWatch& w, const pbrt::Primitive& primitive, const pbrt::Ray& ray, pbrt::Float tMax) {
        // What is behind an alpha texture is found by tracing: that is no hit of the path.
        const HitChain before = w.hit_;
        const bool blocked = realIntersectP(&primitive, ray, tMax);
        w.hit_ = before;
        if (w.watcher_ && primitive == w.scene_) w.watcher_->tested(ray, tMax, blocked);
        return blocked;
    }
    static void bsdf(HitWatch& w, const pbrt::SurfaceInteraction& at, const pbrt::BSDF& made) {
        if (w.watcher_) w.watcher_->scattersBy(at, made);
    }
};

// Apart from what nobody watches, which is to be a test and a jump: it comes for every shape that a ray may hit.
[[gnu::noinline]] static Hit watchedIntersect(const pbrt::Primitive* self, const pbrt::Ray& ray, pbrt::Float tMax) {
    return WrappedCalls::intersect(*watch, *self, ray, tMax);
}
[[gnu::noinline]] static bool watchedIntersectP(const pbrt::Primitive* self, const pbrt::Ray& ray, pbrt::Float tMax) {
    return WrappedCalls::intersectP(*watch, *self, ray, tMax);
}

Hit wrapIntersect(const pbrt::Primitive* self, const pbrt::Ray& ray, pbrt::Float tMax) {
    return watch == nullptr ? realIntersect(self, ray, tMax) : watchedIntersect(self, ray, tMax);
}

bool wrapIntersectP(const pbrt::Primitive* self, const pbrt::Ray& ray, pbrt::Float tMax) {
    return watch == nullptr ? realIntersectP(self, ray, tMax) : watchedIntersectP(self, ray, tMax);
}

pbrt::BSDF wrapGetBsdf(pbrt::SurfaceInteraction* self, const pbrt::RayDifferential& ray,
                       pbrt::SampledWavelengths& lambda, pbrt::Camera camera, pbrt::ScratchBuffer& scratch,
                       pbrt::Sampler sampler) {
    pbrt::BSDF made = realGetBsdf(self, ray, lambda, camera, scratch, sampler);
    if (watch != nullptr) [[unlikely]]
        WrappedCalls::bsdf(*watch, *self, made);
    return made;
}

HitWatch::HitWatch(pbrt::Primitive scene, RayWatcher* watcher) : scene_(scene), watcher_(watcher) { watch = this; }

HitWatch::~HitWatch() { watch = nullptr; }

bool HitWatch::works(pbrt::Primitive scene, const pbrt::Ray& ray) {
    const HitWatch seen(scene, nullptr);
    return scene.Intersect(ray, pbrt::Infinity).has_value() && bool(seen.lastHit().leaf);
}

}  // namespace emca::pbrt4
