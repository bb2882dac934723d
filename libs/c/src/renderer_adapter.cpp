#include "renderer_adapter.h"

#include <stdexcept>

#include "emca/recorder/surface_recorder.h"
#include "layer_description.h"
#include "recording_handle.h"
#include "sized.h"

struct emca_mesh_list {
    std::vector<emca::Mesh> meshes;
};
struct emca_layer_list {
    std::vector<emca::LayerDescription> layers;
};

namespace emca::c {
namespace {

emca_settings toC(const RenderSettings& settings) {
    emca_settings made = filled<emca_settings>();
    made.samples_per_pixel = settings.samplesPerPixel;
    made.has_seed = settings.hasSeed;
    made.seed = settings.seed;
    made.integrator = settings.integrator.c_str();
    made.sampler = settings.sampler.c_str();
    return made;
}

/// Where the interface has no room for errors: the server makes error replies of exceptions.
void throwIfFailed(emca_code code, const emca_error& error, const char* function) {
    if (code != EMCA_OK) throw std::runtime_error(errorOf(code, error, function).message);
}

// The caller's colours are ours.
static_assert(sizeof(emca_color) == sizeof(Color) && sizeof(emca_pixel) == sizeof(Pixel) &&
              sizeof(emca_vec3f) == sizeof(Vec3f));

}  // namespace

Result<emca_renderer> checkedRenderer(const emca_renderer* given) {
    auto renderer = sized(given, EMCA_SIZE_UP_TO(emca_renderer, render_pixel), "emca_renderer");
    if (!renderer) return renderer;
    const auto missing = [](const char* function) {
        return Error{ErrorCode::invalidArgument,
                     std::string("emca_renderer has no function ") + function + ": it is needed."};
    };
    if (!renderer->info) return missing("info");
    if (!renderer->camera) return missing("camera");
    if (!renderer->meshes) return missing("meshes");
    if (!renderer->render_image) return missing("render_image");
    if (!renderer->render_pixel) return missing("render_pixel");
    if (!renderer->surface_layers != !renderer->render_image_with_layers)
        return Error{ErrorCode::invalidArgument,
                     "emca_renderer has only one of surface_layers and render_image_with_layers: give both or none."};
    return renderer;
}

RendererInfo FunctionRenderer::info() const {
    emca_info given = filled<emca_info>();
    given.samples_per_pixel = 1;
    given.deterministic = 1;
    emca_error error{};
    throwIfFailed(c_.info(c_.user, &given, &error), error, "info");
    RendererInfo info;
    info.renderer = text(given.renderer);
    info.scene = text(given.scene);
    info.integrator = text(given.integrator);
    info.sampler = text(given.sampler);
    info.seed = given.seed;
    info.width = width_ = given.width;
    info.height = height_ = given.height;
    info.samplesPerPixel = given.samples_per_pixel;
    info.threads = given.threads;
    info.concurrent = given.concurrent != 0;
    info.deterministic = given.deterministic != 0;
    info.pathsReachAnyPixel = given.paths_reach_any_pixel != 0;
    if (given.capability_count > 0 && given.capabilities == nullptr)
        throw std::runtime_error("Its info announces capabilities, but the list of them is null.");
    for (std::uint32_t i = 0; i < given.capability_count; ++i) info.capabilities.push_back(text(given.capabilities[i]));
    return info;
}

Camera FunctionRenderer::camera() const {
    emca_camera given = filled<emca_camera>();
    const Camera usual;
    given.kind = static_cast<emca_camera_kind>(usual.kind);
    given.right_handed = usual.rightHanded;
    given.direction = {usual.direction.x, usual.direction.y, usual.direction.z};
    given.up = {usual.up.x, usual.up.y, usual.up.z};
    given.vertical_field_of_view = usual.verticalFieldOfView;
    given.near_clip = usual.nearClip;
    given.far_clip = usual.farClip;
    emca_error error{};
    throwIfFailed(c_.camera(c_.user, &given, &error), error, "camera");
    if (given.kind < EMCA_PERSPECTIVE || given.kind > EMCA_OTHER_CAMERA)
        throw std::runtime_error("Its camera is of kind " + std::to_string(given.kind) + ", but kinds are 0 to 3.");
    return {.kind = static_cast<CameraKind>(given.kind),
            .position = vec(given.position),
            .direction = vec(given.direction),
            .up = vec(given.up),
            .verticalFieldOfView = given.vertical_field_of_view,
            .nearClip = given.near_clip,
            .farClip = given.far_clip,
            .focusDistance = given.focus_distance,
            .apertureRadius = given.aperture_radius,
            .rightHanded = given.right_handed != 0};
}

std::vector<Mesh> FunctionRenderer::meshes() const {
    emca_mesh_list list;
    emca_error error{};
    throwIfFailed(c_.meshes(c_.user, &list, &error), error, "meshes");
    return std::move(list.meshes);
}

std::vector<LayerDescription> FunctionRenderer::surfaceLayers() const {
    emca_layer_list list;
    if (!c_.surface_layers) return {};
    emca_error error{};
    throwIfFailed(c_.surface_layers(c_.user, &list, &error), error, "surface_layers");
    return std::move(list.layers);
}

template <typename Call>
Result<RenderedImage> FunctionRenderer::image(const char* function, const RenderSettings& settings, const Call& call) {
    RenderedImage rendered{.color = Image(width_, height_),
                           .samples = Image(width_, height_, {"samples"}),
                           .variance = Image(width_, height_)};
    emca_image given = filled<emca_image>();
    given.width = width_;
    given.height = height_;
    given.color = reinterpret_cast<emca_color*>(rendered.color.data());
    given.samples = rendered.samples.data();
    given.variance = reinterpret_cast<emca_color*>(rendered.variance.data());
    const emca_settings asked = toC(settings);
    emca_error error{};
    if (const emca_code code = call(&asked, &given, &error); code != EMCA_OK) return errorOf(code, error, function);
    if (given.has_samples == 0) rendered.samples = Image();
    if (given.has_variance == 0) rendered.variance = Image();
    reportMisuse();
    return rendered;
}

Result<RenderedImage> FunctionRenderer::renderImage(const RenderSettings& settings, RequestMonitor& monitor) {
    return image("render_image", settings, [&](const emca_settings* asked, emca_image* given, emca_error* error) {
        return c_.render_image(c_.user, asked, handle(monitor), given, error);
    });
}

Result<RenderedImage> FunctionRenderer::renderImageWithLayers(const RenderSettings& settings, SurfaceRecorder& surface,
                                                              RequestMonitor& monitor) {
    if (!c_.render_image_with_layers) return Renderer::renderImageWithLayers(settings, surface, monitor);
    return image("render_image_with_layers", settings,
                 [&](const emca_settings* asked, emca_image* given, emca_error* error) {
                     return c_.render_image_with_layers(c_.user, asked, reinterpret_cast<emca_surface*>(&surface),
                                                        handle(monitor), given, error);
                 });
}

Result<Color> FunctionRenderer::renderPixel(Pixel pixel, const RenderSettings& settings, Recording& recording,
                                            RequestMonitor& monitor) {
    const emca_settings asked = toC(settings);
    emca_recording sink(recording);
    emca_color value{};
    emca_error error{};
    const emca_code code = c_.render_pixel(c_.user, {pixel.x, pixel.y}, &asked, &sink, handle(monitor), &value, &error);
    reportMisuse();
    if (code != EMCA_OK) return errorOf(code, error, "render_pixel");
    return color(value);
}

Result<std::vector<Color>> FunctionRenderer::renderPixels(const std::vector<Pixel>& pixels,
                                                          const RenderSettings& settings, Recording& recording,
                                                          RequestMonitor& monitor) {
    if (!c_.render_pixels) return Renderer::renderPixels(pixels, settings, recording, monitor);
    const emca_settings asked = toC(settings);
    emca_recording sink(recording);
    std::vector<Color> values(pixels.size());
    emca_error error{};
    const emca_code code =
        c_.render_pixels(c_.user, reinterpret_cast<const emca_pixel*>(pixels.data()), pixels.size(), &asked, &sink,
                         handle(monitor), reinterpret_cast<emca_color*>(values.data()), &error);
    reportMisuse();
    if (code != EMCA_OK) return errorOf(code, error, "render_pixels");
    return values;
}

/// Once is enough: the sentence is about the first call of all.
void FunctionRenderer::reportMisuse() {
    if (misuses() == 0 || !log_ || misuseReported_.exchange(true)) return;
    emca_error first{};
    emca_misuse(&first);
    log_(first.message);
}

}  // namespace emca::c

using namespace emca;

extern "C" {

emca_code emca_add_mesh(emca_mesh_list* list, const emca_mesh* given, emca_error* error) {
    if (list == nullptr) return c::invalid(error, "emca_add_mesh needs the list that the function `meshes` got.");
    return c::guarded(error, [&]() -> emca_code {
        const auto mesh = c::sized(given, EMCA_SIZE_UP_TO(emca_mesh, emission), "emca_mesh");
        if (!mesh) return c::fail(error, mesh.error());
        if ((mesh->positions == nullptr && mesh->position_count > 0) ||
            (mesh->triangles == nullptr && mesh->triangle_count > 0))
            return c::invalid(error, "A mesh announces vertices or triangles, but the pointer to them is null.");
        Mesh copy{.name = c::text(mesh->name),
                  .material = c::text(mesh->material),
                  .diffuse = c::color(mesh->diffuse),
                  .emission = c::color(mesh->emission)};
        copy.positions.reserve(mesh->position_count);
        for (std::uint64_t i = 0; i < mesh->position_count; ++i) copy.positions.push_back(c::vec(mesh->positions[i]));
        copy.triangles.reserve(mesh->triangle_count);
        for (std::uint64_t i = 0; i < mesh->triangle_count; ++i)
            copy.triangles.push_back({mesh->triangles[3 * i], mesh->triangles[3 * i + 1], mesh->triangles[3 * i + 2]});
        if (const auto valid = validate(copy); !valid) return c::fail(error, valid.error());
        list->meshes.push_back(std::move(copy));
        return EMCA_OK;
    });
}

emca_code emca_add_layer(emca_layer_list* list, const emca_layer_description* layer, emca_error* error) {
    if (list == nullptr)
        return c::invalid(error, "emca_add_layer needs the list that the function `surface_layers` got.");
    return c::guarded(error, [&]() -> emca_code {
        auto checked = c::description(layer);
        if (!checked) return c::fail(error, checked.error());
        list->layers.push_back(std::move(checked).value());
        return EMCA_OK;
    });
}

bool emca_cancelled(const emca_monitor* monitor) {
    return monitor != nullptr && reinterpret_cast<const RequestMonitor*>(monitor)->cancelled();
}

void emca_progress(emca_monitor* monitor, double fraction) {
    if (monitor != nullptr) c::quiet([&] { c::of(monitor).progress(fraction); });
}

void emca_preview(emca_monitor* monitor, emca_rect rect, const emca_color* colors) {
    const PixelRect pixels{rect.x0, rect.y0, rect.x1, rect.y1};
    if (monitor == nullptr || colors == nullptr || pixels.empty()) return;
    c::quiet([&] {
        const auto* first = reinterpret_cast<const Color*>(colors);
        c::of(monitor).preview(pixels, std::vector<Color>(first, first + pixels.count()));
    });
}

void emca_begin_pixel(emca_monitor* monitor, emca_pixel pixel) {
    if (monitor != nullptr) c::quiet([&] { c::of(monitor).beginPixel(c::pixel(pixel)); });
}

void emca_end_pixel(emca_monitor* monitor, emca_pixel pixel) {
    if (monitor != nullptr) c::quiet([&] { c::of(monitor).endPixel(c::pixel(pixel)); });
}

}  // extern "C"
