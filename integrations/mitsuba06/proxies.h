#pragma once

#include <map>
#include <vector>

#include <mitsuba/render/emitter.h>
#include <mitsuba/render/phase.h>
#include <mitsuba/render/sampler.h>

#include "mitsuba_headers.h"

namespace emca::mitsuba06 {

/// While it lives, materials, emitters and phase functions of a scene are proxies that hand every call on to the
/// original and tell the thread's Observation, if there is one. Results are the originals', bit by bit.
class ObservedScene {
  public:
    /// No thread may render meanwhile; nor while it is destroyed.
    explicit ObservedScene(mts::Scene& scene);
    ~ObservedScene();
    ObservedScene(const ObservedScene&) = delete;
    ObservedScene& operator=(const ObservedScene&) = delete;

  private:
    void observe(mts::Shape& shape);

    mts::Scene& scene_;
    std::map<mts::BSDF*, mts::ref<mts::BSDF>> bsdfs_;  ///< original, proxy
    std::map<mts::Emitter*, mts::ref<mts::Emitter>> emitters_;
    struct ShapeBefore {
        mts::Shape* shape;
        mts::ref<mts::BSDF> bsdf;
        mts::ref<mts::Emitter> emitter;
    };
    std::vector<ShapeBefore> shapes_;
    mts::ref_vector<mts::Emitter> emitterList_;  ///< the scene's own
    mts::ref<mts::Emitter> environment_;         ///< likewise
    std::vector<std::pair<mts::Medium*, mts::ref<mts::PhaseFunction>>> phases_;
};

/// A sampler that hands the numbers of another one on and tells the thread's Observation. Valid for one sample of the
/// other, which must outlive it.
mts::ref<mts::Sampler> observed(mts::Sampler& sampler);

}  // namespace emca::mitsuba06
