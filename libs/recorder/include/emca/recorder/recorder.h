#pragma once

#include <cstdint>
#include <limits>
#include <string_view>
#include <type_traits>
#include <utility>

#include "emca/recorder/cursor.h"
#include "emca/recorder/key.h"
#include "emca/recorder/recordable.h"
#include "emca/recorder/recording.h"

namespace emca {

/// What a renderer calls in its loop: Algorithm 1 of the paper (section 4). Outside a RecordScope every call is one
/// inline branch, evaluates no callable and stores nothing; the image is the same bit by bit.
///
/// Indices are identifiers, stored as given: they may start anywhere and have gaps. Only the indices are needed, all
/// else may be missing. Values before any path or vertex are dropped and counted. Positions: world space, scene units;
/// radiance: linear Rec. 709. Where a value is expected, a callable without arguments that returns it may stand: it
/// runs only while recording. A renderer's own vector and colour types are accepted as they are (recordable.h).
template <bool Enabled>
class BasicPathRecorder {
  public:
    constexpr BasicPathRecorder() = default;

    /// True inside a RecordScope.
    bool isRecording() const {
        if (Enabled && cursor_ != nullptr) [[unlikely]] return true;
        return false;
    }

    /// The pixel that the next paths belong to; a RecordScope sets it.
    void setPixel(Pixel pixel) { if (isRecording()) cursor_->setPixel(pixel); }
    /// The next paths belong to no pixel: light paths, kept if they splat on a pixel that was asked for.
    void clearPixel() { if (isRecording()) cursor_->clearPixel(); }
    /// Begins a path. \param part  0 unless a sample splits into several paths.
    void setPathIndex(std::int64_t sample, std::int32_t part = 0) { if (isRecording()) cursor_->setPathIndex(sample, part); }
    template <typename P>
    void setPathOrigin(const P& origin) { if (isRecording()) cursor_->setPathOrigin(detail::toPosition(detail::resolved(origin))); }
    /// Ends the path; so does the next setPathIndex and the end of the scope.
    void endPath() { if (isRecording()) cursor_->endPath(); }
    /// The path's value before division by samples per pixel.
    template <typename C>
    void setFinalEstimate(const C& estimate) { if (isRecording()) cursor_->setFinalEstimate(detail::toColor(detail::resolved(estimate))); }
    /// Light that this path adds to any pixel of the film, in the film's units.
    template <typename C>
    void addSplat(Pixel pixel, const C& value) { if (isRecording()) cursor_->addSplat(pixel, detail::toColor(detail::resolved(value))); }

    /// Begins a vertex or continues the one of that depth. Depth 0 is the camera (or the light), 1 the first hit.
    void setDepthIndex(std::int32_t depth, Subpath subpath = Subpath::camera) { if (isRecording()) cursor_->setDepthIndex(depth, subpath); }
    template <typename P>
    void setIntersectionPos(const P& position) { if (isRecording()) cursor_->setPosition(detail::toPosition(detail::resolved(position))); }
    /// The path left the scene towards `position`. An environment hit is a vertex of its own: if this one has a
    /// position already, the hit gets the next depth.
    template <typename P>
    void setIntersectionPosEnvmap(const P& position) { if (isRecording()) cursor_->setEnvironmentPosition(detail::toPosition(detail::resolved(position))); }
    /// One shadow test; several at one vertex are kept in call order.
    template <typename P>
    void setNextEventEstimationPos(const P& position, bool visible) { if (isRecording()) cursor_->addNextEvent(detail::toPosition(detail::resolved(position)), visible); }
    /// Place in the renderer's mesh list and triangle of that mesh.
    void setIntersectionSurface(std::int64_t mesh, std::int64_t face) {
        if (isRecording()) cursor_->setSurface(static_cast<std::int32_t>(mesh), static_cast<std::int32_t>(face));
    }
    /// What happened here, for light path expressions. \param label  e.g. the material's name; text or callable.
    template <typename L = std::string_view>
    void setIntersectionEvent(Event event, Lobe lobe = Lobe::none, const L& label = {}) {
        if (isRecording()) cursor_->setEvent(event, lobe, std::string_view(detail::resolved(label)));
    }
    /// Camera-weighted running sum of the path up to here.
    template <typename C>
    void setIntersectionEstimate(const C& estimate) { if (isRecording()) cursor_->setEstimate(detail::toColor(detail::resolved(estimate))); }
    /// Unweighted emitted radiance towards the path.
    template <typename C>
    void setIntersectionEmission(const C& emission) { if (isRecording()) cursor_->setEmission(detail::toColor(detail::resolved(emission))); }
    /// Light that one technique added here, weighted by the camera path and by `misWeight` (NaN: not said).
    template <typename C>
    void addContribution(const C& value, std::string_view technique, float misWeight = std::numeric_limits<float>::quiet_NaN(),
                         LightEnd end = LightEnd::automatic) {
        if (isRecording()) cursor_->addContribution(detail::toColor(detail::resolved(value)), technique, misWeight, end);
    }
    // The key is copied behind the branch: were its own address passed on, compilers would fill it in before asking.
    /// Any value under any name; repeated names are kept in call order.
    template <typename T>
    void addIntersectionData(Key key, const T& value) { if (isRecording() && cursor_->wantsUserData()) cursor_->addVertexData(Key(key), detail::stored(detail::resolved(value))); }
    template <typename T>
    void addPathData(Key key, const T& value) { if (isRecording() && cursor_->wantsUserData()) cursor_->addPathData(Key(key), detail::stored(detail::resolved(value))); }

  private:
    friend class RecordScope;
    friend struct detail::BindingAccess;
    detail::Cursor* cursor_ = nullptr;
};

namespace detail {
extern constinit thread_local BasicPathRecorder<true> threadRecorder;
}

/// This thread's recorder: fetch it once per pixel or path. With EMCA_DISABLED defined, all its calls compile away.
#ifdef EMCA_DISABLED
inline namespace recording_disabled {
using PathRecorder = BasicPathRecorder<false>;
inline constinit PathRecorder disabledRecorder;
inline PathRecorder& recorder() { return disabledRecorder; }
}  // namespace recording_disabled
#else
inline namespace recording_enabled {
using PathRecorder = BasicPathRecorder<true>;
inline PathRecorder& recorder() { return detail::threadRecorder; }
}  // namespace recording_enabled
#endif

}  // namespace emca
