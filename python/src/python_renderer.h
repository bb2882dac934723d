#pragma once

#include <pybind11/pybind11.h>

#include "emca/server/renderer.h"

namespace emca::python {

namespace py = pybind11;

/// A renderer written in Python, as the server calls it: every call takes the interpreter's lock, and what Python
/// raises becomes an error of the request. `adapter` is what emca/renderer.py makes of an emca.Renderer.
class PythonRenderer final : public Renderer {
  public:
    /// With the interpreter's lock.
    explicit PythonRenderer(py::object adapter) : adapter_(std::move(adapter)) {}
    ~PythonRenderer() override;
    PythonRenderer(const PythonRenderer&) = delete;
    PythonRenderer& operator=(const PythonRenderer&) = delete;

    RendererInfo info() const override;
    Camera camera() const override;
    std::vector<Mesh> meshes() const override;
    Result<RenderedImage> renderImage(const RenderSettings& settings, RequestMonitor& monitor) override;
    Result<Color> renderPixel(Pixel pixel, const RenderSettings& settings, Recording& recording,
                              RequestMonitor& monitor) override;
    Result<std::vector<Color>> renderPixels(const std::vector<Pixel>& pixels, const RenderSettings& settings,
                                            Recording& recording, RequestMonitor& monitor) override;

    /// Whether the calling thread is inside a call of any renderer of this kind: it must not wait for the server's end.
    static bool insideCall();

  private:
    py::object adapter_;
};

/// The classes that its methods get: RequestMonitor, Recording and its handles.
void bindRendererArguments(py::module_& module);

}  // namespace emca::python
