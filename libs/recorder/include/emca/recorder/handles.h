#pragma once

#include <cstdint>

#include "emca/recorder/recorder.h"

namespace emca {

/// A vertex of a path by name, for renderers that advance many paths a stage at a time (wavefront). A plain value:
/// copy it, keep it in a queue, use it from any thread. Meaning of the calls: as in PathRecorder.
class VertexHandle {
  public:
    template <typename P> const VertexHandle& position(const P& p) const { at().setPosition(detail::toPosition(p)); return *this; }
    template <typename P> const VertexHandle& environment(const P& p) const { at().setEnvironmentPosition(detail::toPosition(p)); return *this; }
    template <typename P> const VertexHandle& nextEvent(const P& p, bool visible) const { at().addNextEvent(detail::toPosition(p), visible); return *this; }
    const VertexHandle& surface(std::int32_t mesh, std::int32_t face) const { at().setSurface(mesh, face); return *this; }
    const VertexHandle& event(Event event, Lobe lobe = Lobe::none, std::string_view label = {}) const { at().setEvent(event, lobe, label); return *this; }
    template <typename C> const VertexHandle& estimate(const C& c) const { at().setEstimate(detail::toColor(c)); return *this; }
    template <typename C> const VertexHandle& emission(const C& c) const { at().setEmission(detail::toColor(c)); return *this; }
    template <typename C>
    const VertexHandle& contribution(const C& c, std::string_view technique, float misWeight = std::numeric_limits<float>::quiet_NaN(),
                                     LightEnd end = LightEnd::automatic) const {
        at().addContribution(detail::toColor(c), technique, misWeight, end);
        return *this;
    }
    template <typename T> const VertexHandle& add(Key key, const T& value) const { at().addVertexData(key, detail::stored(value)); return *this; }

  private:
    friend class PathHandle;
    friend struct detail::BindingAccess;
    VertexHandle(const PathHandle& path, std::int32_t depth, Subpath subpath);
    detail::Cursor& at() const;
    Recording* recording_;
    Pixel pixel_;
    std::int64_t sample_;
    std::int32_t part_, depth_;
    Subpath subpath_;
};

/// A path by name; see VertexHandle.
class PathHandle {
  public:
    template <typename P> const PathHandle& origin(const P& p) const { at().setPathOrigin(detail::toPosition(p)); return *this; }
    template <typename C> const PathHandle& finalEstimate(const C& c) const { at().setFinalEstimate(detail::toColor(c)); return *this; }
    template <typename C> const PathHandle& splat(Pixel pixel, const C& c) const { at().addSplat(pixel, detail::toColor(c)); return *this; }
    template <typename T> const PathHandle& add(Key key, const T& value) const { at().addPathData(key, detail::stored(value)); return *this; }
    VertexHandle vertex(std::int32_t depth, Subpath subpath = Subpath::camera) const { return {*this, depth, subpath}; }

  private:
    friend class Recording;
    friend class VertexHandle;
    friend struct detail::BindingAccess;
    PathHandle(Recording& recording, Pixel pixel, std::int64_t sample, std::int32_t part)
        : recording_(&recording), pixel_(pixel), sample_(sample), part_(part) {}
    detail::Cursor& at() const;
    Recording* recording_;
    Pixel pixel_;
    std::int64_t sample_;
    std::int32_t part_;
};

inline VertexHandle::VertexHandle(const PathHandle& path, std::int32_t depth, Subpath subpath)
    : recording_(path.recording_), pixel_(path.pixel_), sample_(path.sample_), part_(path.part_), depth_(depth), subpath_(subpath) {}

}  // namespace emca
