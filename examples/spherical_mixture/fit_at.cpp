// spherical-mixture-fit HOST:PORT X Y Z [LOBES]: the mixture at a point, as a table; how a script asks a server tool.

#include <cstdio>
#include <cstdlib>

#include "emca/client/connection.h"
#include "emca/probe/light_probe.h"
#include "messages.h"

namespace {

int fail(const emca::Error& error) {
    std::fprintf(stderr, "error: %s\n", error.message.c_str());
    return 1;
}

}  // namespace

int main(int argc, char** argv) {
    if (argc < 5) {
        std::fprintf(stderr, "usage: spherical-mixture-fit HOST:PORT X Y Z [LOBES]\n");
        return 2;
    }
    const auto address = emca::client::Address::parse(argv[1]);
    if (!address) return fail(address.error());
    const auto connection = emca::client::Connection::open(*address);
    if (!connection) return fail(connection.error());

    emca::probe::LightProbeRequest probe;
    probe.position = {std::strtof(argv[2], nullptr), std::strtof(argv[3], nullptr), std::strtof(argv[4], nullptr)};
    probe.width = 128, probe.height = 64;
    mixture::Request request;
    if (argc > 5) request.components = static_cast<std::uint32_t>(std::atoi(argv[5]));
    request.lightProbe = emca::probe::encode(probe);
    const auto answer = (*connection)->askTool(mixture::kTool, mixture::encode(request));
    if (!answer) return fail(answer.error());
    const auto reply = mixture::decodeReply(*answer);
    if (!reply) return fail(reply.error());
    std::printf("%10s %12s   mean direction\n", "weight", "kappa");
    for (const mixture::Lobe& lobe : reply->fit.lobes) {
        std::printf("%10.4f %12.4g   %8.4f %8.4f %8.4f\n", lobe.weight, lobe.kappa, lobe.mean.x, lobe.mean.y, lobe.mean.z);
    }
    return 0;
}
