#ifndef EMCA_C_SERVER_H
#define EMCA_C_SERVER_H

#include "emca/c/base.h"
#include "emca/c/renderer.h"

#ifdef __cplusplus
extern "C" {
#endif

/// How to serve. All 0, or no struct at all: on a free port of the loopback interface, open to whoever can connect there.
typedef struct emca_server_options {
    uint32_t size, version;   ///< EMCA_SIZED
    const char* host;         ///< null: "127.0.0.1"; "0.0.0.0" or "::" for every interface
    const char* token;        ///< if not empty, clients must present it
    uint16_t port;            ///< 0: the system picks one
    uint16_t reserved;        ///< 0
    int32_t allow_quit;       ///< whether a client's quit request ends the server
    uint32_t maximum_clients; ///< 0, as for all that follow: what ServerOptions (emca/server/server.h) says
    uint32_t maximum_samples_per_pixel;
    uint32_t maximum_pixels_per_trace;
    uint32_t kept_images;             ///< finished renders kept for verdicts
    uint32_t kept_surfaces;           ///< collections of surface layers kept
    uint32_t handshake_timeout;       ///< milliseconds after which a stranger that stays silent is sent away
    uint64_t default_budget;          ///< bytes of one recording where the client does not say
    uint64_t maximum_budget;
    uint64_t surface_budget;          ///< bytes of one collection of surface layers where the client does not say
    uint64_t maximum_surface_budget;
    void* log_user;
    /// Where remarks for people go (a client came, was refused, the renderer misused the recorder); null: nowhere. Called
    /// from several threads: be quick. `line` is good until it returns.
    void (*log)(void* log_user, const char* line);
} emca_server_options;

/// Serves one renderer to any number of explorers, scripts and command lines, in threads of its own.
typedef struct emca_server emca_server;

/// Binds and begins to serve. The struct is copied; what `user` points to must stay until emca_server_destroy.
/// \param options  null: as usual
/// \param server   the caller's, until emca_server_destroy
/// Errors: EMCA_INVALID_ARGUMENT (null, a needed function is missing, unknown host), EMCA_VERSION_MISMATCH,
/// EMCA_ADDRESS_IN_USE, EMCA_RENDERER_FAILED (info or surface_layers did), EMCA_OUT_OF_MEMORY.
EMCA_API emca_code emca_server_start(const emca_renderer* renderer, const emca_server_options* options,
                                     emca_server** server, emca_error* error);
/// The port in use, also where 0 was asked for; 0 if `server` is null. Any thread.
EMCA_API uint16_t emca_server_port(const emca_server* server);
/// "127.0.0.1:50013", or "" if `server` is null; good until emca_server_destroy. Any thread.
EMCA_API const char* emca_server_address(const emca_server* server);
/// Returns when a client's quit request, or emca_server_stop, ended the server. Any thread but the renderer's functions.
EMCA_API void emca_server_wait(emca_server* server);
/// Ends the server: running work is cancelled. Any thread; not from a signal handler.
EMCA_API void emca_server_stop(emca_server* server);
/// Stops, waits for running work and frees. Not from a function of the renderer, and not while another thread is in one
/// of the functions above. Null is nothing.
EMCA_API void emca_server_destroy(emca_server* server);

// Tools: the renderer's half of a plugin, which answers requests of its explorer half with bytes of its own schema

/// Where the bytes of an answer go.
typedef struct emca_reply emca_reply;
/// Appends a copy. Errors: EMCA_INVALID_ARGUMENT (null with `bytes` > 0), EMCA_OUT_OF_MEMORY.
EMCA_API emca_code emca_reply_append(emca_reply* reply, const void* data, size_t bytes, emca_error* error);

/// The server that a tool belongs to; good from emca_tool.added on, as long as the server.
typedef struct emca_tool_host emca_tool_host;
/// Appends to `reply` what another tool of the same server answers, in the calling thread, inside of emca_tool.answer.
/// Errors: EMCA_NOT_SUPPORTED (there is no such tool), EMCA_INVALID_ARGUMENT, and those of that tool.
EMCA_API emca_code emca_ask_tool(emca_tool_host* host, const char* tool, const void* request, size_t bytes,
                                 emca_monitor* monitor, emca_reply* reply, emca_error* error);

/// A tool as functions, called from server threads. Replays of many pixels run in one thread where a tool has one of the
/// last six functions, so that it is told of one pixel at a time.
typedef struct emca_tool {
    uint32_t size, version;  ///< EMCA_SIZED
    void* user;              ///< anything; never looked at
    const char* name;        ///< unique at its server: how requests address it; copied
    /// One request at a time, besides replays and renders. Errors travel to the client as they are.
    emca_code (*answer)(void* user, const void* request, size_t bytes, emca_monitor* monitor, emca_reply* reply,
                        emca_error* error);
    /// May be null, as all that follow. Called once, inside of emca_server_add_tool.
    void (*added)(void* user, emca_tool_host* host);
    /// Around each replayed pixel, in the thread that replays: emca_thread_recorder() adds to it.
    void (*begin_pixel)(void* user, emca_pixel pixel);
    void (*end_pixel)(void* user, emca_pixel pixel);
    /// A path or vertex of the replayed pixel was begun or ended by the recording thread.
    void (*begin_path)(void* user, emca_pixel pixel, int64_t sample);
    void (*end_path)(void* user, emca_pixel pixel, int64_t sample);
    void (*begin_vertex)(void* user, int32_t depth);
    void (*end_vertex)(void* user, int32_t depth);
} emca_tool;

/// The tool answers requests from now on; the struct is copied, `user` must stay until emca_server_destroy.
/// Errors: EMCA_INVALID_ARGUMENT (null, no name, no `answer`, a tool of that name is there), EMCA_VERSION_MISMATCH.
EMCA_API emca_code emca_server_add_tool(emca_server* server, const emca_tool* tool, emca_error* error);

// The explorer's light probe: what a point sees in all directions. docs/explorer/light-probe.md

/// How a light probe was asked for.
typedef struct emca_probe_request {
    uint32_t size, version;
    uint64_t seed;               ///< the same one gives the same bits from a deterministic renderer
    uint32_t samples_per_pixel;  ///< at least 1
    int32_t maximum_depth;       ///< longest path in segments: 1 shows what emits; -1: no limit; 0: as usual
    const char* integrator;      ///< never null; empty: the renderer's
} emca_probe_request;

/// What a renderer adds for it; directions, sums and the image are made by the library, the same with any number of
/// threads.
typedef struct emca_light_probe {
    uint32_t size, version;  ///< EMCA_SIZED
    void* user;              ///< anything; never looked at
    float surface_offset;    ///< scene units: how far off its surface a ray starts; 1e-4 of the scene's radius is common
    uint32_t threads;        ///< that render a probe; 0: one per processor; 1 if `radiance` must not run twice at once
    /// Radiance that arrives along a ray, linear Rec. 709, W/(sr m^2). Depends on its arguments alone. Emitters are to be
    /// seen even where an integrator hides them from the camera.
    /// \param worker     what `begin` made; `user` if there is none
    /// \param origin     world space, already off the surface on the ray's side
    /// \param direction  unit, world space
    emca_color (*radiance)(void* worker, const emca_probe_request* request, emca_vec3f origin, emca_vec3f direction,
                           emca_pixel pixel, uint32_t sample);
    /// May be null. In each thread before its first ray: makes what that thread needs (a sampler, memory), or refuses the
    /// request.
    emca_code (*begin)(void* user, const emca_probe_request* request, void** worker, emca_error* error);
    /// May be null. In the same thread, after its last ray.
    void (*end)(void* user, void* worker);
} emca_light_probe;

/// Adds the tool "light probe". The struct is copied, `user` must stay until emca_server_destroy.
/// Errors: EMCA_INVALID_ARGUMENT (null, no `radiance`, an offset that is negative or not finite, there is one already),
/// EMCA_VERSION_MISMATCH.
EMCA_API emca_code emca_server_add_light_probe(emca_server* server, const emca_light_probe* probe, emca_error* error);

#ifdef __cplusplus
}
#endif

#endif
