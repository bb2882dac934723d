// Tools made of functions: answers, errors, other tools, and data that they add to a replay.
#include <atomic>
#include <cmath>
#include <cstring>
#include <string>

#include "emca/probe/light_probe.h"
#include "everything.h"
#include "path_text.h"
#include "served_in_c.h"

namespace emca::test {
namespace {

std::vector<std::byte> bytes(const std::string& text) {
    const auto* first = reinterpret_cast<const std::byte*>(text.data());
    return {first, first + text.size()};
}
std::string text(const std::vector<std::byte>& given) {
    return {reinterpret_cast<const char*>(given.data()), given.size()};
}

emca_code reversed(void*, const void* request, std::size_t count, emca_monitor* monitor, emca_reply* reply,
                   emca_error* error) {
    const auto* from = static_cast<const char*>(request);
    if (count == 0) return emca_fail(error, EMCA_INVALID_ARGUMENT, "Nothing to turn round.");
    for (std::size_t i = count; i-- > 0;)
        if (const emca_code code = emca_reply_append(reply, from + i, 1, error); code != EMCA_OK) return code;
    emca_progress(monitor, 1);
    return emca_reply_append(reply, nullptr, 0, error);
}

struct Asker {
    emca_tool_host* host = nullptr;
};
emca_code ask(void* user, const void* request, std::size_t count, emca_monitor* monitor, emca_reply* reply,
              emca_error* error) {
    const auto* asker = static_cast<Asker*>(user);
    if (emca_ask_tool(nullptr, "reversed", request, count, monitor, reply, nullptr) != EMCA_INVALID_ARGUMENT)
        return EMCA_INTERNAL;
    if (emca_ask_tool(asker->host, nullptr, request, count, monitor, reply, nullptr) != EMCA_INVALID_ARGUMENT)
        return EMCA_INTERNAL;
    if (const emca_code code = emca_reply_append(reply, "[", 1, error); code != EMCA_OK) return code;
    return emca_ask_tool(asker->host, count == 1 ? "nobody" : "reversed", request, count, monitor, reply, error);
}

TEST(ToolsInC, AnswerAndAskEachOther) {
    ServedInC served(everything());
    Asker asker;
    const emca_tool first = {EMCA_SIZED(emca_tool), .name = "reversed", .answer = reversed};
    const emca_tool second = {
        EMCA_SIZED(emca_tool), .user = &asker, .name = "asker", .answer = ask,
        .added = [](void* user, emca_tool_host* host) { static_cast<Asker*>(user)->host = host; }};
    emca_error error{};
    ASSERT_EQ(emca_server_add_tool(served.server(), &first, &error), EMCA_OK) << error.message;
    ASSERT_EQ(emca_server_add_tool(served.server(), &second, &error), EMCA_OK) << error.message;
    EXPECT_EQ(emca_server_add_tool(served.server(), &second, &error), EMCA_INVALID_ARGUMENT) << "the name is taken";
    const auto reply = served.client().askTool("reversed", bytes("abc"));
    ASSERT_TRUE(reply.ok());
    EXPECT_EQ(text(*reply), "cba");
    EXPECT_EQ(served.client().askTool("reversed", {}).error().message, "Nothing to turn round.");
    EXPECT_EQ(text(served.client().askTool("asker", bytes("abc")).value()), "[cba");
    EXPECT_EQ(served.client().askTool("asker", bytes("a")).error().code, ErrorCode::notSupported);
}

TEST(ToolsInC, AddToReplays) {
    struct Told {
        std::string events;
    } told;
    const auto user = [](void* given) -> std::string& { return static_cast<Told*>(given)->events; };
    static const auto log = user;
    static emca_key note = EMCA_KEY("note");
    const emca_tool tool = {
        EMCA_SIZED(emca_tool),
        .user = &told,
        .name = "observer",
        .answer = reversed,
        .begin_pixel = [](void* u, emca_pixel p) { log(u) += "<" + std::to_string(p.x) + "," + std::to_string(p.y); },
        .end_pixel = [](void* u, emca_pixel) { log(u) += ">"; },
        .begin_path =
            [](void* u, emca_pixel, std::int64_t sample) {
                log(u) += " (" + std::to_string(sample);
                emca_add_path_int(emca_thread_recorder(), &note, sample);
            },
        .end_path = [](void* u, emca_pixel, std::int64_t) { log(u) += ")"; },
        .begin_vertex = [](void* u, std::int32_t depth) { log(u) += "[" + std::to_string(depth); },
        .end_vertex = [](void* u, std::int32_t) { log(u) += "]"; }};
    ServedInC served(everything());
    ASSERT_EQ(emca_server_add_tool(served.server(), &tool, nullptr), EMCA_OK);
    const auto trace = served.client().tracePixel({4, 3}, {.samplesPerPixel = 1});
    ASSERT_TRUE(trace.ok());
    EXPECT_EQ(told.events, "<4,3 (10[3][2][1][1][3][4])>");
    EXPECT_NE(pathText(trace->paths).find("note int 10"), std::string::npos);
}

/// What the threads of a probe have of their own.
struct ProbeLog {
    std::atomic<int> open = 0, began = 0;
    bool refuse = false;
};
struct ProbeWorker {
    ProbeLog* log;
    int rays = 0;
};

TEST(LightProbeInC, HasWorkersPerThread) {
    ServedInC served(everything());
    ProbeLog log;
    const emca_light_probe probe = {
        EMCA_SIZED(emca_light_probe),
        .user = &log,
        .surface_offset = 0.5f,
        .threads = 2,
        .radiance =
            [](void* worker, const emca_probe_request* request, emca_vec3f origin, emca_vec3f direction,
               emca_pixel pixel, std::uint32_t sample) {
                ++static_cast<ProbeWorker*>(worker)->rays;
                // The normal is upwards: the ray starts 0.5 above or below.
                return emca_color{origin.y, std::copysign(0.5f, direction.y),
                                  float(request->maximum_depth) + float(pixel.x) * 1024.f + float(sample) * 0};
            },
        .begin = [](void* user, const emca_probe_request* request, void** worker, emca_error* error) -> emca_code {
            auto* own = static_cast<ProbeLog*>(user);
            if (std::strcmp(request->integrator, "path") != 0)
                return emca_fail(error, EMCA_NOT_SUPPORTED, "Only \"path\" is known.");
            ++own->open, ++own->began;
            *worker = new ProbeWorker{own};
            return EMCA_OK;
        },
        .end =
            [](void* user, void* worker) {
                EXPECT_EQ(user, static_cast<ProbeWorker*>(worker)->log);
                --static_cast<ProbeLog*>(user)->open;
                delete static_cast<ProbeWorker*>(worker);
            }};
    emca_error error{};
    ASSERT_EQ(emca_server_add_light_probe(served.server(), &probe, &error), EMCA_OK) << error.message;
    EXPECT_EQ(emca_server_add_light_probe(served.server(), &probe, &error), EMCA_INVALID_ARGUMENT) << "there is one";
    probe::LightProbeRequest request{
        .position = {0, 0, 0}, .normal = {0, 1, 0}, .frame = probe::SphereFrame::around({0, 1, 0}, {0, 0, -1})};
    request.width = 8, request.height = 6, request.samplesPerPixel = 4, request.maximumDepth = 3;
    EXPECT_EQ(served.client().askTool("light probe", probe::encode(request)).error().message,
              "Only \"path\" is known.");
    request.integrator = "path";
    const auto bytes = served.client().askTool("light probe", probe::encode(request));
    ASSERT_TRUE(bytes.ok()) << bytes.error().message;
    const Image image = probe::decodeProbe(*bytes)->image;
    for (std::uint32_t y = 0; y < 6; ++y)
        for (std::uint32_t x = 0; x < 8; ++x)
            EXPECT_EQ(image.color({x, y}), Color(y < 3 ? 0.5f : -0.5f, y < 3 ? 0.5f : -0.5f, 3 + 1024.f * float(x)));
    EXPECT_GE(log.began, 1);
    EXPECT_EQ(log.open, 0);
}

TEST(LightProbeInC, IsChecked) {
    ServedInC served(everything());
    const auto radiance = [](void*, const emca_probe_request*, emca_vec3f, emca_vec3f, emca_pixel, std::uint32_t) {
        return emca_color{1, 2, 3};
    };
    emca_light_probe probe = {EMCA_SIZED(emca_light_probe), .radiance = radiance};
    EXPECT_EQ(emca_server_add_light_probe(nullptr, &probe, nullptr), EMCA_INVALID_ARGUMENT);
    EXPECT_EQ(emca_server_add_light_probe(served.server(), nullptr, nullptr), EMCA_INVALID_ARGUMENT);
    for (const float offset : {-1.f, INFINITY, NAN}) {
        probe.surface_offset = offset;
        EXPECT_EQ(emca_server_add_light_probe(served.server(), &probe, nullptr), EMCA_INVALID_ARGUMENT) << offset;
    }
    probe.surface_offset = 0;
    probe.radiance = nullptr;
    EXPECT_EQ(emca_server_add_light_probe(served.server(), &probe, nullptr), EMCA_INVALID_ARGUMENT);
    probe.radiance = radiance;
    probe.size = offsetof(emca_light_probe, begin);
    EXPECT_EQ(emca_server_add_light_probe(served.server(), &probe, nullptr), EMCA_OK)
        << "one that has only the first members";
}

TEST(ToolsInC, AreChecked) {
    ServedInC served(everything());
    const auto refused = [&](auto change, emca_code expected) {
        emca_tool tool = {EMCA_SIZED(emca_tool), .name = "tool", .answer = reversed};
        change(tool);
        emca_error error{};
        EXPECT_EQ(emca_server_add_tool(served.server(), &tool, &error), expected);
        EXPECT_NE(error.message[0], 0);
    };
    refused([](emca_tool& t) { t.name = nullptr; }, EMCA_INVALID_ARGUMENT);
    refused([](emca_tool& t) { t.name = ""; }, EMCA_INVALID_ARGUMENT);
    refused([](emca_tool& t) { t.answer = nullptr; }, EMCA_INVALID_ARGUMENT);
    refused([](emca_tool& t) { t.size = 12; }, EMCA_INVALID_ARGUMENT);
    refused([](emca_tool& t) { t.version = 0; }, EMCA_VERSION_MISMATCH);
    const emca_tool tool = {EMCA_SIZED(emca_tool), .name = "tool", .answer = reversed};
    EXPECT_EQ(emca_server_add_tool(nullptr, &tool, nullptr), EMCA_INVALID_ARGUMENT);
    EXPECT_EQ(emca_server_add_tool(served.server(), nullptr, nullptr), EMCA_INVALID_ARGUMENT);
    emca_tool old = tool;
    old.size = offsetof(emca_tool, added);
    EXPECT_EQ(emca_server_add_tool(served.server(), &old, nullptr), EMCA_OK) << "one that has only the first members";
    EXPECT_EQ(emca_reply_append(nullptr, "x", 1, nullptr), EMCA_INVALID_ARGUMENT);
}

}  // namespace
}  // namespace emca::test
