#include "server_info.h"

#include "arrays.h"
#include "scene.h"

namespace emca::python {
namespace {

py::list layerList(const std::vector<LayerDescription>& layers) {
    py::list out;
    for (const LayerDescription& layer : layers) out.append(emca::python::toDict(layer));
    return out;
}

/// By the names of emca.ServerInfo.
py::dict infoDict(const client::ServerInfo& info) {
    py::dict out;
    out["renderer"] = toText(info.renderer);
    out["scene"] = toText(info.scene);
    out["integrator"] = toText(info.integrator);
    out["sampler"] = toText(info.sampler);
    out["width"] = info.width;
    out["height"] = info.height;
    out["samples_per_pixel"] = info.samplesPerPixel;
    out["seed"] = info.seed;
    out["triangle_count"] = info.triangles;
    out["mesh_count"] = info.meshes;
    out["maximum_samples_per_pixel"] = info.maximumSamplesPerPixel;
    out["maximum_pixels_per_trace"] = info.maximumPixelsPerTrace;
    out["capabilities"] = toList(info.capabilities);
    out["tools"] = toList(info.tools);
    out["latest_render"] = info.latestRender;
    out["layers"] = layerList(info.layers);
    out["surface_render"] = info.surfaceRender;
    return out;
}

}  // namespace

void bindServerInfo(py::module_& module) {
    py::class_<client::ServerInfo>(module, "ServerInfo").def("values", [](const client::ServerInfo& info) {
        return infoDict(info);
    });
}

}  // namespace emca::python
