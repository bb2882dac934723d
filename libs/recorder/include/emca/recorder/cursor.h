#pragma once

#include <cstdint>
#include <span>
#include <string_view>

#include "emca/core/color.h"
#include "emca/core/event.h"
#include "emca/core/path_set.h"
#include "emca/core/pixel.h"
#include "emca/core/vector.h"
#include "emca/recorder/key.h"

/// What stands behind the inline calls of PathRecorder and of the handles. Renderers do not call it.
namespace emca::detail {

/// One thread's place in a recording. All functions: only by the thread that holds it.
class Cursor {
  public:
    void setPixel(Pixel pixel);
    void clearPixel();
    void setPathIndex(std::int64_t sample, std::int32_t part);
    void endPath();
    void setPathOrigin(Vec3f origin);
    void setFinalEstimate(Color estimate);
    void addSplat(Pixel pixel, Color value);

    void setDepthIndex(std::int32_t depth, Subpath subpath);
    void setPosition(Vec3f position);
    void setEnvironmentPosition(Vec3f position);
    void addNextEvent(Vec3f position, bool visible);
    void setSurface(std::int32_t mesh, std::int32_t face);
    void setEvent(Event event, Lobe lobe, std::string_view label);
    void setEstimate(Color estimate);
    void setEmission(Color emission);
    void addContribution(Color value, std::string_view technique, float misWeight, LightEnd end);

    /// T: one of the stored types of recordable.h.
    template <typename T>
    void addPathData(const Key& key, const T& value);
    template <typename T>
    void addVertexData(const Key& key, const T& value);

  protected:
    Cursor() = default;
    ~Cursor() = default;
    Cursor(const Cursor&) = delete;
    Cursor& operator=(const Cursor&) = delete;
};

}  // namespace emca::detail
