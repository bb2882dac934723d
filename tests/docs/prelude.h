#pragma once

// What the snippets of the documentation take for granted: a renderer around them, or the models of a viewer.
#include "emca/adapter/light_probe_tool.h"
#include "emca/adapter/parametric_mesh.h"
#include "emca/adapter/pixel_renderer.h"
#include "emca/adapter/serving.h"
#include "emca/client/session.h"
#include "emca/core/seed_map.h"
#include "emca/recorder/handles.h"
#include "emca/recorder/path_layers.h"
#include "emca/recorder/recorder.h"
#include "emca/recorder/surface_recorder.h"
#include "emca/server/server.h"

struct MyVector { float x, y, z; };
struct MyBsdf { std::string describe() const { return {}; } };
struct MyRandom { void seed(std::uint64_t) {} };
struct MyRay { MyVector o; };
struct MyHit { MyVector p; int mesh = 0, face = 0; };

inline MyRay ray;
inline MyHit its, light;
inline MyBsdf bsdf;
inline MyRandom rng;
inline emca::Pixel pixel;
inline emca::Color T, f, Le, L;
inline float w = 1, pdf = 1;
inline bool visible = true;
inline int sample = 0, bounce = 0, maxBounces = 8, samplesSoFar = 0, samplesPerPixel = 1;
inline std::uint64_t masterSeed = 0;
inline void fail(const std::string&) {}
inline emca::Color trace(emca::Pixel) { return {}; }
namespace client = emca::client;
inline client::Dataset dataset;
inline client::Selection selection;
inline void say(const std::string&) {}
inline emca::SurfaceRecorder surface(std::vector<emca::SurfaceMeshView>{});

class MyRenderer : public emca::Renderer {
  public:
    emca::RendererInfo info() const override { return {}; }
    emca::Camera camera() const override { return {}; }
    std::vector<emca::Mesh> meshes() const override { return {}; }
    emca::Result<emca::RenderedImage> renderImage(const emca::RenderSettings&, emca::RequestMonitor&) override { return emca::RenderedImage{}; }
    emca::Result<emca::Color> renderPixel(emca::Pixel, const emca::RenderSettings&, emca::Recording&, emca::RequestMonitor&) override { return emca::Color(); }
};
