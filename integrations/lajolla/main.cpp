// emca-lajolla: renders a scene with a person's own lajolla, or serves it to EMCA's explorer.

#include <memory>
#include <utility>

#include "lajolla_renderer.h"
#include "program/program.h"

namespace emca::lajolla {

namespace {

Result<program::Offer> load(const program::ProgramLine& line) {
    auto loaded = LoadedScene::load(line.scene);
    if (!loaded) return loaded.error();
    const std::shared_ptr<const LoadedScene> scene = std::move(*loaded);
    if (const auto found = findIntegrator(line.integrator, scene->scene()); !found) return found.error();
    auto renderer = std::make_unique<LajollaRenderer>(scene, LajollaOptions{line.samplesPerPixel, line.integrator, line.seed, line.threads});
    auto probes = renderer->lightProbes();
    return program::Offer{std::move(renderer), {std::move(probes)}};
}

}  // namespace

}  // namespace emca::lajolla

int main(int argc, char** argv) {
    using namespace emca::lajolla;
    return emca::program::run({.name = "emca-lajolla", .renderer = "lajolla", .integrators = integratorNames(), .load = &load}, argc, argv);
}
