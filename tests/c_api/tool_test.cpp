// Tools made of functions: answers, errors, other tools, and data that they add to a replay.
#include <cstring>
#include <string>

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
