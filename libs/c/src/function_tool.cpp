#include "function_tool.h"

#include "renderer_adapter.h"
#include "sized.h"

struct emca_reply {
    std::vector<std::byte> bytes;
};

namespace emca::c {

Result<emca_tool> checkedTool(const emca_tool* given) {
    auto tool = sized(given, EMCA_SIZE_UP_TO(emca_tool, answer), "emca_tool");
    if (!tool) return tool;
    if (tool->name == nullptr || *tool->name == '\0')
        return Error{ErrorCode::invalidArgument, "emca_tool has no name: requests address it by that."};
    if (tool->answer == nullptr)
        return Error{ErrorCode::invalidArgument, "emca_tool has no function answer: it is needed."};
    return tool;
}

void FunctionTool::setHost(ToolHost& host) {
    if (c_.added) c_.added(c_.user, reinterpret_cast<emca_tool_host*>(&host));
}

Result<std::vector<std::byte>> FunctionTool::answer(std::span<const std::byte> request, RequestMonitor& monitor) {
    emca_reply reply;
    emca_error error{};
    const emca_code code = c_.answer(c_.user, request.data(), request.size(), handle(monitor), &reply, &error);
    if (code != EMCA_OK) return errorOf(code, error, "answer");
    return std::move(reply.bytes);
}

bool FunctionTool::observesReplay() const {
    return c_.begin_pixel || c_.end_pixel || c_.begin_path || c_.end_path || c_.begin_vertex || c_.end_vertex;
}

void FunctionTool::beginPixel(Pixel p) {
    if (c_.begin_pixel) c_.begin_pixel(c_.user, {p.x, p.y});
}
void FunctionTool::endPixel(Pixel p) {
    if (c_.end_pixel) c_.end_pixel(c_.user, {p.x, p.y});
}
void FunctionTool::beginPath(Pixel p, std::int64_t sample) {
    if (c_.begin_path) c_.begin_path(c_.user, {p.x, p.y}, sample);
}
void FunctionTool::endPath(Pixel p, std::int64_t sample) {
    if (c_.end_path) c_.end_path(c_.user, {p.x, p.y}, sample);
}
void FunctionTool::beginVertex(std::int32_t depth) {
    if (c_.begin_vertex) c_.begin_vertex(c_.user, depth);
}
void FunctionTool::endVertex(std::int32_t depth) {
    if (c_.end_vertex) c_.end_vertex(c_.user, depth);
}

}  // namespace emca::c

using namespace emca;

extern "C" {

emca_code emca_reply_append(emca_reply* reply, const void* data, size_t bytes, emca_error* error) {
    if (reply == nullptr || (data == nullptr && bytes > 0))
        return c::invalid(error, "emca_reply_append needs the reply that `answer` got, and bytes.");
    return c::guarded(error, [&] {
        const auto* first = static_cast<const std::byte*>(data);
        if (bytes > 0) reply->bytes.insert(reply->bytes.end(), first, first + bytes);
        return EMCA_OK;
    });
}

emca_code emca_ask_tool(emca_tool_host* host, const char* tool, const void* request, size_t bytes,
                        emca_monitor* monitor, emca_reply* reply, emca_error* error) {
    if (host == nullptr || tool == nullptr || monitor == nullptr || reply == nullptr ||
        (request == nullptr && bytes > 0))
        return c::invalid(error,
                          "emca_ask_tool needs a host, the tool's name, a request, and the monitor and reply that "
                          "`answer` got; one of them is null.");
    return c::guarded(error, [&]() -> emca_code {
        const std::span<const std::byte> asked(static_cast<const std::byte*>(request), bytes);
        const auto answered = reinterpret_cast<ToolHost*>(host)->ask(tool, asked, c::of(monitor));
        if (!answered) return c::fail(error, answered.error());
        reply->bytes.insert(reply->bytes.end(), answered->begin(), answered->end());
        return EMCA_OK;
    });
}

}  // extern "C"
