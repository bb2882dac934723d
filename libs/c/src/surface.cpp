#include <bit>
#include <cstring>
#include <type_traits>

#include "emca/recorder/surface_recorder.h"
#include "layer_description.h"
#include "sized.h"

using namespace emca;

namespace {

// Points and layers cross the boundary as bytes; what is all zero is no place, or no layer.
static_assert(sizeof(SurfacePoint) <= sizeof(emca_surface_point) && std::is_trivially_copyable_v<SurfacePoint>);
static_assert(sizeof(SurfaceLayer) <= sizeof(emca_layer) && std::is_trivially_copyable_v<SurfaceLayer>);

template <typename To, typename From>
To packed(const From& from) {
    To to;
    std::memset(&to, 0, sizeof to);
    std::memcpy(static_cast<void*>(&to), &from, sizeof from);
    return to;
}
template <typename To, typename From>
To unpacked(const From& from) {
    To to;
    std::memcpy(static_cast<void*>(&to), &from, sizeof to);
    return to;
}

SurfaceRecorder& of(emca_surface* surface) { return *reinterpret_cast<SurfaceRecorder*>(surface); }
SurfaceCursor& of(emca_surface_cursor* cursor) { return *reinterpret_cast<SurfaceCursor*>(cursor); }

/// The inert layer has to be recognised in the header by its first word.
emca_layer handle(const SurfaceLayer& layer) { return layer ? packed<emca_layer>(layer) : emca_layer{{0}}; }

template <typename Value>
void add(const emca_layer& layer, const emca_surface_point* at, const Value& value) {
    if (layer.opaque[0] == 0) return;
    if (at == nullptr) return c::countMisuse("emca_layer_add", "its point is null.");
    c::quiet([&] { unpacked<SurfaceLayer>(layer).add(unpacked<SurfacePoint>(*at), value); });
}

}  // namespace

namespace emca::c {

Result<LayerDescription> description(const emca_layer_description* given) {
    const auto layer = sized(given, EMCA_SIZE_UP_TO(emca_layer_description, reserved), "emca_layer_description");
    if (!layer) return layer.error();
    if (layer->name == nullptr || *layer->name == '\0')
        return Error{ErrorCode::invalidArgument, "A surface layer has no name: requests address it by that."};
    if (layer->kind < EMCA_LAYER_MEAN || layer->kind > EMCA_LAYER_DENSITY)
        return Error{ErrorCode::invalidArgument, "The surface layer \"" + text(layer->name) + "\" is of kind " +
                                                     std::to_string(layer->kind) + ", but kinds are 0 to 3."};
    return LayerDescription{text(layer->name), static_cast<LayerKind>(layer->kind), text(layer->unit),
                            text(layer->description)};
}

}  // namespace emca::c

extern "C" {

emca_layer emca_find_layer(const emca_surface* surface, const char* name) {
    emca_layer layer = {{0}};
    if (surface == nullptr) return layer;
    if (name == nullptr) {
        c::countMisuse(__func__, "its name is null.");
        return layer;
    }
    c::quiet([&] { layer = handle(reinterpret_cast<const SurfaceRecorder*>(surface)->find(name)); });
    return layer;
}

emca_code emca_add_surface_layer(emca_surface* surface, const emca_layer_description* description, emca_layer* layer,
                                 emca_error* error) {
    if (layer != nullptr) *layer = emca_layer{{0}};
    if (surface == nullptr || layer == nullptr)
        return c::invalid(
            error,
            "emca_add_surface_layer needs the surface that render_image_with_layers got, and the address of a layer.");
    return c::guarded(error, [&]() -> emca_code {
        auto wanted = c::description(description);
        if (!wanted) return c::fail(error, wanted.error());
        const auto added = of(surface).addLayer(std::move(wanted).value());
        if (!added) return c::fail(error, added.error());
        *layer = handle(*added);
        return EMCA_OK;
    });
}

emca_surface_cursor* emca_thread_surface_cursor(emca_surface* surface) {
    emca_surface_cursor* cursor = nullptr;
    if (surface != nullptr) c::quiet([&] { cursor = reinterpret_cast<emca_surface_cursor*>(&of(surface).cursor()); });
    return cursor;
}

emca_surface_point emca_locate(emca_surface_cursor* cursor, uint32_t mesh, uint32_t face, emca_vec3f position) {
    emca_surface_point at = {{0}};
    if (cursor != nullptr)
        c::quiet([&] {
            at = packed<emca_surface_point>(of(cursor).locate(mesh, face, Vec3f{position.x, position.y, position.z}));
        });
    return at;
}

emca_surface_point emca_locate_barycentric(emca_surface_cursor* cursor, uint32_t mesh, uint32_t face,
                                           emca_vec2f barycentrics) {
    emca_surface_point at = {{0}};
    if (cursor != nullptr)
        c::quiet([&] {
            at = packed<emca_surface_point>(of(cursor).locate(mesh, face, Vec2f{barycentrics.x, barycentrics.y}));
        });
    return at;
}

void emca_layer_add(emca_layer layer, const emca_surface_point* at, float value) { add(layer, at, value); }
void emca_layer_add_color(emca_layer layer, const emca_surface_point* at, emca_color value) {
    add(layer, at, Color(value.r, value.g, value.b));
}

void emca_pass_done(emca_surface* surface, double part) {
    if (surface == nullptr) return;
    if (!(part > 0 && part < 1)) return c::countMisuse(__func__, "its part is not between 0 and 1.");
    c::quiet([&] { of(surface).passDone(part); });
}

}  // extern "C"
