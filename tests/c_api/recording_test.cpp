// Recordings of one's own, scopes, keys, and calls that make no sense.
#include <cstring>
#include <limits>
#include <string>
#include <thread>
#include <vector>

#include "emca/emca.h"
#include "emca/recorder/key.h"
#include "gtest/gtest.h"

namespace emca::test {
namespace {

/// With a scope of this thread, until counts().
class OwnRecording {
  public:
    explicit OwnRecording(std::uint64_t budget = 0) {
        EXPECT_EQ(emca_recording_create(budget, &recording, nullptr), EMCA_OK);
        const emca_pixel pixel = {0, 0};
        EXPECT_EQ(emca_scope_open(recording, &pixel, &scope, nullptr), EMCA_OK);
    }
    ~OwnRecording() {
        emca_scope_close(scope, nullptr);
        emca_recording_destroy(recording);
    }
    OwnRecording(const OwnRecording&) = delete;
    OwnRecording& operator=(const OwnRecording&) = delete;

    emca_recording_counts counts() {
        EXPECT_EQ(emca_scope_close(scope, nullptr), EMCA_OK);
        scope = nullptr;
        emca_recording_counts found = {EMCA_SIZED(emca_recording_counts)};
        emca_error error{};
        EXPECT_EQ(emca_recording_finish(recording, &found, &error), EMCA_OK) << error.message;
        return found;
    }

    emca_recording* recording = nullptr;
    emca_scope* scope = nullptr;
};

TEST(RecorderInC, IsNullOutsideOfScopes) {
    EXPECT_EQ(emca_thread_recorder(), nullptr);
    {
        OwnRecording own;
        emca_recorder* emca = emca_thread_recorder();
        EXPECT_NE(emca, nullptr);
        std::thread([] { EXPECT_EQ(emca_thread_recorder(), nullptr) << "another thread"; }).join();
        own.counts();
        EXPECT_EQ(emca_thread_recorder(), nullptr);
        emca_set_path_index(emca, 1, 0);  // too late, and harmless
    }
    emca_set_path_index(nullptr, 1, 0);
    (emca_set_path_index)(nullptr, 1, 0);
    EXPECT_EQ(emca_at_path(nullptr, {0, 0}, 0, 0), nullptr);
    EXPECT_EQ(emca_at_vertex(nullptr, {0, 0}, 0, 0, 1, EMCA_CAMERA_SUBPATH), nullptr);
}

TEST(RecorderInC, CountsWhatItHolds) {
    OwnRecording own;
    static emca_key key = EMCA_KEY("value");
    emca_recorder* emca = emca_thread_recorder();
    emca_set_intersection_pos(emca, {0, 0, 0});  // before any vertex
    for (int sample = 0; sample < 5; ++sample) {
        emca_set_path_index(emca, sample, 0);
        emca_add_splat(emca, {1, 1}, {1, 1, 1});
        for (int depth = 1; depth <= 3; ++depth) {
            emca_set_depth_index(emca, depth, EMCA_CAMERA_SUBPATH);
            emca_add_intersection_float(emca, &key, 1);
            emca_add_intersection_int(emca, &key, 1);
            emca_add_contribution(emca, {1, 1, 1}, nullptr, 1, EMCA_LIGHT_AUTOMATIC);
            emca_set_next_event_estimation_pos(emca, {0, 0, 0}, true);
        }
    }
    const emca_recording_counts counts = own.counts();
    EXPECT_EQ(counts.paths, 5u);
    EXPECT_EQ(counts.vertices, 15u);
    EXPECT_EQ(counts.columns, 2u) << "a key that comes with two types";
    EXPECT_EQ(counts.values, 30u);
    EXPECT_EQ(counts.contributions, 15u);
    EXPECT_EQ(counts.next_events, 15u);
    EXPECT_EQ(counts.splats, 5u);
    EXPECT_EQ(counts.dropped_without_vertex, 1u);
    EXPECT_EQ(counts.dropped_by_budget, 0u);
    EXPECT_GT(counts.bytes, 0u);
    EXPECT_EQ(emca_recording_finish(own.recording, nullptr, nullptr), EMCA_INVALID_ARGUMENT);
    emca_recording_counts again = {EMCA_SIZED(emca_recording_counts)};
    EXPECT_EQ(emca_recording_finish(own.recording, &again, nullptr), EMCA_INVALID_ARGUMENT) << "a second time";
    EXPECT_EQ(emca_at_path(own.recording, {0, 0}, 0, 0), nullptr) << "it is finished";
}

TEST(RecorderInC, KeepsToItsBudget) {
    OwnRecording own(1 << 16);
    static emca_key key = EMCA_KEY("value");
    emca_recorder* emca = emca_thread_recorder();
    emca_set_path_index(emca, 0, 0);
    emca_set_depth_index(emca, 1, EMCA_CAMERA_SUBPATH);
    for (int i = 0; i < 100000; ++i) emca_add_intersection_double3(emca, &key, {1, 2, 3});
    const emca_recording_counts counts = own.counts();
    EXPECT_GT(counts.dropped_by_budget, 0u);
    EXPECT_EQ(counts.dropped_by_budget + counts.values, 100000u);
}

TEST(KeysInC, AreHashedOnceByAnyThread) {
    static emca_key lazy = EMCA_KEY("a key of some length");
    emca_key made = emca_make_key("a key of some length");
    EXPECT_EQ(made.hash, hashKey("a key of some length"));
    EXPECT_EQ(made.length, 20u);
    EXPECT_EQ(lazy.hash, 0u) << "nothing happens while nothing is recorded";
    emca_add_intersection_float(nullptr, &lazy, 1);
    EXPECT_EQ(lazy.hash, 0u);
    OwnRecording own;
    std::vector<std::thread> threads;
    for (int t = 0; t < 4; ++t)
        threads.emplace_back([&, t] {
            for (int sample = 0; sample < 100; ++sample)
                emca_add_intersection_float(emca_at_vertex(own.recording, {0, 0}, sample, 0, t, EMCA_CAMERA_SUBPATH),
                                            &lazy, 1);
        });
    for (std::thread& thread : threads) thread.join();
    EXPECT_EQ(lazy.hash, made.hash);
    EXPECT_EQ(lazy.length, made.length);
    emca_add_path_float(emca_at_path(own.recording, {0, 0}, 0, 0), &made, 1);
    const emca_recording_counts counts = own.counts();
    EXPECT_EQ(counts.paths, 100u);
    EXPECT_EQ(counts.values, 401u);
    EXPECT_EQ(counts.columns, 2u) << "of vertices and of paths";
    EXPECT_EQ(std::strlen(emca_make_key(nullptr).text), 0u);
}

TEST(ScopesInC, BelongToTheirThreadAndNest) {
    OwnRecording own;
    emca_scope* inner = nullptr;
    ASSERT_EQ(emca_scope_open(own.recording, nullptr, &inner, nullptr), EMCA_OK);
    emca_error error{};
    EXPECT_EQ(emca_scope_close(own.scope, &error), EMCA_INVALID_ARGUMENT) << "the inner one is open";
    EXPECT_STRNE(error.message, "");
    std::thread([&] { EXPECT_EQ(emca_scope_close(inner, &error), EMCA_INVALID_ARGUMENT); }).join();
    EXPECT_EQ(emca_scope_close(inner, &error), EMCA_OK);
    EXPECT_NE(emca_thread_recorder(), nullptr) << "the outer one counts again";
    EXPECT_EQ(emca_scope_close(nullptr, nullptr), EMCA_OK);
    EXPECT_EQ(emca_scope_open(nullptr, nullptr, &inner, &error), EMCA_INVALID_ARGUMENT);
    EXPECT_EQ(inner, nullptr);
    EXPECT_EQ(emca_scope_open(own.recording, nullptr, nullptr, &error), EMCA_INVALID_ARGUMENT);
    own.counts();
    EXPECT_EQ(emca_scope_open(own.recording, nullptr, &inner, &error), EMCA_INVALID_ARGUMENT) << "finished";
    EXPECT_EQ(emca_recording_create(0, nullptr, &error), EMCA_INVALID_ARGUMENT);
    emca_recording_destroy(nullptr);
}

TEST(RecorderInC, IgnoresAndCountsWhatMakesNoSense) {
    OwnRecording own;
    static emca_key key = EMCA_KEY("value");
    emca_key empty = EMCA_KEY("value");
    empty.text = nullptr;
    emca_recorder* emca = emca_thread_recorder();
    emca_set_path_index(emca, 0, 0);
    emca_set_depth_index(emca, 1, EMCA_CAMERA_SUBPATH);
    const std::uint64_t before = emca_misuse(nullptr);
    emca_set_depth_index(emca, 2, 2);
    emca_set_intersection_event(emca, 8, EMCA_DIFFUSE, nullptr);
    emca_set_intersection_event(emca, EMCA_REFLECT, -1, nullptr);
    emca_add_contribution(emca, {1, 1, 1}, "x", 1, 3);
    emca_set_intersection_surface(emca, -1, 0);
    emca_set_intersection_surface(emca, 0, std::int64_t(1) << 31);
    emca_add_intersection_float(emca, nullptr, 1);
    emca_add_path_float(emca, &empty, 1);
    emca_add_intersection_spectrum(emca, &key, nullptr, 3);
    emca_add_path_spectrum(emca, &key, nullptr, 3);
    EXPECT_EQ(emca_at_vertex(own.recording, {0, 0}, 0, 0, 1, 7), nullptr);
    EXPECT_EQ(emca_misuse(nullptr) - before, 11u);
    emca_error first{};
    EXPECT_GT(emca_misuse(&first), 0u);
    EXPECT_NE(std::strstr(first.message, "was ignored: "), nullptr) << first.message;
    // And what makes sense, on the border of it.
    emca_add_intersection_spectrum(emca, &key, nullptr, 0);
    emca_add_intersection_text(emca, &key, nullptr);
    emca_set_intersection_event(emca, EMCA_PASS, EMCA_STRAIGHT, nullptr);
    emca_set_intersection_surface(emca, 0x7fffffff, 0);
    EXPECT_EQ(emca_misuse(nullptr) - before, 11u);
    const emca_recording_counts counts = own.counts();
    EXPECT_EQ(counts.vertices, 1u);
    EXPECT_EQ(counts.contributions, 0u);
    EXPECT_EQ(counts.values, 2u);
}

TEST(SurfacesInC, AreInertWhereNothingIsCollected) {
    const emca_layer layer = emca_find_layer(nullptr, "density");
    emca_surface_cursor* cursor = emca_thread_surface_cursor(nullptr);
    EXPECT_EQ(cursor, nullptr);
    for (const emca_surface_point& at :
         {emca_locate(cursor, 0, 0, {0, 0, 0}), (emca_locate)(cursor, 0, 0, {0, 0, 0}),
          emca_locate_barycentric(cursor, 0, 0, {0, 0}), (emca_locate_barycentric)(cursor, 0, 0, {0, 0})}) {
        emca_layer_add(layer, &at, 1);
        (emca_layer_add_color)(layer, &at, {1, 1, 1});
        EXPECT_EQ(at.opaque[0], 0u);
    }
    emca_pass_done(nullptr, 0.5);
    emca_layer added;
    const emca_layer_description description = {EMCA_SIZED(emca_layer_description), .name = "density"};
    EXPECT_EQ(emca_add_surface_layer(nullptr, &description, &added, nullptr), EMCA_INVALID_ARGUMENT);
}

}  // namespace
}  // namespace emca::test
