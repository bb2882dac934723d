#ifndef EMCA_C_BASE_H
#define EMCA_C_BASE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#if defined(EMCA_C_BUILDING) && defined(__GNUC__)
#define EMCA_API __attribute__((visibility("default")))
#else
#define EMCA_API
#endif

#ifdef __cplusplus
extern "C" {
#endif

// Version

/// Of this interface, not of EMCA: the first number changes when what was compiled before does not fit any more (it is
/// the number in libemca.so.1), the second when something was added.
#define EMCA_ABI_MAJOR 1
#define EMCA_ABI_MINOR 0
#define EMCA_ABI ((uint32_t)EMCA_ABI_MAJOR << 16 | (uint32_t)EMCA_ABI_MINOR)

/// The first members of a struct that the caller fills: `emca_renderer r = {EMCA_SIZED(emca_renderer), .user = scene};`
#define EMCA_SIZED(type) .size = (uint32_t)sizeof(type), .version = EMCA_ABI

// Errors

/// 0, or what went wrong. The numbers are those of EMCA's protocol and never change their meaning.
typedef int32_t emca_code;
enum {
    EMCA_OK = 0,
    EMCA_INTERNAL = 1,            ///< a fault of EMCA: please report it
    EMCA_INVALID_ARGUMENT = 2,    ///< a value that no call may have
    EMCA_PIXEL_OUT_OF_RANGE = 3,
    EMCA_NOT_SUPPORTED = 4,
    EMCA_FILE_NOT_FOUND = 5,
    EMCA_FILE_UNREADABLE = 6,
    EMCA_FILE_UNWRITABLE = 7,
    EMCA_CONNECTION_FAILED = 8,
    EMCA_CONNECTION_LOST = 9,
    EMCA_TIMED_OUT = 10,
    EMCA_PROTOCOL_VIOLATION = 11,
    EMCA_VERSION_MISMATCH = 12,   ///< the program was compiled for another libemca
    EMCA_REFUSED = 13,
    EMCA_TOO_LARGE = 14,          ///< beyond a stated limit
    EMCA_CANCELLED = 15,
    EMCA_RENDERER_FAILED = 16,    ///< what a renderer's own functions return for their own troubles
    EMCA_ADDRESS_IN_USE = 17,
    EMCA_PARSE_FAILED = 18,
    EMCA_OUT_OF_MEMORY = 19
};

#define EMCA_MESSAGE_BYTES 508

/// What went wrong. The caller's own: on its stack, for example. Written only by calls that fail.
typedef struct emca_error {
    emca_code code;
    char message[EMCA_MESSAGE_BYTES];  ///< one sentence: what was asked, what was found, what to do; cut if it is longer
} emca_error;

/// Fills in an error, in a function of the renderer: `return emca_fail(error, EMCA_RENDERER_FAILED, "No camera.");`
/// \param error    may be null
/// \param message  copied; null for none
/// \return         `code`, EMCA_INTERNAL if that is EMCA_OK
EMCA_API emca_code emca_fail(emca_error* error, emca_code code, const char* message);

/// "pixelOutOfRange", …: a short stable name, valid forever; "ok" for 0, "unknown" for a number that is none.
EMCA_API const char* emca_code_name(emca_code code);

/// EMCA_ABI of the library that was loaded.
EMCA_API uint32_t emca_abi(void);
/// EMCA's own version, e.g. "0.1.0"; valid forever.
EMCA_API const char* emca_version(void);
/// Whether a program compiled with this header works with the loaded library: emca_check_abi(EMCA_ABI, &error). Every
/// struct is checked in the same way.
/// Errors: EMCA_VERSION_MISMATCH (another EMCA_ABI_MAJOR, or a library that is older than the header).
EMCA_API emca_code emca_check_abi(uint32_t compiled_with, emca_error* error);

// Vectors and colours: plain values. Where a number is a truth value (int32_t), 0 is false and all others are true.

typedef struct emca_pixel { uint32_t x, y; } emca_pixel;                    ///< column and row; (0, 0) is top left
typedef struct emca_rect { uint32_t x0, y0, x1, y1; } emca_rect;            ///< pixels with x in [x0, x1), y in [y0, y1)
typedef struct emca_vec2f { float x, y; } emca_vec2f;
typedef struct emca_vec3f { float x, y, z; } emca_vec3f;
typedef struct emca_vec2d { double x, y; } emca_vec2d;
typedef struct emca_vec3d { double x, y, z; } emca_vec3d;
typedef struct emca_vec2i { int64_t x, y; } emca_vec2i;
typedef struct emca_vec3i { int64_t x, y, z; } emca_vec3i;
typedef struct emca_color { float r, g, b; } emca_color;                    ///< linear Rec. 709
typedef struct emca_color_a { float r, g, b, a; } emca_color_a;             ///< opacity in [0, 1]; not premultiplied

// Seeds: what makes a pixel renderable again, alone and with the same bits

/// Seed of one sample of a pixel: a hash, without any storage. It depends on nothing else, so that more samples per pixel
/// extend the paths and change none. The same numbers as emca::SeedMap(master_seed). Any thread.
/// Source: Visual debugger thesis, section 4.4.
EMCA_API uint64_t emca_seed(uint64_t master_seed, emca_pixel pixel, uint64_t sample);
/// Seed of a whole pixel.
EMCA_API uint64_t emca_pixel_seed(uint64_t master_seed, emca_pixel pixel);

/// Seeds that come from elsewhere, 4 bytes a pixel.
typedef struct emca_seed_map emca_seed_map;
/// \param seeds  width * height numbers, row by row; copied
/// \param map    belongs to the caller until emca_seed_map_destroy
/// Errors: EMCA_INVALID_ARGUMENT (null, no pixels), EMCA_OUT_OF_MEMORY.
EMCA_API emca_code emca_seed_map_create(uint32_t width, uint32_t height, const uint32_t* seeds, uint64_t master_seed,
                                        emca_seed_map** map, emca_error* error);
/// As emca_seed. A pixel outside of the map gets a seed by hash. Any thread.
EMCA_API uint64_t emca_seed_map_seed(const emca_seed_map* map, emca_pixel pixel, uint64_t sample);
/// Null is nothing.
EMCA_API void emca_seed_map_destroy(emca_seed_map* map);

#ifdef __cplusplus
}
#endif

#endif
