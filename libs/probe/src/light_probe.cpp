#include "emca/probe/light_probe.h"

#include <array>
#include <cmath>
#include <string_view>

#include "little_endian.h"

namespace emca::probe {

namespace {

using Mark = std::array<char, 4>;
constexpr Mark kRequestMark{'E', 'M', 'L', 'P'}, kReplyMark{'E', 'M', 'L', 'R'};
constexpr std::uint16_t kVersion = 1;
constexpr std::uint32_t kChannels = 4;

void begin(Writer& writer, Mark mark) {
    writer.put(mark.data(), mark.size());
    writer.put(kVersion);
    writer.put(std::uint16_t(0));
}

/// Reads mark and version. \param what  "light-probe request", for people
Result<void> readBegin(Reader& reader, Mark expected, const std::string& what) {
    Mark mark{};
    for (char& letter : mark) letter = reader.get<char>();
    const auto version = reader.get<std::uint16_t>();
    reader.get<std::uint16_t>();
    if (!reader.complete() || mark != expected) {
        return Error{ErrorCode::protocolViolation, "A " + what + " was expected, but these bytes are none: do both sides mean the same tool?"};
    }
    if (version != kVersion) {
        return Error{ErrorCode::versionMismatch, "The " + what + " has version " + std::to_string(version) + ", but version " +
                                                     std::to_string(kVersion) + " is understood: use explorer and renderer of the same age."};
    }
    return {};
}

Error cut(const std::string& what) { return {ErrorCode::protocolViolation, "The " + what + " is cut off or too long: its numbers and its size do not fit."}; }

Error invalid(std::string sentence) { return {ErrorCode::invalidArgument, std::move(sentence)}; }

Result<void> checkSize(std::uint32_t width, std::uint32_t height) {
    const std::string asked = std::to_string(width) + " x " + std::to_string(height) + " pixels";
    if (width == 0 || height == 0) return invalid("A light probe of " + asked + " was asked for: it has at least 1 x 1.");
    if (width > kMaximumProbeWidth || height > kMaximumProbeHeight) {
        return Error{ErrorCode::tooLarge, "A light probe of " + asked + " was asked for: the largest has " +
                                              std::to_string(kMaximumProbeWidth) + " x " + std::to_string(kMaximumProbeHeight) + "."};
    }
    return {};
}

Result<void> checkSamples(const LightProbeRequest& request) {
    const std::string asked = "A light probe of " + std::to_string(request.samplesPerPixel) + " samples per pixel was asked for: ";
    if (request.samplesPerPixel == 0) return invalid(asked + "ask for at least 1.");
    if (request.samplesPerPixel > kMaximumProbeSamples) {
        return Error{ErrorCode::tooLarge, asked + "at most " + std::to_string(kMaximumProbeSamples) + " are possible."};
    }
    const std::uint64_t paths = std::uint64_t(request.width) * request.height * request.samplesPerPixel;
    if (paths > kMaximumProbePaths) {
        return Error{ErrorCode::tooLarge, "A light probe of " + std::to_string(paths) + " paths was asked for: at most " +
                                              std::to_string(kMaximumProbePaths) + " are possible; ask for fewer pixels or samples."};
    }
    return {};
}

}  // namespace

std::vector<std::string> probeChannels() { return {"R", "G", "B", "error"}; }

Result<void> validate(const LightProbeRequest& request) {
    if (!isFinite(request.position)) return invalid("The position of a light probe is not finite: choose another vertex.");
    const bool none = request.normal == Vec3f{};
    if (!none && !(isFinite(request.normal) && std::abs(length(request.normal) - 1.f) <= 1e-3f)) {
        return invalid("The normal of a light probe has not length 1: give a unit vector, or 0 for a point on no surface.");
    }
    if (!request.frame.isValid()) return invalid("The pole and the forward direction of a light probe are not unit vectors at right angles.");
    if (auto size = checkSize(request.width, request.height); !size) return size.error();
    if (auto samples = checkSamples(request); !samples) return samples.error();
    if (request.maximumDepth < -1) {
        return invalid("A light probe of depth " + std::to_string(request.maximumDepth) +
                       " was asked for: give the longest path in segments, -1 for no limit, or 0 for the renderer's.");
    }
    if (request.integrator.size() > kMaximumIntegratorName) {
        return Error{ErrorCode::tooLarge, "The name of the integrator of a light probe has " + std::to_string(request.integrator.size()) +
                                              " bytes: at most " + std::to_string(kMaximumIntegratorName) + " are possible."};
    }
    return {};
}

std::vector<std::byte> encode(const LightProbeRequest& request) {
    Writer writer;
    begin(writer, kRequestMark);
    writer.put(request.position);
    writer.put(request.normal);
    writer.put(request.frame.pole);
    writer.put(request.frame.forward);
    writer.put(request.width);
    writer.put(request.height);
    writer.put(request.samplesPerPixel);
    writer.put(request.maximumDepth);
    writer.put(request.seed);
    writer.put(static_cast<std::uint32_t>(request.integrator.size()));
    writer.put(request.integrator.data(), request.integrator.size());
    return writer.take();
}

Result<LightProbeRequest> decodeRequest(std::span<const std::byte> bytes) {
    const std::string what = "light-probe request";
    Reader reader(bytes);
    if (auto begun = readBegin(reader, kRequestMark, what); !begun) return begun.error();
    LightProbeRequest request;
    request.position = reader.vector();
    request.normal = reader.vector();
    request.frame.pole = reader.vector();
    request.frame.forward = reader.vector();
    request.width = reader.get<std::uint32_t>();
    request.height = reader.get<std::uint32_t>();
    request.samplesPerPixel = reader.get<std::uint32_t>();
    request.maximumDepth = reader.get<std::int32_t>();
    request.seed = reader.get<std::uint64_t>();
    const auto nameSize = reader.get<std::uint32_t>();
    if (!reader.complete() || reader.left() != nameSize) return cut(what);
    const std::span<const std::byte> integrator = reader.rest();
    request.integrator.assign(reinterpret_cast<const char*>(integrator.data()), integrator.size());
    if (auto valid = validate(request); !valid) return valid.error();
    return request;
}

std::vector<std::byte> encode(const LightProbe& probe) {
    Writer writer;
    const std::size_t values = probe.image.size();
    writer.reserve(64 + values * sizeof(float));
    begin(writer, kReplyMark);
    writer.put(probe.map.width());
    writer.put(probe.map.height());
    writer.put(probe.samplesPerPixel);
    writer.put(probe.seconds);
    writer.put(probe.map.frame().pole);
    writer.put(probe.map.frame().forward);
    if constexpr (std::endian::native == std::endian::little) {
        writer.put(probe.image.data(), values * sizeof(float));
    } else {
        for (std::size_t i = 0; i < values; ++i) writer.put(probe.image.data()[i]);
    }
    return writer.take();
}

Result<LightProbe> decodeProbe(std::span<const std::byte> bytes) {
    const std::string what = "light probe";
    Reader reader(bytes);
    if (auto begun = readBegin(reader, kReplyMark, what); !begun) return begun.error();
    LightProbe probe;
    const auto width = reader.get<std::uint32_t>(), height = reader.get<std::uint32_t>();
    probe.samplesPerPixel = reader.get<std::uint32_t>();
    probe.seconds = reader.get<float>();
    SphereFrame frame;
    frame.pole = reader.vector();
    frame.forward = reader.vector();
    if (!reader.complete()) return cut(what);
    if (auto size = checkSize(width, height); !size) return size.error();
    if (reader.left() != std::size_t(width) * height * kChannels * sizeof(float)) return cut(what);
    if (!frame.isValid()) {
        return Error{ErrorCode::protocolViolation, "The light probe's pole and forward direction are not unit vectors at right angles."};
    }
    probe.map = SphereMap(frame, width, height);
    probe.image = Image(width, height, probeChannels());
    if constexpr (std::endian::native == std::endian::little) {
        std::memcpy(probe.image.data(), reader.rest().data(), reader.left());
    } else {
        for (std::size_t i = 0; i < probe.image.size(); ++i) probe.image.data()[i] = reader.get<float>();
    }
    return probe;
}

}  // namespace emca::probe
