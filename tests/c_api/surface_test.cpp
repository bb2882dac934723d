// Surface layers through C: what is asked for is collected, and nothing else.
#include <cmath>

#include "everything.h"
#include "served_in_c.h"

namespace emca::test {
namespace {

constexpr float kNotANumber = std::numeric_limits<float>::quiet_NaN();

emca_code announce(void*, emca_layer_list* list, emca_error* error) {
    const emca_layer_description layers[3] = {
        {EMCA_SIZED(emca_layer_description), .name = "count", .unit = "1/m^2", .description = "Points.",
         .kind = EMCA_LAYER_DENSITY},
        {EMCA_SIZED(emca_layer_description), .name = "color", .kind = EMCA_LAYER_MEAN_COLOR},
        {EMCA_SIZED(emca_layer_description), .name = "never asked for", .kind = EMCA_LAYER_SUM}};
    for (const emca_layer_description& layer : layers)
        if (const emca_code code = emca_add_layer(list, &layer, error); code != EMCA_OK) return code;
    return EMCA_OK;
}

/// The scene of everything.c is one triangle, (0, 0, 0), (1, 0, 0), (0, 1, 0).
emca_code collect(void*, const emca_settings*, emca_surface* surface, emca_monitor*, emca_image*, emca_error* error) {
    const emca_layer count = emca_find_layer(surface, "count"), color = emca_find_layer(surface, "color");
    const emca_layer unwanted = emca_find_layer(surface, "never asked for"),
                     unknown = emca_find_layer(surface, "no such layer");
    emca_layer own, twice;
    const emca_layer_description description = {EMCA_SIZED(emca_layer_description), .name = "own",
                                                .kind = EMCA_LAYER_SUM};
    if (const emca_code code = emca_add_surface_layer(surface, &description, &own, error); code != EMCA_OK) return code;
    if (emca_add_surface_layer(surface, &description, &twice, nullptr) != EMCA_INVALID_ARGUMENT || twice.opaque[0] != 0)
        return emca_fail(error, EMCA_INTERNAL, "A name was taken twice.");
    emca_surface_cursor* cursor = emca_thread_surface_cursor(surface);
    for (int i = 0; i < 10; ++i) {
        if (i == 5) emca_pass_done(surface, 0.5);
        const emca_surface_point at = i % 2 ? emca_locate(cursor, 0, 0, {0.25f, 0.25f, 7})
                                            : emca_locate_barycentric(cursor, 0, 0, {0.25f, 0.25f});
        emca_layer_add(count, &at, 1);
        emca_layer_add_color(color, &at, {1, 2, float(i)});
        emca_layer_add(own, &at, 0.5f);
        emca_layer_add(unwanted, &at, 100);
        emca_layer_add_color(unknown, &at, {100, 100, 100});
    }
    for (const emca_surface_point& nowhere :
         {emca_locate(cursor, 1, 0, {0, 0, 0}), emca_locate(cursor, 0, 1, {0, 0, 0}),
          emca_locate(cursor, 0, 0, {kNotANumber, 0, 0}), emca_locate_barycentric(cursor, 0, 0, {kNotANumber, 0})})
        emca_layer_add(count, &nowhere, 1);
    const emca_surface_point at = emca_locate(cursor, 0, 0, {0.25f, 0.25f, 0});
    emca_layer_add(count, &at, kNotANumber);
    emca_layer_add(count, nullptr, 1);  // ignored and counted, as is:
    emca_pass_done(surface, 1.5);
    return EMCA_OK;
}

TEST(SurfacesInC, HoldWhatWasAskedFor) {
    emca_renderer renderer = everything();
    renderer.surface_layers = announce;
    renderer.render_image_with_layers = collect;
    ServedInC served(renderer);
    const auto info = served.client().info();
    ASSERT_TRUE(info.ok());
    ASSERT_EQ(info->layers.size(), 3u);
    const std::uint64_t misuses = emca_misuse(nullptr);
    const auto render = served.client().render({.layers = {"count", "color"}});
    ASSERT_TRUE(render.ok()) << render.error().message;
    EXPECT_EQ(emca_misuse(nullptr) - misuses, 2u);
    const auto field = served.client().surface(render->id);
    ASSERT_TRUE(field.ok()) << field.error().message;
    ASSERT_NE(field->find("count"), nullptr);
    EXPECT_EQ(field->find("never asked for"), nullptr);
    const SurfaceLayerData &count = *field->find("count"), &color = *field->find("color"), &own = *field->find("own");
    EXPECT_EQ(field->counts.points, 11u);
    EXPECT_EQ(field->counts.invalid, 5u) << "four places and one value";
    EXPECT_EQ(count.samples, 10u);
    EXPECT_EQ(count.total, 10);
    EXPECT_EQ(count.description.unit, "1/m^2");
    EXPECT_EQ(field->value(count, 0, 0), 20) << "ten on an area of a half";
    EXPECT_EQ(field->value(color, 0, 0, 1), 2);
    EXPECT_FLOAT_EQ(field->value(color, 0, 0, 2), 4.5f);
    EXPECT_EQ(field->value(own, 0, 0), 5);
}

TEST(SurfacesInC, AreRefusedWhereNobodyOffersThem) {
    ServedInC served(everything());
    EXPECT_FALSE(served.client().render({.layers = {"count"}}).ok());
}

}  // namespace
}  // namespace emca::test
