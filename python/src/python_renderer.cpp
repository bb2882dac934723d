#include "python_renderer.h"

#include "arrays.h"
#include "errors.h"
#include "images.h"
#include "request.h"
#include "scene.h"

namespace emca::python {
namespace {

thread_local int callDepth = 0;

/// With the interpreter's lock, inside a call.
class Entered {
  public:
    Entered() { ++callDepth; }
    ~Entered() { --callDepth; }
    Entered(const Entered&) = delete;
    Entered& operator=(const Entered&) = delete;

  private:
    py::gil_scoped_acquire lock_;
};

/// Runs `call` with the interpreter's lock; what it raises is an error.
template <typename T, typename Call>
Result<T> guarded(const char* what, const Call& call) {
    const Entered entered;
    try {
        return call();
    } catch (py::error_already_set& exception) {
        return toError(exception, what);
    } catch (const Failure& failure) {
        return failure.error();
    } catch (const py::builtin_exception& exception) {  // of conversions
        return Error{ErrorCode::rendererFailed, std::string("What the renderer's ") + what +
                                                    " returned cannot be used: " + exception.what() + "."};
    }
}

/// Where the interface has no room for errors: the server makes error replies of exceptions.
template <typename T>
T thrown(Result<T> result) {
    if (!result.ok()) throw std::runtime_error(result.error().message);
    return std::move(result).value();
}

py::tuple toTuple(const RenderSettings& settings) {
    return py::make_tuple(settings.samplesPerPixel, settings.integrator, settings.sampler,
                          settings.hasSeed ? py::object(py::int_(settings.seed)) : py::object(py::none()));
}

Image imageOrEmpty(py::handle array) { return array.is_none() ? Image() : toImage(array); }

}  // namespace

PythonRenderer::~PythonRenderer() {
    const py::gil_scoped_acquire lock;
    adapter_ = py::object();
}

bool PythonRenderer::insideCall() { return callDepth > 0; }

RendererInfo PythonRenderer::info() const {
    return thrown(guarded<RendererInfo>("info", [&]() -> RendererInfo {
        const py::dict given = adapter_.attr("info")();
        RendererInfo info;
        info.renderer = given["renderer"].cast<std::string>();
        info.scene = given["scene"].cast<std::string>();
        info.width = given["width"].cast<std::uint32_t>();
        info.height = given["height"].cast<std::uint32_t>();
        info.samplesPerPixel = given["samples_per_pixel"].cast<std::uint32_t>();
        info.integrator = given["integrator"].cast<std::string>();
        info.sampler = given["sampler"].cast<std::string>();
        info.seed = given["seed"].cast<std::uint64_t>();
        info.concurrent = given["concurrent"].cast<bool>();
        info.deterministic = given["deterministic"].cast<bool>();
        info.threads = 1;  // the interpreter runs one at a time
        info.pathsReachAnyPixel = given["paths_reach_any_pixel"].cast<bool>();
        for (const py::handle word : given["capabilities"]) info.capabilities.push_back(word.cast<std::string>());
        return info;
    }));
}

Camera PythonRenderer::camera() const {
    return thrown(guarded<Camera>("camera", [&]() -> Camera { return toCamera(adapter_.attr("camera")()); }));
}

std::vector<Mesh> PythonRenderer::meshes() const {
    return thrown(guarded<std::vector<Mesh>>(
        "meshes", [&]() -> std::vector<Mesh> { return toMeshes(adapter_.attr("meshes")()); }));
}

Result<RenderedImage> PythonRenderer::renderImage(const RenderSettings& settings, RequestMonitor& monitor) {
    return guarded<RenderedImage>("render_image", [&]() -> Result<RenderedImage> {
        const CallArguments arguments(monitor, nullptr);
        const py::tuple images = adapter_.attr("render_image")(toTuple(settings), arguments.monitor());
        return RenderedImage{
            .color = toImage(images[0]), .samples = imageOrEmpty(images[1]), .variance = imageOrEmpty(images[2])};
    });
}

Result<Color> PythonRenderer::renderPixel(Pixel pixel, const RenderSettings& settings, Recording& recording,
                                          RequestMonitor& monitor) {
    return guarded<Color>("render_pixel", [&]() -> Result<Color> {
        const CallArguments arguments(monitor, &recording);
        const py::object color = adapter_.attr("render_pixel")(pixel.x, pixel.y, toTuple(settings),
                                                               arguments.recording(), arguments.monitor());
        return toColor(color, "the pixel that render_pixel returned");
    });
}

Result<std::vector<Color>> PythonRenderer::renderPixels(const std::vector<Pixel>& pixels,
                                                        const RenderSettings& settings, Recording& recording,
                                                        RequestMonitor& monitor) {
    bool overridden = false;
    Result<std::vector<Color>> result =
        guarded<std::vector<Color>>("render_pixels", [&]() -> Result<std::vector<Color>> {
            overridden = adapter_.attr("has_render_pixels").cast<bool>();
            if (!overridden) return std::vector<Color>();
            const CallArguments arguments(monitor, &recording);
            py::list asked;
            for (const Pixel pixel : pixels) asked.append(py::make_tuple(pixel.x, pixel.y));
            const Numbers colors = toFloats(
                adapter_.attr("render_pixels")(asked, toTuple(settings), arguments.recording(), arguments.monitor()));
            if (colors.values.size() != 3 * pixels.size())
                throw py::value_error("three numbers are expected for each pixel");
            std::vector<Color> out(pixels.size());
            for (std::size_t i = 0; i < out.size(); ++i)
                out[i] = {colors.values[3 * i], colors.values[3 * i + 1], colors.values[3 * i + 2]};
            return out;
        });
    if (!result.ok() || overridden) return result;
    return Renderer::renderPixels(pixels, settings, recording, monitor);
}

}  // namespace emca::python
