#include <algorithm>
#include <atomic>
#include <cstring>
#include <memory>
#include <mutex>
#include <vector>

#include "emca/core/seed_map.h"
#include "guard.h"

namespace emca::c {
namespace {

/// How much of a text fits into `room` bytes without cutting a character of UTF-8 in two.
std::size_t fitting(const char* message, std::size_t room) {
    std::size_t bytes = strnlen(message, room + 1);
    if (bytes <= room) return bytes;
    bytes = room;
    while (bytes > 0 && (static_cast<unsigned char>(message[bytes]) & 0xc0) == 0x80) --bytes;
    return bytes;
}

std::atomic<std::uint64_t> misuseCount{0};
std::mutex firstMisuseMutex;
emca_error firstMisuse{};

}  // namespace

emca_code fail(emca_error* error, const Error& what) {
    return emca_fail(error, static_cast<emca_code>(what.code), what.message.c_str());
}

emca_code invalid(emca_error* error, const std::string& sentence) {
    return emca_fail(error, EMCA_INVALID_ARGUMENT, sentence.c_str());
}

Error errorOf(emca_code code, const emca_error& error, const char* function) {
    const bool known = code >= EMCA_INTERNAL && code <= EMCA_OUT_OF_MEMORY;
    const std::size_t length = strnlen(error.message, sizeof error.message);
    std::string sentence(error.message, length);
    if (sentence.empty())
        sentence = std::string("The renderer's function ") + function + " returned " + std::to_string(code) +
                   " and no sentence: let it say by emca_fail what went wrong.";
    return {known ? static_cast<ErrorCode>(code) : ErrorCode::rendererFailed, std::move(sentence)};
}

void countMisuse(const char* function, const char* why) noexcept {
    if (misuseCount.fetch_add(1, std::memory_order_relaxed) != 0) return;
    quiet([&] {
        const std::lock_guard lock(firstMisuseMutex);
        emca_fail(&firstMisuse, EMCA_INVALID_ARGUMENT, (std::string(function) + " was ignored: " + why).c_str());
    });
}

std::uint64_t misuses() { return misuseCount.load(std::memory_order_relaxed); }

}  // namespace emca::c

using namespace emca;

extern "C" {

emca_code emca_fail(emca_error* error, emca_code code, const char* message) {
    if (code == EMCA_OK) code = EMCA_INTERNAL;
    if (error == nullptr) return code;
    error->code = code;
    const std::size_t bytes = message == nullptr ? 0 : c::fitting(message, sizeof error->message - 1);
    // Messages may be made from what is there already.
    if (bytes > 0) std::memmove(error->message, message, bytes);
    std::memset(error->message + bytes, 0, sizeof error->message - bytes);
    return code;
}

const char* emca_code_name(emca_code code) {
    if (code == EMCA_OK) return "ok";
    if (code < 0 || code > 0xffff) return "unknown";
    return name(static_cast<ErrorCode>(code));
}

uint32_t emca_abi(void) { return EMCA_ABI; }
const char* emca_version(void) { return EMCA_VERSION; }

emca_code emca_check_abi(uint32_t compiledWith, emca_error* error) {
    const std::uint32_t major = compiledWith >> 16, minor = compiledWith & 0xffff;
    if (major == EMCA_ABI_MAJOR && minor <= EMCA_ABI_MINOR) return EMCA_OK;
    return c::guarded(error, [&] {
        const auto number = [](std::uint32_t a, std::uint32_t b) {
            return std::to_string(a) + "." + std::to_string(b);
        };
        const std::string asked = "The program was compiled for version " + number(major, minor) +
                                  " of EMCA's C interface, and the loaded libemca.so (EMCA " EMCA_VERSION ") has " +
                                  number(EMCA_ABI_MAJOR, EMCA_ABI_MINOR) + ": ";
        const bool older = major < EMCA_ABI_MAJOR;
        return c::fail(error, {ErrorCode::versionMismatch,
                               asked + (compiledWith == 0 ? "set `version` with EMCA_SIZED, or pass EMCA_ABI."
                                        : older           ? "compile it again."
                                                          : "install a newer EMCA.")});
    });
}

uint64_t emca_misuse(emca_error* first) {
    const std::uint64_t count = c::misuses();
    if (count > 0 && first != nullptr)
        c::quiet([&] {
            const std::lock_guard lock(c::firstMisuseMutex);
            *first = c::firstMisuse;
        });
    return count;
}

uint64_t emca_seed(uint64_t masterSeed, emca_pixel pixel, uint64_t sample) {
    return SeedMap(masterSeed).seed({pixel.x, pixel.y}, sample);
}
uint64_t emca_pixel_seed(uint64_t masterSeed, emca_pixel pixel) {
    return SeedMap(masterSeed).seed(Pixel{pixel.x, pixel.y});
}

struct emca_seed_map {
    std::uint32_t width, height;
    SeedMap stored, hashed;
};

emca_code emca_seed_map_create(uint32_t width, uint32_t height, const uint32_t* seeds, uint64_t masterSeed,
                               emca_seed_map** map, emca_error* error) {
    if (map == nullptr)
        return c::invalid(error, "emca_seed_map_create was given null for the map: pass the address of a pointer.");
    *map = nullptr;
    if (seeds == nullptr || width == 0 || height == 0)
        return c::invalid(error, "A seed map needs width * height seeds, but there are no seeds or no pixels.");
    return c::guarded(error, [&] {
        std::vector<std::uint32_t> copy(seeds, seeds + std::size_t(width) * height);
        *map = new emca_seed_map{width, height, SeedMap(width, std::move(copy), masterSeed), SeedMap(masterSeed)};
        return EMCA_OK;
    });
}

uint64_t emca_seed_map_seed(const emca_seed_map* map, emca_pixel pixel, uint64_t sample) {
    if (map == nullptr) return emca_seed(0, pixel, sample);
    const bool inside = pixel.x < map->width && pixel.y < map->height;
    return (inside ? map->stored : map->hashed).seed({pixel.x, pixel.y}, sample);
}

void emca_seed_map_destroy(emca_seed_map* map) { delete map; }

}  // extern "C"
