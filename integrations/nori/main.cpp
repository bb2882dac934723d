// emca-nori: renders a scene with a person's own Nori, or serves it to EMCA's explorer.

#include <memory>
#include <utility>

#include "nori_renderer.h"
#include "program/program.h"

namespace emca::nori_adapter {

namespace {

Result<program::Offer> load(const program::ProgramLine& line) {
    auto loaded = LoadedScene::load(line.scene);
    if (!loaded) return loaded.error();
    auto renderer = std::make_unique<NoriRenderer>(std::move(*loaded), NoriOptions{line.samplesPerPixel, line.seed, line.threads});
    auto probes = renderer->lightProbes();
    return program::Offer{std::move(renderer), {std::move(probes)}};
}

}  // namespace

}  // namespace emca::nori_adapter

int main(int argc, char** argv) {
    using namespace emca::nori_adapter;
    return emca::program::run({.name = "emca-nori", .renderer = "Nori", .integrators = {}, .load = &load}, argc, argv);
}
