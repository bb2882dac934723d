#include "emca/recorder/recorder.h"

#include <atomic>
#include <cstring>

#include "emca/recorder/handles.h"
#include "recording_handle.h"

namespace emca::detail {

/// What the C++ interface keeps to itself.
struct BindingAccess {
    static void place(PathRecorder& recorder, Cursor& cursor) { recorder.cursor_ = &cursor; }
    static Cursor& at(const PathHandle& path) { return path.at(); }
    static Cursor& at(const VertexHandle& vertex) { return vertex.at(); }
};

}  // namespace emca::detail

using namespace emca;
using c::color;
using c::countMisuse;
using c::pixel;
using c::quiet;
using c::vec;

namespace {

/// Of the calling thread, for emca_at_path and emca_at_vertex.
constinit thread_local PathRecorder placedRecorder;

PathRecorder& of(emca_recorder* recorder) { return *reinterpret_cast<PathRecorder*>(recorder); }
emca_recorder* handle(PathRecorder& recorder) { return reinterpret_cast<emca_recorder*>(&recorder); }

bool isKnown(emca_key& key) { return std::atomic_ref(key.hash).load(std::memory_order_acquire) != 0; }

/// Of a known key.
Key known(emca_key& key) {
    const std::uint32_t length = std::atomic_ref(key.length).load(std::memory_order_relaxed);
    const std::uint64_t hash = std::atomic_ref(key.hash).load(std::memory_order_relaxed);
    return {std::string_view(key.text, length), hash, SourceLine(key.file == nullptr ? "" : key.file, key.line)};
}

/// A key's length and hash at its first use. Several threads may do so at once: they find the same. False if it is
/// none.
bool complete(emca_key* key, const char* function) {
    if (key == nullptr || key->text == nullptr) {
        countMisuse(function, "its key, or the key's text, is null.");
        return false;
    }
    const std::string_view text(key->text);
    const std::uint64_t hash = hashKey(text);
    std::atomic_ref(key->length).store(static_cast<std::uint32_t>(text.size()), std::memory_order_relaxed);
    std::atomic_ref(key->hash).store(hash == 0 ? 1 : hash, std::memory_order_release);
    return true;
}

}  // namespace

// Of one call: nothing without a recorder, nothing thrown.
#define EMCA_RECORD(call)            \
    if (recorder == nullptr) return; \
    quiet([&] { of(recorder).call; })

extern "C" {

emca_recorder* emca_thread_recorder(void) {
    PathRecorder& here = recorder();
    return here.isRecording() ? handle(here) : nullptr;
}

void emca_set_pixel(emca_recorder* recorder, emca_pixel at) { EMCA_RECORD(setPixel(pixel(at))); }
void emca_clear_pixel(emca_recorder* recorder) { EMCA_RECORD(clearPixel()); }
void emca_set_path_index(emca_recorder* recorder, int64_t sample, int32_t part) {
    EMCA_RECORD(setPathIndex(sample, part));
}
void emca_set_path_origin(emca_recorder* recorder, emca_vec3f origin) { EMCA_RECORD(setPathOrigin(vec(origin))); }
void emca_end_path(emca_recorder* recorder) { EMCA_RECORD(endPath()); }
void emca_set_final_estimate(emca_recorder* recorder, emca_color estimate) {
    EMCA_RECORD(setFinalEstimate(color(estimate)));
}
void emca_add_splat(emca_recorder* recorder, emca_pixel at, emca_color value) {
    EMCA_RECORD(addSplat(pixel(at), color(value)));
}

void emca_set_depth_index(emca_recorder* recorder, int32_t depth, emca_subpath subpath) {
    if (recorder != nullptr && (subpath < EMCA_CAMERA_SUBPATH || subpath > EMCA_LIGHT_SUBPATH))
        return countMisuse(__func__, "its subpath is neither the camera's nor the light's.");
    EMCA_RECORD(setDepthIndex(depth, static_cast<Subpath>(subpath)));
}
void emca_set_intersection_pos(emca_recorder* recorder, emca_vec3f position) {
    EMCA_RECORD(setIntersectionPos(vec(position)));
}
void emca_set_intersection_pos_envmap(emca_recorder* recorder, emca_vec3f position) {
    EMCA_RECORD(setIntersectionPosEnvmap(vec(position)));
}
void emca_set_next_event_estimation_pos(emca_recorder* recorder, emca_vec3f position, bool visible) {
    EMCA_RECORD(setNextEventEstimationPos(vec(position), visible));
}
void emca_set_intersection_surface(emca_recorder* recorder, int64_t mesh, int64_t face) {
    constexpr std::int64_t kMost = 0x7fffffff;
    if (recorder != nullptr && (mesh < 0 || mesh > kMost || face < 0 || face > kMost))
        return countMisuse(__func__, "its mesh or face is negative or larger than 2147483647.");
    EMCA_RECORD(setIntersectionSurface(mesh, face));
}
void emca_set_intersection_event(emca_recorder* recorder, emca_event event, emca_lobe lobe, const char* label) {
    if (recorder != nullptr &&
        (event < EMCA_EVENT_NONE || event > EMCA_PASS || lobe < EMCA_LOBE_NONE || lobe > EMCA_STRAIGHT))
        return countMisuse(__func__, "its event is not in 0 to 7 or its lobe not in 0 to 4.");
    EMCA_RECORD(
        setIntersectionEvent(static_cast<Event>(event), static_cast<Lobe>(lobe), label == nullptr ? "" : label));
}
void emca_set_intersection_estimate(emca_recorder* recorder, emca_color estimate) {
    EMCA_RECORD(setIntersectionEstimate(color(estimate)));
}
void emca_set_intersection_emission(emca_recorder* recorder, emca_color emission) {
    EMCA_RECORD(setIntersectionEmission(color(emission)));
}
void emca_add_contribution(emca_recorder* recorder, emca_color value, const char* technique, float misWeight,
                           emca_light_end end) {
    if (recorder != nullptr && (end < EMCA_LIGHT_AUTOMATIC || end > EMCA_LIGHT_CONNECTED))
        return countMisuse(__func__, "its light end is not in 0 to 2.");
    EMCA_RECORD(
        addContribution(color(value), technique == nullptr ? "" : technique, misWeight, static_cast<LightEnd>(end)));
}

emca_key emca_make_key(const char* text) {
    const char* const given = text == nullptr ? "" : text;
    emca_key key = {given, nullptr, 0, 0, 0};
    complete(&key, __func__);
    return key;
}

// What is rare is a function of its own, so that the common way needs no room on the stack.
#define EMCA_CALL(name, record, suffix, Type, stored)                                                     \
    [[gnu::noinline, gnu::cold]] static void name##suffix##_first(emca_recorder* recorder, emca_key* key, \
                                                                  Type value) {                           \
        if (complete(key, #name #suffix)) name##suffix(recorder, key, value);                             \
    }                                                                                                     \
    void name##suffix(emca_recorder* recorder, emca_key* key, Type value) {                               \
        if (recorder == nullptr) return;                                                                  \
        if (key == nullptr || !isKnown(*key)) [[unlikely]]                                                \
            return name##suffix##_first(recorder, key, value);                                            \
        quiet([&] { of(recorder).record(known(*key), stored); });                                         \
    }
#define EMCA_DATA(suffix, Type, stored)                          \
    EMCA_CALL(emca_add_path_, addPathData, suffix, Type, stored) \
    EMCA_CALL(emca_add_intersection_, addIntersectionData, suffix, Type, stored)
EMCA_DATA(bool, bool, value)
EMCA_DATA(int, int64_t, std::int64_t(value))
EMCA_DATA(int2, emca_vec2i, (Vec2i{value.x, value.y}))
EMCA_DATA(int3, emca_vec3i, (Vec3i{value.x, value.y, value.z}))
EMCA_DATA(float, float, value)
EMCA_DATA(float2, emca_vec2f, (Vec2f{value.x, value.y}))
EMCA_DATA(float3, emca_vec3f, (Vec3f{value.x, value.y, value.z}))
EMCA_DATA(double, double, value)
EMCA_DATA(double2, emca_vec2d, (Vec2d{value.x, value.y}))
EMCA_DATA(double3, emca_vec3d, (Vec3d{value.x, value.y, value.z}))
EMCA_DATA(color, emca_color, color(value))
EMCA_DATA(color_a, emca_color_a, (ColorA{value.r, value.g, value.b, value.a}))
EMCA_DATA(text, const char*, std::string_view(value == nullptr ? "" : value))
#undef EMCA_DATA
#undef EMCA_CALL

void emca_add_path_spectrum(emca_recorder* recorder, emca_key* key, const float* values, size_t count) {
    if (recorder == nullptr || ((key == nullptr || !isKnown(*key)) && !complete(key, __func__))) return;
    if (values == nullptr && count > 0) return countMisuse(__func__, "its values are null.");
    quiet([&] { of(recorder).addPathData(known(*key), std::span<const float>(values, count)); });
}
void emca_add_intersection_spectrum(emca_recorder* recorder, emca_key* key, const float* values, size_t count) {
    if (recorder == nullptr || ((key == nullptr || !isKnown(*key)) && !complete(key, __func__))) return;
    if (values == nullptr && count > 0) return countMisuse(__func__, "its values are null.");
    quiet([&] { of(recorder).addIntersectionData(known(*key), std::span<const float>(values, count)); });
}

emca_recorder* emca_at_path(emca_recording* recording, emca_pixel at, int64_t sample, int32_t part) {
    if (recording == nullptr || recording->finished) return nullptr;
    emca_recorder* result = nullptr;
    quiet([&] {
        detail::BindingAccess::place(placedRecorder,
                                     detail::BindingAccess::at(recording->recording->path(pixel(at), sample, part)));
        result = handle(placedRecorder);
    });
    return result;
}

emca_recorder* emca_at_vertex(emca_recording* recording, emca_pixel at, int64_t sample, int32_t part, int32_t depth,
                              emca_subpath subpath) {
    if (recording == nullptr || recording->finished) return nullptr;
    if (subpath < EMCA_CAMERA_SUBPATH || subpath > EMCA_LIGHT_SUBPATH) {
        countMisuse(__func__, "its subpath is neither the camera's nor the light's.");
        return nullptr;
    }
    emca_recorder* result = nullptr;
    quiet([&] {
        const PathHandle path = recording->recording->path(pixel(at), sample, part);
        detail::BindingAccess::place(placedRecorder,
                                     detail::BindingAccess::at(path.vertex(depth, static_cast<Subpath>(subpath))));
        result = handle(placedRecorder);
    });
    return result;
}

}  // extern "C"
