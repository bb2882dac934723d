// The binary interface 1.0, member by member: what was compiled against it must go on working. New members go to the end
// of a struct (then only its SIZE changes here) and raise EMCA_ABI_MINOR; all else raises EMCA_ABI_MAJOR and the number
// of libemca.so.
#include "emca/emca.h"

#if UINTPTR_MAX != UINT64_MAX
#error "The numbers below are those of machines with pointers of 8 bytes."
#endif

#define SIZE(type, bytes) _Static_assert(sizeof(type) == (bytes), "the size of " #type " has changed")
#define AT(type, member, offset) _Static_assert(offsetof(type, member) == (offset), #type "." #member " has moved")

SIZE(emca_error, 512);
AT(emca_error, code, 0);
AT(emca_error, message, 4);

SIZE(emca_pixel, 8);
AT(emca_pixel, x, 0);
AT(emca_pixel, y, 4);

SIZE(emca_rect, 16);
AT(emca_rect, x0, 0);
AT(emca_rect, y0, 4);
AT(emca_rect, x1, 8);
AT(emca_rect, y1, 12);

SIZE(emca_vec2f, 8);
AT(emca_vec2f, x, 0);
AT(emca_vec2f, y, 4);

SIZE(emca_vec3f, 12);
AT(emca_vec3f, x, 0);
AT(emca_vec3f, y, 4);
AT(emca_vec3f, z, 8);

SIZE(emca_vec2d, 16);
AT(emca_vec2d, x, 0);
AT(emca_vec2d, y, 8);

SIZE(emca_vec3d, 24);
AT(emca_vec3d, x, 0);
AT(emca_vec3d, y, 8);
AT(emca_vec3d, z, 16);

SIZE(emca_vec2i, 16);
AT(emca_vec2i, x, 0);
AT(emca_vec2i, y, 8);

SIZE(emca_vec3i, 24);
AT(emca_vec3i, x, 0);
AT(emca_vec3i, y, 8);
AT(emca_vec3i, z, 16);

SIZE(emca_color, 12);
AT(emca_color, r, 0);
AT(emca_color, g, 4);
AT(emca_color, b, 8);

SIZE(emca_color_a, 16);
AT(emca_color_a, r, 0);
AT(emca_color_a, g, 4);
AT(emca_color_a, b, 8);
AT(emca_color_a, a, 12);

SIZE(emca_key, 32);
AT(emca_key, text, 0);
AT(emca_key, file, 8);
AT(emca_key, line, 16);
AT(emca_key, length, 20);
AT(emca_key, hash, 24);

SIZE(emca_recording_counts, 96);
AT(emca_recording_counts, size, 0);
AT(emca_recording_counts, version, 4);
AT(emca_recording_counts, paths, 8);
AT(emca_recording_counts, vertices, 16);
AT(emca_recording_counts, columns, 24);
AT(emca_recording_counts, values, 32);
AT(emca_recording_counts, contributions, 40);
AT(emca_recording_counts, next_events, 48);
AT(emca_recording_counts, splats, 56);
AT(emca_recording_counts, bytes, 64);
AT(emca_recording_counts, dropped_by_budget, 72);
AT(emca_recording_counts, dropped_without_path, 80);
AT(emca_recording_counts, dropped_without_vertex, 88);

SIZE(emca_surface_point, 64);
AT(emca_surface_point, opaque, 0);

SIZE(emca_layer, 32);
AT(emca_layer, opaque, 0);

SIZE(emca_layer_description, 40);
AT(emca_layer_description, size, 0);
AT(emca_layer_description, version, 4);
AT(emca_layer_description, name, 8);
AT(emca_layer_description, unit, 16);
AT(emca_layer_description, description, 24);
AT(emca_layer_description, kind, 32);
AT(emca_layer_description, reserved, 36);

SIZE(emca_info, 88);
AT(emca_info, size, 0);
AT(emca_info, version, 4);
AT(emca_info, renderer, 8);
AT(emca_info, scene, 16);
AT(emca_info, integrator, 24);
AT(emca_info, sampler, 32);
AT(emca_info, seed, 40);
AT(emca_info, width, 48);
AT(emca_info, height, 52);
AT(emca_info, samples_per_pixel, 56);
AT(emca_info, threads, 60);
AT(emca_info, concurrent, 64);
AT(emca_info, deterministic, 68);
AT(emca_info, paths_reach_any_pixel, 72);
AT(emca_info, capability_count, 76);
AT(emca_info, capabilities, 80);

SIZE(emca_camera, 72);
AT(emca_camera, size, 0);
AT(emca_camera, version, 4);
AT(emca_camera, kind, 8);
AT(emca_camera, right_handed, 12);
AT(emca_camera, position, 16);
AT(emca_camera, direction, 28);
AT(emca_camera, up, 40);
AT(emca_camera, vertical_field_of_view, 52);
AT(emca_camera, near_clip, 56);
AT(emca_camera, far_clip, 60);
AT(emca_camera, focus_distance, 64);
AT(emca_camera, aperture_radius, 68);

SIZE(emca_settings, 40);
AT(emca_settings, size, 0);
AT(emca_settings, version, 4);
AT(emca_settings, samples_per_pixel, 8);
AT(emca_settings, has_seed, 12);
AT(emca_settings, seed, 16);
AT(emca_settings, integrator, 24);
AT(emca_settings, sampler, 32);

SIZE(emca_image, 48);
AT(emca_image, size, 0);
AT(emca_image, version, 4);
AT(emca_image, width, 8);
AT(emca_image, height, 12);
AT(emca_image, color, 16);
AT(emca_image, samples, 24);
AT(emca_image, variance, 32);
AT(emca_image, has_samples, 40);
AT(emca_image, has_variance, 44);

SIZE(emca_mesh, 80);
AT(emca_mesh, size, 0);
AT(emca_mesh, version, 4);
AT(emca_mesh, name, 8);
AT(emca_mesh, material, 16);
AT(emca_mesh, positions, 24);
AT(emca_mesh, triangles, 32);
AT(emca_mesh, position_count, 40);
AT(emca_mesh, triangle_count, 48);
AT(emca_mesh, diffuse, 56);
AT(emca_mesh, emission, 68);

SIZE(emca_renderer, 80);
AT(emca_renderer, size, 0);
AT(emca_renderer, version, 4);
AT(emca_renderer, user, 8);
AT(emca_renderer, info, 16);
AT(emca_renderer, camera, 24);
AT(emca_renderer, meshes, 32);
AT(emca_renderer, render_image, 40);
AT(emca_renderer, render_pixel, 48);
AT(emca_renderer, render_pixels, 56);
AT(emca_renderer, surface_layers, 64);
AT(emca_renderer, render_image_with_layers, 72);

SIZE(emca_server_options, 104);
AT(emca_server_options, size, 0);
AT(emca_server_options, version, 4);
AT(emca_server_options, host, 8);
AT(emca_server_options, token, 16);
AT(emca_server_options, port, 24);
AT(emca_server_options, reserved, 26);
AT(emca_server_options, allow_quit, 28);
AT(emca_server_options, maximum_clients, 32);
AT(emca_server_options, maximum_samples_per_pixel, 36);
AT(emca_server_options, maximum_pixels_per_trace, 40);
AT(emca_server_options, kept_images, 44);
AT(emca_server_options, kept_surfaces, 48);
AT(emca_server_options, handshake_timeout, 52);
AT(emca_server_options, default_budget, 56);
AT(emca_server_options, maximum_budget, 64);
AT(emca_server_options, surface_budget, 72);
AT(emca_server_options, maximum_surface_budget, 80);
AT(emca_server_options, log_user, 88);
AT(emca_server_options, log, 96);

SIZE(emca_tool, 88);
AT(emca_tool, size, 0);
AT(emca_tool, version, 4);
AT(emca_tool, user, 8);
AT(emca_tool, name, 16);
AT(emca_tool, answer, 24);
AT(emca_tool, added, 32);
AT(emca_tool, begin_pixel, 40);
AT(emca_tool, end_pixel, 48);
AT(emca_tool, begin_path, 56);
AT(emca_tool, end_path, 64);
AT(emca_tool, begin_vertex, 72);
AT(emca_tool, end_vertex, 80);

SIZE(emca_probe_request, 32);
AT(emca_probe_request, size, 0);
AT(emca_probe_request, version, 4);
AT(emca_probe_request, seed, 8);
AT(emca_probe_request, samples_per_pixel, 16);
AT(emca_probe_request, maximum_depth, 20);
AT(emca_probe_request, integrator, 24);

SIZE(emca_light_probe, 48);
AT(emca_light_probe, size, 0);
AT(emca_light_probe, version, 4);
AT(emca_light_probe, user, 8);
AT(emca_light_probe, surface_offset, 16);
AT(emca_light_probe, threads, 20);
AT(emca_light_probe, radiance, 24);
AT(emca_light_probe, begin, 32);
AT(emca_light_probe, end, 40);

_Static_assert(EMCA_OK == 0, "");
_Static_assert(EMCA_INTERNAL == 1, "");
_Static_assert(EMCA_INVALID_ARGUMENT == 2, "");
_Static_assert(EMCA_PIXEL_OUT_OF_RANGE == 3, "");
_Static_assert(EMCA_NOT_SUPPORTED == 4, "");
_Static_assert(EMCA_FILE_NOT_FOUND == 5, "");
_Static_assert(EMCA_FILE_UNREADABLE == 6, "");
_Static_assert(EMCA_FILE_UNWRITABLE == 7, "");
_Static_assert(EMCA_CONNECTION_FAILED == 8, "");
_Static_assert(EMCA_CONNECTION_LOST == 9, "");
_Static_assert(EMCA_TIMED_OUT == 10, "");
_Static_assert(EMCA_PROTOCOL_VIOLATION == 11, "");
_Static_assert(EMCA_VERSION_MISMATCH == 12, "");
_Static_assert(EMCA_REFUSED == 13, "");
_Static_assert(EMCA_TOO_LARGE == 14, "");
_Static_assert(EMCA_CANCELLED == 15, "");
_Static_assert(EMCA_RENDERER_FAILED == 16, "");
_Static_assert(EMCA_ADDRESS_IN_USE == 17, "");
_Static_assert(EMCA_PARSE_FAILED == 18, "");
_Static_assert(EMCA_OUT_OF_MEMORY == 19, "");
_Static_assert(EMCA_CAMERA_SUBPATH == 0, "");
_Static_assert(EMCA_LIGHT_SUBPATH == 1, "");
_Static_assert(EMCA_EVENT_NONE == 0, "");
_Static_assert(EMCA_REFLECT == 1, "");
_Static_assert(EMCA_TRANSMIT == 2, "");
_Static_assert(EMCA_VOLUME == 3, "");
_Static_assert(EMCA_EMISSION == 4, "");
_Static_assert(EMCA_BACKGROUND == 5, "");
_Static_assert(EMCA_ABSORB == 6, "");
_Static_assert(EMCA_PASS == 7, "");
_Static_assert(EMCA_LOBE_NONE == 0, "");
_Static_assert(EMCA_DIFFUSE == 1, "");
_Static_assert(EMCA_GLOSSY == 2, "");
_Static_assert(EMCA_SPECULAR == 3, "");
_Static_assert(EMCA_STRAIGHT == 4, "");
_Static_assert(EMCA_LIGHT_AUTOMATIC == 0, "");
_Static_assert(EMCA_LIGHT_HIT == 1, "");
_Static_assert(EMCA_LIGHT_CONNECTED == 2, "");
_Static_assert(EMCA_LAYER_MEAN == 0, "");
_Static_assert(EMCA_LAYER_MEAN_COLOR == 1, "");
_Static_assert(EMCA_LAYER_SUM == 2, "");
_Static_assert(EMCA_LAYER_DENSITY == 3, "");
_Static_assert(EMCA_PERSPECTIVE == 0, "");
_Static_assert(EMCA_SPHERICAL == 1, "");
_Static_assert(EMCA_ORTHOGRAPHIC == 2, "");
_Static_assert(EMCA_OTHER_CAMERA == 3, "");
