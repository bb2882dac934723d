// docs/sessions.md says what the program does: its bytes, numbers and limits are compared here.
#include "emca/protocol/session.h"
#include "session_for_tests.h"
#include "session_save.h"

namespace emca::client {
namespace {

using SessionPage = test::SessionTest;

std::string page() {
    const auto bytes = test::contents(EMCA_SOURCE_DIR "/docs/sessions.md");
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

/// The block that follows `<!-- bytes: name -->`.
std::string block(const std::string& text, const std::string& name) {
    const std::string mark = "<!-- bytes: " + name + " -->\n```\n";
    const auto begin = text.find(mark);
    if (begin == text.npos) return "no such block";
    return text.substr(begin + mark.size(), text.find("```", begin + mark.size()) - begin - mark.size());
}

std::string hex(const std::vector<std::byte>& bytes) {
    constexpr char kDigits[] = "0123456789abcdef";
    std::string text;
    for (std::size_t i = 0; i < bytes.size(); ++i) {
        text += kDigits[std::to_integer<int>(bytes[i]) >> 4];
        text += kDigits[std::to_integer<int>(bytes[i]) & 15];
        text += i % 16 == 15 || i + 1 == bytes.size() ? '\n' : ' ';
    }
    return text;
}

TEST_F(SessionPage, TheWorkedExampleHasRealBytes) {
    Session session;
    session.notes = "caustic too bright";
    ASSERT_TRUE(saveSession(file(), session, {}, {}, 1'700'000'000, "demo 1.0").ok());
    EXPECT_EQ(block(page(), "session"), hex(test::contents(file())));
}

TEST_F(SessionPage, NumbersAreThoseOfTheProgram) {
    using Kind = protocol::saved::PartKind;
    const std::string text = page();
    const auto expectSaid = [&](const std::string& row) { EXPECT_NE(text.find(row), std::string::npos) << row; };
    for (const auto& [kind, name] : {std::pair{Kind::notes, "notes"}, {Kind::selection, "selection"}, {Kind::camera, "camera"},
                                     {Kind::image, "image"}, {Kind::trace, "trace of one or more pixels"}, {Kind::scene, "scene"},
                                     {Kind::info, "what the renderer said about itself"}, {Kind::surface, "surface layers"}}) {
        expectSaid("| " + std::to_string(static_cast<int>(kind)) + " | " + name + " |");
    }
    expectSaid("| one block, unpacked | " + std::to_string(protocol::kMaximumReplyBytes) + " |");
    expectSaid("| file header | " + std::to_string(kFileHeaderBytes) + " |");
    expectSaid("| trailer | " + std::to_string(kTrailerBytes) + " |");
    expectSaid("has " + std::to_string(kContentsEntryBytes) + " bytes for each block");
    expectSaid("version that a reader needs (" + std::to_string(kSessionVersion) + ")");
}

}  // namespace
}  // namespace emca::client
