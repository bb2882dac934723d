#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "emca/core/image.h"
#include "emca/core/result.h"
#include "emca/core/vector.h"
#include "emca/probe/sphere_map.h"

/// What explorer and renderer say to each other about light probes: bytes of tool requests and replies
/// (docs/explorer/light-probe.md has the tables). A renderer of any kind offers light probes by a ServerTool of this name
/// that decodes requests, renders and encodes replies with the functions below.
namespace emca::probe {

inline constexpr const char* kLightProbeTool = "light probe";  ///< name of the server tool

inline constexpr std::uint32_t kMaximumProbeWidth = 4096, kMaximumProbeHeight = 2048;  ///< pixels
inline constexpr std::uint32_t kMaximumProbeSamples = 1u << 16;                        ///< per pixel
inline constexpr std::uint64_t kMaximumProbePaths = std::uint64_t(1) << 31;            ///< pixels times samples
inline constexpr std::size_t kMaximumIntegratorName = 64;                              ///< bytes

/// Asks for the radiance that arrives at a point from all directions.
struct LightProbeRequest {
    Vec3f position;                  ///< world space
    /// Unit, of the surface on which the position lies, either side; 0 where it lies on none. Rays start so far off that
    /// surface that they do not meet it again; those below it look through its other side.
    Vec3f normal;
    SphereFrame frame;               ///< how the image is turned
    std::uint32_t width = 256, height = 128;
    std::uint32_t samplesPerPixel = 16;
    /// Longest path in segments, counted from the probe: 1 shows what emits, 2 adds direct light; -1: no limit; 0: as the
    /// renderer's integrator does.
    std::int32_t maximumDepth = 0;
    std::uint64_t seed = 0;          ///< the same request gives the same bits from a deterministic renderer
    std::string integrator;          ///< UTF-8; empty: the renderer's
    friend bool operator==(const LightProbeRequest&, const LightProbeRequest&) = default;
};

/// The radiance that arrives.
struct LightProbe {
    SphereMap map;                   ///< where each pixel looks, and how large it is
    std::uint32_t samplesPerPixel = 0;
    float seconds = 0;               ///< the renderer's own time
    /// Channels R, G, B: mean radiance over the solid angle of each pixel, linear Rec. 709, W/(sr m^2); "error": standard
    /// error of their luminance, 0 with fewer than 2 samples.
    Image image;
};

/// Says which rule is broken. Errors: invalidArgument; tooLarge (beyond the limits above).
Result<void> validate(const LightProbeRequest& request);

/// \param request  a valid one
std::vector<std::byte> encode(const LightProbeRequest& request);
/// What it returns is valid. Errors: protocolViolation (other bytes, or cut), versionMismatch; those of validate().
Result<LightProbeRequest> decodeRequest(std::span<const std::byte> bytes);

/// \param probe  `image` has the size of `map` and the four channels
std::vector<std::byte> encode(const LightProbe& probe);
/// Errors: protocolViolation, versionMismatch, tooLarge.
Result<LightProbe> decodeProbe(std::span<const std::byte> bytes);

/// The channels of LightProbe::image.
std::vector<std::string> probeChannels();

}  // namespace emca::probe
