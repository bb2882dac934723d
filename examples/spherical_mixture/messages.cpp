#include "messages.h"

#include <array>
#include <bit>
#include <cmath>
#include <cstring>

namespace mixture {

namespace {

using emca::Error;
using emca::ErrorCode;

static_assert(std::endian::native == std::endian::little, "This example copies numbers as they are in memory.");

constexpr std::array<char, 4> kRequestMark{'V', 'M', 'F', 'Q'}, kReplyMark{'V', 'M', 'F', 'R'};

template <typename T>
void put(std::vector<std::byte>& bytes, const T& value) {
    const auto* first = reinterpret_cast<const std::byte*>(&value);
    bytes.insert(bytes.end(), first, first + sizeof(T));
}

/// Reads in order; beyond the end everything is 0 and `complete` false.
struct Reader {
    std::span<const std::byte> bytes;
    bool complete = true;

    template <typename T>
    T get() {
        T value{};
        if (bytes.size() < sizeof(T)) {
            complete = false;
            bytes = {};
        } else {
            std::memcpy(&value, bytes.data(), sizeof(T));
            bytes = bytes.subspan(sizeof(T));
        }
        return value;
    }
    std::vector<std::byte> block(std::size_t size) {
        if (size > bytes.size()) {
            complete = false;
            return {};
        }
        std::vector<std::byte> out(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(size));
        bytes = bytes.subspan(size);
        return out;
    }
};

Error violation(const char* what) {
    return {ErrorCode::protocolViolation, std::string("A ") + what + " of the spherical mixture was expected, but these bytes are none, or cut off."};
}

Error invalid(std::string sentence) { return {ErrorCode::invalidArgument, std::move(sentence)}; }

bool isUnit(Vec3d v) { return std::abs(length(v) - 1) < 1e-6; }

}  // namespace

std::vector<std::byte> encode(const Request& request) {
    std::vector<std::byte> bytes;
    put(bytes, kRequestMark);
    put(bytes, request.components);
    put(bytes, request.seed);
    put(bytes, static_cast<std::uint32_t>(request.lightProbe.size()));
    put(bytes, static_cast<std::uint32_t>(request.directions.size()));
    bytes.insert(bytes.end(), request.lightProbe.begin(), request.lightProbe.end());
    for (const WeightedDirection& item : request.directions) {
        put(bytes, item.direction);
        put(bytes, item.weight);
    }
    return bytes;
}

emca::Result<Request> decodeRequest(std::span<const std::byte> bytes) {
    Reader reader{bytes};
    Request request;
    if (reader.get<std::array<char, 4>>() != kRequestMark) return violation("request");
    request.components = reader.get<std::uint32_t>();
    request.seed = reader.get<std::uint64_t>();
    const auto probeBytes = reader.get<std::uint32_t>(), count = reader.get<std::uint32_t>();
    request.lightProbe = reader.block(probeBytes);
    if (!reader.complete || reader.bytes.size() != std::size_t(count) * 4 * sizeof(double)) return violation("request");
    if (request.components < 1 || request.components > kMaximumComponents) {
        return invalid(std::to_string(request.components) + " lobes were asked for: ask for 1 to " + std::to_string(kMaximumComponents) + ".");
    }
    if (request.lightProbe.empty() && count == 0) return invalid("Neither a light probe nor directions were given to fit lobes to.");
    request.directions.reserve(count);
    for (std::uint32_t i = 0; i < count; ++i) {
        const auto direction = reader.get<Vec3d>();
        request.directions.push_back({direction, reader.get<double>()});
    }
    return request;
}

std::vector<std::byte> encode(const Reply& reply) {
    std::vector<std::byte> bytes;
    put(bytes, kReplyMark);
    put(bytes, static_cast<std::uint32_t>(reply.fit.lobes.size()));
    put(bytes, static_cast<std::uint32_t>(reply.fit.iterations));
    put(bytes, static_cast<std::uint32_t>(reply.fit.converged));
    put(bytes, reply.fit.logLikelihood);
    put(bytes, reply.directions);
    put(bytes, static_cast<std::uint32_t>(reply.lightProbe.size()));
    for (const Lobe& lobe : reply.fit.lobes) {
        put(bytes, lobe.mean);
        put(bytes, lobe.kappa);
        put(bytes, lobe.weight);
    }
    bytes.insert(bytes.end(), reply.lightProbe.begin(), reply.lightProbe.end());
    return bytes;
}

emca::Result<Reply> decodeReply(std::span<const std::byte> bytes) {
    Reader reader{bytes};
    Reply reply;
    if (reader.get<std::array<char, 4>>() != kReplyMark) return violation("reply");
    const auto lobes = reader.get<std::uint32_t>();
    reply.fit.iterations = static_cast<int>(reader.get<std::uint32_t>());
    reply.fit.converged = reader.get<std::uint32_t>() != 0;
    reply.fit.logLikelihood = reader.get<double>();
    reply.directions = reader.get<std::uint32_t>();
    const auto probeBytes = reader.get<std::uint32_t>();
    if (!reader.complete || lobes > kMaximumComponents || reader.bytes.size() != std::size_t(lobes) * 5 * sizeof(double) + probeBytes) {
        return violation("reply");
    }
    for (std::uint32_t i = 0; i < lobes; ++i) {
        Lobe lobe;
        lobe.mean = reader.get<Vec3d>();
        lobe.kappa = reader.get<double>();
        lobe.weight = reader.get<double>();
        if (!isUnit(lobe.mean) || !(lobe.kappa >= 0) || !std::isfinite(lobe.kappa) || !(lobe.weight >= 0 && lobe.weight <= 1)) {
            return invalid("A lobe of the reply is none: its mean is not a unit vector, or its numbers make no sense.");
        }
        reply.fit.lobes.push_back(lobe);
    }
    reply.lightProbe = reader.block(probeBytes);
    return reply;
}

}  // namespace mixture
