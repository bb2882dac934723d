// What happens to files: they are cut, their bits flip, programs die while they write, and some are made to do harm.
#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "emca/protocol/session.h"
#include "session_for_tests.h"
#include "session_save.h"

namespace emca::client {
namespace {

namespace fs = std::filesystem;
namespace saved = protocol::saved;
using SessionDamage = test::SessionTest;

bool isSentence(const std::string& text) {
    return text.size() > 10 && text.back() == '.' && text.find('\n') == text.npos && !(text[0] >= 'a' && text[0] <= 'z');
}

std::string joined(const std::vector<std::string>& notices) {
    std::string text;
    for (const std::string& notice : notices) text += notice + '\n';
    return text;
}

Result<void> save(const fs::path& file, const Session& session, SessionWriter::Step step = {}) {
    return saveSession(file, session, {}, std::move(step), test::kSavedAt, test::kSoftware);
}

void putByte(const fs::path& file, std::size_t at, std::byte value) {
    std::fstream stream(file, std::ios::binary | std::ios::in | std::ios::out);
    stream.seekp(static_cast<std::streamoff>(at));
    stream.put(static_cast<char>(value));
}

/// Where the blocks of an undamaged file begin.
std::vector<std::pair<std::size_t, BlockHeader>> blocksOf(const std::vector<std::byte>& file) {
    std::vector<std::pair<std::size_t, BlockHeader>> blocks;
    for (std::size_t at = kFileHeaderBytes; at + kTrailerBytes < file.size();) {
        const auto header = blockHeader(std::span<const std::byte, kBlockHeaderBytes>(&file[at], kBlockHeaderBytes));
        if (!header) break;
        blocks.emplace_back(at, *header);
        at += kBlockHeaderBytes + header->storedBytes;
    }
    return blocks;
}

/// All that is there is what was saved: no part is invented, mixed up or changed. \return how many parts are there
int expectOnlyTrueParts(const Session& found, const Session& original) {
    int parts = 0;
    const auto count = [&](bool there) { parts += there; };
    count(found.info.has_value());
    count(found.camera.has_value());
    EXPECT_TRUE(!found.info || test::same(*found.info, *original.info));
    EXPECT_TRUE(!found.camera || found.camera == original.camera);
    if (found.meshes) {
        EXPECT_LE(found.meshes->size(), original.meshes->size());
        for (std::size_t i = 0; i < found.meshes->size(); ++i) EXPECT_TRUE(test::same((*found.meshes)[i], (*original.meshes)[i]));
        count(found.meshes->size() == original.meshes->size());
    }
    EXPECT_TRUE(!found.surface || test::same(*found.surface, *original.surface));
    count(found.surface != nullptr);
    for (const ImageEntry& image : found.images) {
        const auto same = std::find_if(original.images.begin(), original.images.end(), [&](const auto& o) { return o.title == image.title; });
        EXPECT_NE(same, original.images.end());
        if (same != original.images.end() && test::same(*same, image)) ++parts;
    }
    for (const auto& trace : found.traces) {
        const auto same = std::find_if(original.traces.begin(), original.traces.end(),
                                       [&](const auto& o) { return o->samplesPerPixel == trace->samplesPerPixel; });
        EXPECT_TRUE(same != original.traces.end() && test::bits(**same) == test::bits(*trace));
        ++parts;
    }
    for (const std::size_t index : found.shown) EXPECT_LT(index, found.traces.size());
    EXPECT_TRUE(found.selection == Selection::State() || found.selection == original.selection);
    count(found.selection != Selection::State());
    EXPECT_TRUE(found.notes.empty() || found.notes == original.notes);
    count(!found.notes.empty());
    EXPECT_TRUE(!found.filter || found.filter == original.filter);
    count(found.filter.has_value());
    if (found.view) {
        SavedView expected = *original.view;
        // The number of the reference in the file names it, whether or not those before it came; without it there is none.
        expected.reference.reset();
        for (std::size_t i = 0; i < found.images.size(); ++i)
            if (found.images[i].title == original.images[*original.view->reference].title) expected.reference = i;
        EXPECT_EQ(*found.view, expected);
    }
    count(found.view.has_value());
    return parts;
}

/// Parts of sampleSession(): notes, selection, filter, view, info, camera, 3 images, 3 traces, scene, surface layers.
constexpr int kParts = 14;

/// Of each part that is not there, a notice has the name.
void expectMissingPartsNamed(const Session& found, const std::string& notices) {
    const auto expectNamed = [&](bool there, const std::string& name) {
        EXPECT_TRUE(there || notices.find(name) != std::string::npos) << name << " is missing, but this is said:\n" << notices;
    };
    expectNamed(!found.notes.empty(), "the notes");
    expectNamed(found.selection != Selection::State(), "the selection");
    expectNamed(found.filter.has_value(), "the filter");
    expectNamed(found.view.has_value(), "the view");
    expectNamed(found.info.has_value(), "what the renderer said about itself");
    expectNamed(found.camera.has_value(), "the camera");
    expectNamed(found.meshes != nullptr, "the scene");
    expectNamed(found.surface != nullptr, "the surface layers");
    for (const ImageEntry& image : test::sampleSession().images) {
        expectNamed(std::any_of(found.images.begin(), found.images.end(), [&](const auto& i) { return i.title == image.title; }),
                    "image \"" + image.title + "\"");
    }
    for (const auto& trace : test::sampleSession().traces) {
        const std::uint32_t x = trace->pixels.front().x;
        expectNamed(std::any_of(found.traces.begin(), found.traces.end(), [&](const auto& t) { return t->pixels.front().x == x; }),
                    "2 pixels from (" + std::to_string(x) + ", 2)");
    }
}

TEST_F(SessionDamage, AFileCutAtAnyByteOpensAsFarAsItIsWholeAndSaysWhatIsMissing) {
    const Session session = test::sampleSession();
    ASSERT_TRUE(save(file(), session).ok());
    const std::size_t size = fs::file_size(file());
    const std::size_t planEnds = [&] {
        const auto blocks = blocksOf(test::contents(file()));
        EXPECT_GT(blocks.size(), 20u);
        return blocks[1].first;
    }();
    int partsBefore = kParts;
    for (std::size_t cut = size; cut-- > 0;) {
        SCOPED_TRACE(cut);
        fs::resize_file(file(), cut);
        const auto opened = openSession(file());
        if (cut < kFileHeaderBytes) {
            ASSERT_FALSE(opened.ok());
            EXPECT_EQ(opened.error().code, ErrorCode::fileUnreadable);
            EXPECT_TRUE(isSentence(opened.error().message)) << opened.error().message;
            continue;
        }
        ASSERT_TRUE(opened.ok()) << opened.error().message;
        EXPECT_FALSE(opened->whole);
        ASSERT_FALSE(opened->notices.empty());
        for (const std::string& notice : opened->notices) EXPECT_TRUE(isSentence(notice)) << notice;
        const int parts = expectOnlyTrueParts(opened->session, session);
        EXPECT_LE(parts, partsBefore) << "a longer file holds more";
        partsBefore = parts;
        const std::string notices = joined(opened->notices);
        if (cut >= planEnds) {
            expectMissingPartsNamed(opened->session, notices);
        } else {
            EXPECT_NE(notices.find("what it should hold is not known"), std::string::npos) << notices;
        }
        if (testing::Test::HasFailure()) break;
    }
    EXPECT_EQ(partsBefore, 0);
}

TEST_F(SessionDamage, EveryFlippedBitIsFoundAndCostsItsPartOnly) {
    const Session session = test::sampleSession();
    ASSERT_TRUE(save(file(), session).ok());
    const std::vector<std::byte> bytes = test::contents(file());
    const auto blocks = blocksOf(bytes);
    ASSERT_LT(bytes.size(), 20'000u);
    const auto isInHeader = [&](std::size_t at) {
        return at < kFileHeaderBytes || std::any_of(blocks.begin(), blocks.end(), [&](const auto& block) {
                   return at >= block.first && at < block.first + kBlockHeaderBytes;
               });
    };
    const std::size_t contentsBegin = blocks.back().first;
    for (std::size_t at = 0; at < bytes.size(); ++at) {
        // All bits of file and block headers; one of each other byte, to keep the test short.
        const bool all = isInHeader(at);
        for (int bit = all ? 0 : static_cast<int>(at % 8); bit < 8; bit += all ? 1 : 8) {
            SCOPED_TRACE("byte " + std::to_string(at) + ", bit " + std::to_string(bit));
            putByte(file(), at, bytes[at] ^ std::byte(1u << bit));
            const auto opened = openSession(file());
            putByte(file(), at, bytes[at]);
            if (at < kMagic.size()) {
                ASSERT_FALSE(opened.ok());
                continue;
            }
            ASSERT_TRUE(opened.ok()) << opened.error().message;
            EXPECT_FALSE(opened->whole);
            ASSERT_FALSE(opened->notices.empty());
            for (const std::string& notice : opened->notices) EXPECT_TRUE(isSentence(notice)) << notice;
            const int parts = expectOnlyTrueParts(opened->session, session);
            if (isInHeader(at) || at >= contentsBegin) {
                EXPECT_EQ(parts, kParts) << "headers are there twice, and the parts do not need the contents";
            } else {
                EXPECT_GE(parts, kParts - 2) << "surface layers go with their scene, nothing else with another part";
            }
            if (testing::Test::HasFailure()) return;
        }
    }
}

/// Rows that are lost are marked, the others stay.
TEST_F(SessionDamage, OfAnImageTheRowsStayThatCame) {
    Session session;
    auto image = std::make_shared<RenderedImage>();
    image->color = test::filled(1024, 1024, {"R", "G", "B"}, 1);
    session.images = {{"large", image}};
    ASSERT_TRUE(save(file(), session).ok());
    auto bytes = test::contents(file());
    const auto blocks = blocksOf(bytes);
    bytes[blocks[3].first + kBlockHeaderBytes + 1] ^= std::byte(4);  // head, image, rows, rows: the second piece
    test::put(file(), bytes);
    const auto opened = openSession(file());
    ASSERT_TRUE(opened.ok());
    ASSERT_EQ(opened->session.images.size(), 1u);
    EXPECT_NE(joined(opened->notices).find("Of image \"large\", 683 of 1024 rows are there"), std::string::npos) << joined(opened->notices);
    const Image& color = opened->session.images[0].image->color;
    EXPECT_EQ(color.color({5, 0}), image->color.color({5, 0}));
    EXPECT_TRUE(std::isnan(color.color({5, 400}).g));
    EXPECT_EQ(color.color({5, 1023}), image->color.color({5, 1023}));
}

/// Runs in a process of its own. \return its exit code, or minus the signal that ended it
int inChild(const std::function<int()>& work) {
    const pid_t child = ::fork();
    if (child == 0) ::_exit(work());
    int status = 0;
    EXPECT_EQ(::waitpid(child, &status, 0), child);
    return WIFSIGNALED(status) ? -WTERMSIG(status) : WEXITSTATUS(status);
}

TEST_F(SessionDamage, KilledAtAnyStepLeavesTheOldOrTheNewFileWhole) {
    Session older;
    older.notes = "the older file";
    const Session newer = test::sampleSession();
    ASSERT_TRUE(save(file("old.emca"), older).ok());
    ASSERT_TRUE(save(file("new.emca"), newer).ok());
    const auto oldBytes = test::contents(file("old.emca")), newBytes = test::contents(file("new.emca"));
    for (const bool replaced : {true, false}) {
        bool wasNew = false;
        int killed = 0;
        for (int last = 0;; ++last) {
            SCOPED_TRACE("killed before step " + std::to_string(last));
            fs::remove(file());
            if (replaced) test::put(file(), oldBytes);
            const int code = inChild([&] {
                int step = 0;
                const auto result = save(file(), newer, [&](const char*) {
                    if (step++ == last) ::kill(::getpid(), SIGKILL);
                });
                return result ? 0 : 1;
            });
            ASSERT_TRUE(code == 0 || code == -SIGKILL) << code;
            if (!fs::exists(file())) {
                EXPECT_FALSE(replaced || wasNew) << "neither the old file nor the new one is there";
            } else {
                const auto bytes = test::contents(file());
                EXPECT_TRUE(bytes == newBytes || (replaced && bytes == oldBytes)) << "a part of the new file took the place";
                EXPECT_FALSE(wasNew && bytes == oldBytes);
                wasNew = wasNew || bytes == newBytes;
            }
            const auto opened = openSession(file());
            EXPECT_TRUE(!fs::exists(file()) || (opened.ok() && opened->whole));
            if (code == 0) break;
            ++killed;
        }
        EXPECT_TRUE(wasNew);
        EXPECT_GT(killed, 40) << "every block is at least two writes";
    }
}

TEST_F(SessionDamage, AFullDiskLeavesTheOldFileAndAReason) {
    test::put(file(), {std::byte(1)});
    const int code = inChild([&] {
        ::signal(SIGXFSZ, SIG_IGN);
        const rlimit small{1000, 1000};
        if (::setrlimit(RLIMIT_FSIZE, &small) != 0) return 9;
        const auto result = save(file(), test::sampleSession());
        if (result.ok() || result.error().code != ErrorCode::fileUnwritable) return 1;
        if (result.error().message.find("a.emca cannot be written: File too large.") == std::string::npos) return 2;
        return std::distance(fs::directory_iterator(folder_), {}) == 1 ? 0 : 3;
    });
    EXPECT_EQ(code, 0);
    EXPECT_EQ(test::contents(file()).size(), 1u);
}

TEST_F(SessionDamage, PlacesThatCannotBeWrittenAreNamed) {
    const auto missing = save(file("none/a.emca"), Session());
    ASSERT_FALSE(missing.ok());
    EXPECT_EQ(missing.error().message,
              "The session " + file("none/a.emca").string() + " cannot be written: there is no folder " + file("none").string() + ".");
    EXPECT_FALSE(save(folder_, Session()).ok());
}

/// Writes blocks that saveSession() would not.
class Forgery {
  public:
    explicit Forgery(const fs::path& file) { EXPECT_TRUE(writer_.create(file).ok()); }
    Forgery& add(std::uint32_t part, const saved::Item& item) { return raw(BlockKind::saved, part, *saved::encode(item)); }
    Forgery& add(std::uint32_t part, protocol::Body body) { return raw(BlockKind::message, part, *protocol::encode({0, std::move(body)})); }
    Forgery& raw(std::uint8_t kind, std::uint32_t part, std::span<const std::byte> content) {
        EXPECT_TRUE(writer_.add(kind, part, content).ok());
        return *this;
    }
    void finish() { EXPECT_TRUE(writer_.finish().ok()); }

  private:
    SessionWriter writer_;
};

/// Gives the header of a block other values, with a right checksum, in its two places.
template <typename Change>
void changeHeader(const fs::path& file, std::size_t index, Change change) {
    auto bytes = test::contents(file);
    const auto blocks = blocksOf(bytes);
    BlockHeader header = blocks[index].second;
    change(header);
    const auto changed = bytesOf(header);
    std::copy(changed.begin(), changed.end(), bytes.begin() + static_cast<std::ptrdiff_t>(blocks[index].first));
    test::put(file, bytes);
}

TEST_F(SessionDamage, WhatLaterVersionsAddIsSkippedAndSaid) {
    const std::vector<std::byte> future(300, std::byte(7));
    Forgery(file())
        .add(0, saved::Head{"EMCA 9", 1, {{200, "a hologram"}, {1, ""}}})
        .raw(77, 1, future)
        .add(2, saved::Notes{"still here", {}})
        .finish();
    auto opened = openSession(file());
    ASSERT_TRUE(opened.ok());
    EXPECT_TRUE(opened->whole) << "nothing is damaged";
    EXPECT_EQ(opened->session.notes, "still here");
    EXPECT_EQ(opened->notices, std::vector<std::string>{
        "A hologram was left out: it is of a kind that this version does not know; open the file with a newer EMCA."});
    changeHeader(file(), 1, [](BlockHeader& header) { header.compression = 9; });
    opened = openSession(file());
    ASSERT_TRUE(opened.ok());
    EXPECT_TRUE(opened->whole);
    EXPECT_EQ(opened->session.notes, "still here");
    EXPECT_NE(joined(opened->notices).find("packed in a way that only a later version knows"), std::string::npos);
}

TEST_F(SessionDamage, AVersionThatIsTooNewSaysSo) {
    ASSERT_TRUE(save(file(), test::sampleSession()).ok());
    auto bytes = test::contents(file());
    const auto withHeader = [&](FileHeader header) {
        const auto begin = bytesOf(header);
        std::copy(begin.begin(), begin.end(), bytes.begin());
        test::put(file(), bytes);
        return openSession(file());
    };
    EXPECT_TRUE(withHeader({1, 9}).ok()) << "written by a later version that an earlier one can still read";
    const auto refused = withHeader({2, 2});
    ASSERT_FALSE(refused.ok());
    EXPECT_EQ(refused.error().code, ErrorCode::versionMismatch);
    EXPECT_NE(refused.error().message.find("open it with a newer EMCA"), std::string::npos) << refused.error().message;
}

TEST_F(SessionDamage, AFileThatUnpacksToMoreThanIsAcceptedFillsNoMemory) {
    const std::vector<std::byte> zeros(16u << 20);
    Forgery forgery(file());
    forgery.add(0, saved::Head{"", 0, {{6, "a bomb"}, {6, "a bomb"}, {1, ""}}});
    forgery.raw(BlockKind::message, 1, zeros).raw(BlockKind::message, 2, zeros).add(3, saved::Notes{"behind", {}});
    forgery.finish();
    EXPECT_LT(fs::file_size(file()), 10'000u);
    const auto opened = openSession(file(), {20u << 20});
    ASSERT_TRUE(opened.ok());
    EXPECT_FALSE(opened->whole);
    EXPECT_EQ(opened->session.notes, "behind");
    const std::string notices = joined(opened->notices);
    EXPECT_NE(notices.find("A bomb is damaged: its content is not valid"), std::string::npos) << notices;
    EXPECT_NE(notices.find("it would unpack to 16777216 bytes, more than is accepted here"), std::string::npos) << notices;

    changeHeader(file(), 1, [](BlockHeader& header) { header.contentBytes = std::uint64_t(1) << 40; });
    const auto absurd = openSession(file());
    ASSERT_TRUE(absurd.ok());
    EXPECT_NE(joined(absurd->notices).find("it would unpack to 1099511627776 bytes"), std::string::npos);
    changeHeader(file(), 1, [](BlockHeader& header) { header.contentBytes = 5; });
    const auto less = openSession(file());
    ASSERT_TRUE(less.ok());
    EXPECT_NE(joined(less->notices).find("it cannot be unpacked"), std::string::npos) << "it unpacks to more than it says";
}

TEST_F(SessionDamage, AnnouncedImagesFillNoMemory) {
    saved::Image huge;
    huge.title = "huge";
    huge.planes[0] = {1u << 20, 1u << 20, {"R", "G", "B"}};
    saved::Image beyond;
    beyond.planes[0] = {0xffffffffu, 0xffffffffu, {"R"}};
    saved::Image empty;
    empty.planes[2] = {3, 3, {}};
    Forgery(file())
        .add(0, saved::Head{"", 0, {{5, "image \"huge\""}, {5, "image \"beyond\""}, {5, "image \"empty\""}}})
        .add(1, huge)
        .add(2, beyond)
        .add(3, empty)
        .finish();
    const auto opened = openSession(file());
    ASSERT_TRUE(opened.ok());
    EXPECT_TRUE(opened->session.images.empty());
    const std::string notices = joined(opened->notices);
    EXPECT_NE(notices.find("Image \"huge\" is damaged: it would need"), std::string::npos) << notices;
    EXPECT_NE(notices.find("Image \"beyond\" is damaged: its size is not that of an image."), std::string::npos) << notices;
}

TEST_F(SessionDamage, PiecesThatDoNotFitTogetherAreRefused) {
    saved::Image image;
    image.planes[0] = {2, 2, {"Y"}};
    const auto notices = [&] {
        const auto opened = openSession(file());
        EXPECT_TRUE(opened.ok() && !opened->whole);
        EXPECT_TRUE(opened->session.images.empty() && !opened->session.meshes && !opened->session.surface);
        return joined(opened->notices);
    };
    const std::vector<float> values(4);
    const saved::Rows badRows[] = {{0, 1, 2, values}, {0, 0xffffffffu, 1, values}, {0, 0, 1, values}, {1, 0, 1, values}, {0, 0, 0xffffffffu, values}};
    for (const saved::Rows& rows : badRows) {
        Forgery(file()).add(0, saved::Head{"", 0, {{5, "image \"a\""}}}).add(1, image).add(1, rows).finish();
        EXPECT_NE(notices().find("Image \"a\" is damaged: its pieces do not fit together."), std::string::npos);
    }
    Forgery(file()).add(1, saved::Rows{0, 0, 1, values}).finish();
    EXPECT_NE(notices().find("A part is damaged"), std::string::npos) << "rows of no image, and no plan";
    protocol::SceneChunk chunk{2, 0, 0, {}, true};
    Forgery(file()).add(0, saved::Head{"", 0, {{7, ""}}}).add(1, chunk).finish();
    EXPECT_NE(notices().find("The scene is damaged: its pieces do not fit together."), std::string::npos);
    Forgery(file()).add(0, saved::Head{"", 0, {{8, ""}}}).add(1, protocol::SurfaceChunk{{}, {}, true}).finish();
    EXPECT_NE(notices().find("The surface layers are damaged"), std::string::npos);
    Forgery(file()).add(0, saved::Head{"", 0, {{6, "pixel (1, 2)"}, {4, ""}}}).add(1, saved::Trace{1, 1}).finish();
    EXPECT_NE(notices().find("Missing: pixel (1, 2) and the camera."), std::string::npos);
}

TEST_F(SessionDamage, BytesThatFollowTheEndAreSaid) {
    ASSERT_TRUE(save(file(), test::sampleSession()).ok());
    auto bytes = test::contents(file());
    bytes.insert(bytes.end(), 100, std::byte(0));
    test::put(file(), bytes);
    const auto opened = openSession(file());
    ASSERT_TRUE(opened.ok());
    EXPECT_EQ(test::difference(opened->session, test::sampleSession()), "");
    EXPECT_EQ(joined(opened->notices), "100 bytes that are not part of the session follow its end.\n");
}

}  // namespace
}  // namespace emca::client
