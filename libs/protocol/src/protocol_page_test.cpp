// docs/protocol.md says what the program does: its bytes, numbers and limits are compared here.
#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "emca/protocol/codec.h"
#include "emca_generated.h"

namespace emca::protocol {
namespace {

std::string page() {
    std::ifstream file(EMCA_SOURCE_DIR "/docs/protocol.md");
    EXPECT_TRUE(file.good());
    return {std::istreambuf_iterator<char>(file), {}};
}

/// The block that follows `<!-- bytes: name -->`.
std::string block(const std::string& text, const std::string& name) {
    const std::string mark = "<!-- bytes: " + name + " -->\n```\n";
    const auto begin = text.find(mark);
    if (begin == text.npos) return "no such block";
    const auto end = text.find("```", begin + mark.size());
    return text.substr(begin + mark.size(), end - begin - mark.size());
}

std::string hex(const Message& message) {
    const auto frame = encode(message);
    EXPECT_TRUE(frame.ok());
    std::vector<std::byte> bytes;
    for (const std::byte b : header(*frame)) bytes.push_back(b);
    bytes.insert(bytes.end(), frame->begin(), frame->end());
    std::string text;
    for (std::size_t i = 0; i < bytes.size(); ++i) {
        constexpr char kDigits[] = "0123456789abcdef";
        text += kDigits[std::to_integer<int>(bytes[i]) >> 4];
        text += kDigits[std::to_integer<int>(bytes[i]) & 15];
        text += i % 16 == 15 || i + 1 == bytes.size() ? '\n' : ' ';
    }
    return text;
}

TEST(ProtocolPage, TheWorkedExampleHasRealBytes) {
    const std::string text = page();
    EXPECT_EQ(block(text, "hello"), hex({0, Hello{"demo 1.0", 1, 1, {}, "open sesame"}}));
    EXPECT_EQ(block(text, "welcome"), hex({0, Welcome{"EMCA server", 1, {}, kMaximumRequestBytes}}));
    TraceRequest trace;
    trace.pixels = {{12, 34}};
    trace.settings.samplesPerPixel = 16;
    EXPECT_EQ(block(text, "trace"), hex({1, trace}));
    SurfaceChunk surface;
    surface.meshes = {{0, 2, 5, 1, 0, std::vector<std::uint8_t>{1}}};
    surface.arrays = {{0, 0, std::vector<float>{0, 0, 0, 2, 1}}, {1, 0, std::vector<float>{0, 0, 0, 2, 1}}};
    surface.last = true;
    EXPECT_EQ(block(text, "surface"), hex({1, surface}));
}

TEST(ProtocolPage, EveryKindOfMessageIsListedWithItsNumber) {
    const std::string text = page();
    for (const wire::Body kind : wire::EnumValuesBody()) {
        if (kind == wire::Body::NONE) continue;
        const std::string row = "| " + std::to_string(static_cast<int>(kind)) + " | " + wire::EnumNameBody(kind) + " |";
        EXPECT_NE(text.find(row), std::string::npos) << row;
    }
}

TEST(ProtocolPage, EveryErrorCodeIsListedWithItsNumber) {
    const std::string text = page();
    int listed = 0;
    for (std::uint16_t code = 1; code < 100; ++code) {
        const std::string called = name(static_cast<ErrorCode>(code));
        if (called == "unknown") continue;
        ++listed;
        const std::string cell = "| " + std::to_string(code) + " | " + called + " |";
        EXPECT_NE(text.find(cell), std::string::npos) << cell;
    }
    EXPECT_GE(listed, 19);
}

TEST(ProtocolPage, LimitsAreThoseOfTheProgram) {
    const std::string text = page();
    for (const auto& [what, limit] : {std::pair{"first frame of each side", kMaximumHandshakeBytes}, {"request", kMaximumRequestBytes},
                                      {"reply", kMaximumReplyBytes}, {"chunk of a scene or an image", kChunkBytes}}) {
        const std::string row = "| " + std::string(what) + " | " + std::to_string(limit) + " |";
        EXPECT_NE(text.find(row), std::string::npos) << row;
    }
    const std::string surfaces = "at most " + std::to_string(kMaximumSurfaceLayers) + " surface layers and " +
                                 std::to_string(kMaximumSurfaceFaces) + " refined faces";
    EXPECT_NE(text.find(surfaces), std::string::npos) << surfaces;
}

}  // namespace
}  // namespace emca::protocol
