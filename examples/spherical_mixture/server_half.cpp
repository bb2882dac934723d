#include "server_half.h"

#include <cmath>
#include <numbers>

#include "emca/probe/light_probe.h"
#include "messages.h"

namespace mixture {

namespace {

using emca::Error;
using emca::ErrorCode;

/// Radiance over the sphere as directions: the middle of each pixel, weighted by luminance times solid angle.
std::vector<WeightedDirection> directionsOf(const emca::probe::LightProbe& probe) {
    std::vector<WeightedDirection> directions;
    directions.reserve(std::size_t(probe.map.width()) * probe.map.height());
    for (std::uint32_t y = 0; y < probe.map.height(); ++y)
        for (std::uint32_t x = 0; x < probe.map.width(); ++x) {
            const emca::Vec3f towards = probe.map.direction({x + 0.5, y + 0.5});
            const double luminance = double(emca::luminance(probe.image.color({x, y})));
            directions.push_back({{double(towards.x), double(towards.y), double(towards.z)}, luminance * probe.map.solidAngle(y)});
        }
    return directions;
}

}  // namespace

std::string MixtureTool::name() const { return kTool; }

emca::Result<std::vector<std::byte>> MixtureTool::answer(std::span<const std::byte> bytes, emca::RequestMonitor& monitor) {
    auto request = decodeRequest(bytes);
    if (!request) return request.error();
    FitOptions options;
    options.components = static_cast<int>(request->components);
    options.seed = request->seed;
    options.cancelled = [&monitor] { return monitor.cancelled(); };

    Reply reply;
    std::vector<WeightedDirection> directions = std::move(request->directions);
    if (!request->lightProbe.empty()) {
        auto answered = host_->ask(emca::probe::kLightProbeTool, request->lightProbe, monitor);
        if (!answered) return answered.error();
        const auto probe = emca::probe::decodeProbe(*answered);
        if (!probe) return probe.error();
        directions = directionsOf(*probe);
        // A pixel is all that is known of a light inside of it: uniform over its solid angle A, its mean cosine is 1 - A / 4 pi.
        const double pixel = probe->map.solidAngle(probe->map.height() / 2);
        options.largestKappa = 4 * std::numbers::pi / pixel;
        reply.lightProbe = std::move(answered).value();
    } else {
        options.priorSamples = 1;   // few directions say nothing about how narrow their lobe is
    }
    reply.fit = fit(directions, options);
    if (monitor.cancelled()) return Error{ErrorCode::cancelled, "The fit was cancelled."};
    if (reply.fit.lobes.empty()) return Error{ErrorCode::invalidArgument, "No light arrives here: there is nothing to fit lobes to."};
    reply.directions = static_cast<std::uint32_t>(directions.size());
    return encode(reply);
}

}  // namespace mixture
