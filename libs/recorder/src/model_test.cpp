// Random calls from several threads, against a recording as simple as can be: maps of vectors.
#include <gtest/gtest.h>

#include <latch>
#include <map>
#include <optional>
#include <random>
#include <string>
#include <thread>
#include <tuple>
#include <vector>

#include "emca/recorder/recorder.h"

namespace emca {
namespace {

struct ModelVertex {
    std::optional<Vec3f> position;
    std::optional<Color> estimate, emission;
    std::optional<std::pair<std::int32_t, std::int32_t>> surface;
    std::optional<std::tuple<Event, Lobe, std::string>> event;
    std::vector<std::pair<Vec3f, bool>> nextEvents;
    std::vector<std::tuple<Color, std::string, LightEnd>> contributions;
    std::map<std::pair<std::string, ValueType>, std::vector<Value>> values;
};

struct ModelPath {
    std::optional<Vec3f> origin;
    std::optional<Color> estimate;
    std::vector<std::pair<Pixel, Color>> splats;
    std::map<std::pair<Subpath, std::int32_t>, ModelVertex> vertices;
    std::map<std::pair<std::string, ValueType>, std::vector<Value>> values;
};

using Model = std::map<std::tuple<Pixel, std::int64_t, std::int32_t>, ModelPath>;

bool isAsked(Pixel pixel) { return pixel.x % 2 == 0; }

/// The same random calls to a recorder and to a model.
class Caller {
  public:
    Caller(unsigned seed, PathRecorder& recorder, Model& model) : random_(seed), emca_(recorder), model_(model) {}

    void run(int paths) {
        for (int p = 0; p < paths; ++p) path();
    }

  private:
    int upTo(int n) { return int(random_() % unsigned(n)); }
    float number() { return float(upTo(1000)); }
    Vec3f vector() { return {number(), number(), number()}; }
    Color color() { return Color(number(), number(), number()); }
    std::string text() { return std::string(std::size_t(upTo(40)), char('a' + upTo(3))) + char('a' + upTo(3)); }

    void path() {
        const Pixel pixel{std::uint32_t(upTo(4)), 0};
        const std::int64_t sample = upTo(30);
        const std::int32_t part = upTo(4) == 0;
        emca_.setPixel(pixel);
        emca_.setPathIndex(sample, part);
        ModelPath forgotten;
        ModelPath& path = isAsked(pixel) ? model_[{pixel, sample, part}] : forgotten;
        ModelVertex* vertex = nullptr;
        const int calls = upTo(60);
        for (int i = 0; i < calls; ++i) {
            if (!vertex || upTo(5) == 0) {
                const auto subpath = upTo(6) == 0 ? Subpath::light : Subpath::camera;
                const std::int32_t depth = upTo(3) == 0 ? upTo(9) : i;
                emca_.setDepthIndex(depth, subpath);
                vertex = &path.vertices[{subpath, depth}];
            }
            upTo(8) == 0 ? pathCall(path) : upTo(2) == 0 ? coreCall(*vertex) : userCall(vertex->values, false);
        }
        // The next path of this thread may have the same name: they are one path, in two pieces.
        emca_.endPath();
    }

    void pathCall(ModelPath& path) {
        switch (upTo(4)) {
            case 0:
                path.origin = vector();
                emca_.setPathOrigin(*path.origin);
                break;
            case 1:
                path.estimate = color();
                emca_.setFinalEstimate(*path.estimate);
                break;
            case 2: {
                // On a pixel that nobody asked for, so that it does not decide whether the path is kept.
                const Pixel pixel{1 + 2 * std::uint32_t(upTo(3)), 7};
                path.splats.push_back({pixel, color()});
                emca_.addSplat(pixel, path.splats.back().second);
                break;
            }
            default:
                userCall(path.values, true);
        }
    }

    void coreCall(ModelVertex& v) {
        switch (upTo(7)) {
            case 0:
                v.position = vector();
                emca_.setIntersectionPos(*v.position);
                break;
            case 1:
                v.estimate = color();
                emca_.setIntersectionEstimate(*v.estimate);
                break;
            case 2:
                v.emission = color();
                emca_.setIntersectionEmission(*v.emission);
                break;
            case 3:
                v.surface = {upTo(100), upTo(100)};
                emca_.setIntersectionSurface(v.surface->first, v.surface->second);
                break;
            case 4: {
                v.event = {Event(upTo(8)), Lobe(upTo(5)), upTo(2) ? text() : std::string()};
                emca_.setIntersectionEvent(std::get<0>(*v.event), std::get<1>(*v.event), std::get<2>(*v.event));
                break;
            }
            case 5:
                v.nextEvents.push_back({vector(), upTo(2) == 0});
                emca_.setNextEventEstimationPos(v.nextEvents.back().first, v.nextEvents.back().second);
                break;
            default: {
                v.contributions.push_back({color(), text(), LightEnd(upTo(3))});
                const auto& [value, technique, end] = v.contributions.back();
                emca_.addContribution(value, technique, 0.5f, end);
            }
        }
    }

    /// Few names and all types, so that names repeat; and many names, more than find a place of their own.
    void userCall(std::map<std::pair<std::string, ValueType>, std::vector<Value>>& values, bool ofPath) {
        const std::string key = upTo(3) ? "key " + std::to_string(upTo(3)) : "rare " + std::to_string(upTo(600));
        const auto add = [&](const auto& value, Value expected) {
            ofPath ? emca_.addPathData(Key(key), value) : emca_.addIntersectionData(Key(key), value);
            const ValueType type = typeOf(expected);
            values[{key, type}].push_back(std::move(expected));
        };
        switch (upTo(10)) {
            case 0: {
                const bool v = upTo(2);
                add(v, v);
                break;
            }
            case 1: {
                const int v = upTo(1000);
                add(v, std::int64_t(v));
                break;
            }
            case 2: {
                const float v = number();
                add(v, v);
                break;
            }
            case 3: {
                const Vec2f v{number(), number()};
                add(v, v);
                break;
            }
            case 4: {
                const Vec3f v = vector();
                add(v, v);
                break;
            }
            case 5: {
                const Color v = color();
                add(v, v);
                break;
            }
            case 6: {
                const Vec3d v{1, double(number()), 3};
                add(v, v);
                break;
            }
            case 7: {
                const ColorA v{1, number(), 2, 3};
                add(v, v);
                break;
            }
            case 8: {
                const std::string v = text();
                add(v, v);
                break;
            }
            default: {
                const std::vector<float> v(std::size_t(upTo(100) == 0 ? 30000 : upTo(5)), number());
                add(v, v);
            }
        }
    }

    std::mt19937 random_;
    PathRecorder& emca_;
    Model& model_;
};

/// What is not in the model is in no column, since the numbers of values agree, too.
void compareValues(const PathSet& paths, Scope scope, Index owner,
                   const std::map<std::pair<std::string, ValueType>, std::vector<Value>>& values, std::size_t& total) {
    for (const auto& [id, expected] : values) {
        const Column* found = nullptr;
        for (const Column* column : paths.find(scope, id.first))
            if (column->type == id.second) found = column;
        ASSERT_TRUE(found) << id.first << ' ' << name(id.second);
        const IndexRange range = found->valuesOf(owner);
        ASSERT_EQ(range.size(), expected.size()) << id.first;
        for (Index i = 0; i < range.size(); ++i)
            ASSERT_EQ(paths.value(*found, range.first + i), expected[i]) << id.first;
        total += expected.size();
    }
}

void compareVertex(const PathSet& paths, Index v, const ModelVertex& expected) {
    EXPECT_EQ(paths.position(v), expected.position);
    EXPECT_EQ(paths.vertexEstimate(v), expected.estimate);
    EXPECT_EQ(paths.emission(v), expected.emission);
    ASSERT_EQ(paths.surface(v).has_value(), expected.surface.has_value());
    if (expected.surface) {
        EXPECT_EQ(std::pair(paths.surface(v)->mesh, paths.surface(v)->face), *expected.surface);
    }
    // An event without kind, lobe and label may have been recorded: it is there, and says nothing.
    ASSERT_EQ((paths.columns().vertexFlags[v] & VertexFlag::hasEvent) != 0, expected.event.has_value());
    if (expected.event) {
        const auto& c = paths.columns();
        EXPECT_EQ(Event(c.events[v]), std::get<0>(*expected.event));
        EXPECT_EQ(Lobe(c.lobes[v]), std::get<1>(*expected.event));
        EXPECT_EQ(c.labels[v] == kNoString ? "" : paths.text(c.labels[v]), std::get<2>(*expected.event));
    }
    const IndexRange nextEvents = paths.nextEvents(v), contributions = paths.contributions(v);
    ASSERT_EQ(nextEvents.size(), expected.nextEvents.size());
    for (Index i = 0; i < nextEvents.size(); ++i) {
        EXPECT_EQ(paths.nextEvent(nextEvents.first + i).position, expected.nextEvents[i].first);
        EXPECT_EQ(paths.nextEvent(nextEvents.first + i).visible, expected.nextEvents[i].second ? 1u : 0u);
    }
    ASSERT_EQ(contributions.size(), expected.contributions.size());
    for (Index i = 0; i < contributions.size(); ++i) {
        const Contribution& found = paths.contribution(contributions.first + i);
        EXPECT_EQ(std::tuple(found.value, std::string(paths.text(found.technique)), found.end),
                  expected.contributions[i]);
    }
}

void compare(const PathSet& paths, const Model& model) {
    ASSERT_EQ(paths.pathCount(), model.size());
    Index p = 0;
    std::size_t total = 0;
    for (const auto& [id, expected] : model) {
        ASSERT_EQ(std::tuple(paths.pixel(p), paths.sample(p), paths.part(p)), id);
        EXPECT_EQ(paths.origin(p), expected.origin);
        EXPECT_EQ(paths.estimate(p), expected.estimate);
        const IndexRange splats = paths.splats(p), vertices = paths.vertices(p);
        ASSERT_EQ(splats.size(), expected.splats.size());
        for (Index i = 0; i < splats.size(); ++i) {
            EXPECT_EQ(paths.columns().splats[splats.first + i].pixel, expected.splats[i].first);
            EXPECT_EQ(paths.columns().splats[splats.first + i].value, expected.splats[i].second);
        }
        ASSERT_NO_FATAL_FAILURE(compareValues(paths, Scope::path, p, expected.values, total));
        ASSERT_EQ(vertices.size(), expected.vertices.size());
        Index v = vertices.first;
        for (const auto& [place, vertex] : expected.vertices) {
            ASSERT_EQ(std::pair(paths.subpath(v), paths.depthIndex(v)), place);
            ASSERT_NO_FATAL_FAILURE(compareVertex(paths, v, vertex));
            ASSERT_NO_FATAL_FAILURE(compareValues(paths, Scope::vertex, v, vertex.values, total));
            ++v;
        }
        ++p;
    }
    std::size_t recorded = 0;
    for (const Column& column : paths.userColumns()) recorded += column.count;
    EXPECT_EQ(recorded, total);
}

TEST(Model, RandomCallsFromSeveralThreads) {
    constexpr int kThreads = 3;
    for (unsigned seed = 0; seed < 4; ++seed) {
        Recording recording({.pixels = {{0, 0}, {2, 0}}});
        Model models[kThreads];
        // The scopes open in the order of the threads, since that is the order of what they add to the same path. All
        // of them are open while the threads record at the same time.
        std::optional<std::latch> opened[kThreads];
        for (auto& latch : opened) latch.emplace(1);
        std::vector<std::thread> threads;
        for (int t = 0; t < kThreads; ++t)
            threads.emplace_back([&, t] {
                if (t > 0) opened[t - 1]->wait();
                const RecordScope scope(recording, {0, 0});
                opened[t]->count_down();
                opened[kThreads - 1]->wait();
                Caller(seed * 10 + unsigned(t), recorder(), models[t]).run(150);
            });
        for (std::thread& thread : threads) thread.join();
        Model whole;
        for (const Model& model : models)
            for (const auto& [id, part] : model) {
                ModelPath& path = whole[id];
                if (part.origin) path.origin = part.origin;
                if (part.estimate) path.estimate = part.estimate;
                path.splats.insert(path.splats.end(), part.splats.begin(), part.splats.end());
                const auto append = [](auto& to, const auto& from) {
                    for (const auto& [key, values] : from) to[key].insert(to[key].end(), values.begin(), values.end());
                };
                append(path.values, part.values);
                for (const auto& [place, from] : part.vertices) {
                    ModelVertex& to = path.vertices[place];
                    if (from.position) to.position = from.position;
                    if (from.estimate) to.estimate = from.estimate;
                    if (from.emission) to.emission = from.emission;
                    if (from.surface) to.surface = from.surface;
                    if (from.event) to.event = from.event;
                    to.nextEvents.insert(to.nextEvents.end(), from.nextEvents.begin(), from.nextEvents.end());
                    to.contributions.insert(to.contributions.end(), from.contributions.begin(),
                                            from.contributions.end());
                    append(to.values, from.values);
                }
            }
        auto paths = recording.finish();
        ASSERT_TRUE(paths.ok()) << paths.error().message;
        EXPECT_GT(recording.stats().pathsNotKept, 50u);
        EXPECT_EQ(recording.stats().droppedByBudget, 0u);
        ASSERT_NO_FATAL_FAILURE(compare(*paths, whole)) << "seed " << seed;
    }
}

}  // namespace
}  // namespace emca
