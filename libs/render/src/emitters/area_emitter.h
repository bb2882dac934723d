#pragma once

#include <memory>

#include "emca/render/emitter.h"
#include "emca/render/shape.h"
#include "emca/render/texture.h"

namespace emca::render {

/// A shape whose front emits the same radiance in all directions.
class AreaEmitter final : public Emitter {
  public:
    /// \param shape  must outlive the emitter
    AreaEmitter(const Shape& shape, std::shared_ptr<const Texture> radiance);

    std::optional<EmitterSample> sample(Vec3f from, Vec2f u) const override;
    bool isDelta() const override { return false; }
    float power() const override;
    Color emitted(const SurfaceInteraction& at, Vec3f direction) const override;
    float pdf(Vec3f from, Vec3f direction, float distance, const SurfaceInteraction& at) const override;
    Color displayRadiance() const override { return mean_; }

  private:
    const Shape& shape_;
    std::shared_ptr<const Texture> radiance_;
    Color mean_;
    bool constant_;
};

}  // namespace emca::render
