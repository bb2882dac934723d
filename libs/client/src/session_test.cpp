// What is saved comes back bit by bit, through files of this version and of every version before.
#include "emca/client/session.h"

#include <cstdlib>

#include "emca/core/seed_map.h"
#include "session_for_tests.h"
#include "session_save.h"

namespace emca::client {
namespace {

using test::difference;
using test::sampleSession;
using SessionFile = test::SessionTest;

TEST_F(SessionFile, EverythingComesBackBitByBit) {
    const Session session = sampleSession();
    ASSERT_TRUE(saveSession(file(), session).ok());
    const auto opened = openSession(file());
    ASSERT_TRUE(opened.ok()) << opened.error().message;
    EXPECT_TRUE(opened->whole);
    EXPECT_EQ(opened->notices, std::vector<std::string>());
    EXPECT_EQ(difference(opened->session, session), "");
    EXPECT_EQ(opened->software.substr(0, 5), "EMCA ");
    EXPECT_GT(opened->saved, test::kSavedAt);
    EXPECT_TRUE(isSession(file()));
}

TEST_F(SessionFile, WhatIsComparedIsNoticed) {
    Session other = sampleSession();
    EXPECT_EQ(difference(other, sampleSession()), "");
    auto trace = std::make_shared<Trace>(*other.traces[1]);
    trace->paths = test::samplePaths(5);
    other.traces[1] = trace;
    EXPECT_EQ(difference(other, sampleSession()), "trace 1");
}

TEST_F(SessionFile, EveryPartMayBeAbsent) {
    for (int part = 0; part < 12; ++part) {
        SCOPED_TRACE(part);
        Session session = sampleSession();
        if (part == 0) session = {};
        if (part == 1) session.info.reset();
        if (part == 2) session.camera.reset();
        if (part == 3) session.surface = nullptr;
        if (part == 4) session.surface = nullptr, session.meshes = nullptr;
        if (part == 5) session.images.clear(), session.currentImage = 0, session.view->reference.reset();
        if (part == 6) session.traces.clear(), session.shown.clear();
        if (part == 7) session.selection = {};
        if (part == 8) session.notes.clear(), session.pixelNotes.clear();
        if (part == 9) session.surface = nullptr, session.meshes = std::make_shared<const std::vector<Mesh>>();
        if (part == 10) session.filter.reset();
        if (part == 11) session.view.reset();
        ASSERT_TRUE(saveSession(file(), session).ok());
        const auto opened = openSession(file());
        ASSERT_TRUE(opened.ok()) << opened.error().message;
        EXPECT_TRUE(opened->whole);
        EXPECT_TRUE(opened->notices.empty());
        EXPECT_EQ(difference(opened->session, session), "");
    }
}

TEST_F(SessionFile, AReferenceIsOneOfTheImages) {
    Session session = sampleSession();
    session.view->reference = session.images.size();
    const auto saved = saveSession(file(), session);
    ASSERT_FALSE(saved.ok());
    EXPECT_EQ(saved.error().code, ErrorCode::invalidArgument);
}

/// Scene, image and layers beyond the size of one piece, compressed and not.
TEST_F(SessionFile, LargePartsTravelInPieces) {
    Session session;
    std::vector<Mesh> meshes(2);
    std::uint64_t state = 1;
    const auto noise = [&] { return static_cast<float>(mix64(state++) >> 40); };
    for (int i = 0; i < 500'000; ++i) meshes[1].positions.push_back({noise(), 0, noise()});
    for (std::uint32_t i = 0; i < 400'000; ++i) meshes[1].triangles.push_back({i, i + 1, i + 2});
    auto field = std::make_shared<SurfaceField>();
    field->meshes.resize(2);
    field->meshes[1].faceCount = 400'000;
    std::vector<float> points(400'000, 1), values(1'200'000);
    for (float& v : values) v = noise();
    field->points = points;
    field->layers = {{{"color", LayerKind::meanColor, "", ""}, values, 400'000, 1}};
    session.meshes = std::make_shared<const std::vector<Mesh>>(std::move(meshes));
    session.surface = field;
    auto image = std::make_shared<RenderedImage>();
    image->color = Image(1500, 1000);
    for (std::size_t i = 0; i < image->color.size(); i += 2) image->color.data()[i] = noise();
    session.images = {{"large", image}};
    ASSERT_TRUE(saveSession(file(), session).ok());
    const auto opened = openSession(file());
    ASSERT_TRUE(opened.ok()) << opened.error().message;
    EXPECT_TRUE(opened->whole);
    EXPECT_EQ(difference(opened->session, session), "");
}

TEST_F(SessionFile, ColumnsOutliveEverythingElse) {
    ASSERT_TRUE(saveSession(file(), sampleSession()).ok());
    PathSet paths;
    {
        const auto opened = openSession(file());
        ASSERT_TRUE(opened.ok());
        paths = opened->session.traces[1]->paths;
    }
    std::filesystem::remove(file());
    EXPECT_EQ(paths.sample(0), -3) << "read under ASan after the file and the session are gone";
    EXPECT_EQ(paths.value(*paths.find(Scope::vertex, "pdf").front(), 1), Value(0.25));
}

/// The models hold what a session holds, in the order of the explorer's calls.
TEST_F(SessionFile, ModelsGoToAFileAndBack) {
    const Session session = sampleSession();
    Dataset dataset;
    Selection selection;
    int told = 0;
    dataset.listen([&](std::uint32_t parts) {
        ++told;
        EXPECT_TRUE(parts & DatasetPart::images && parts & DatasetPart::traces && parts & DatasetPart::surface && parts & DatasetPart::currentTrace);
    });
    show(session, dataset, selection);
    EXPECT_EQ(told, 1);
    ASSERT_EQ(dataset.current().size(), 2u);
    EXPECT_EQ(dataset.paths().pathCount(), 6u);
    Session back = sessionOf(dataset, selection);
    EXPECT_NE(back.images[2].image, session.images[2].image) << "others write to a preview while it is saved";
    back.notes = session.notes;
    back.pixelNotes = session.pixelNotes;
    back.filter = session.filter;  // of the window, as the notes
    back.view = session.view;
    // A current path that is not among the selected ones is no state of Selection; the sample obeys its rules.
    EXPECT_EQ(difference(back, session), "");
    show(Session(), dataset, selection);
    EXPECT_TRUE(dataset.images().empty() && dataset.traces().empty() && dataset.paths().empty() && !dataset.info());
    EXPECT_EQ(selection.state(), Selection::State());
}

TEST_F(SessionFile, ARegionAndItsPathsGoToAFileAndBack) {
    for (const PixelRegion& region : {PixelRegion(PixelRect{8, 2, 10, 3}), PixelRegion(std::vector<Pixel>{{8, 2}, {3, 0}, {9, 2}})}) {
        Session session = sampleSession();
        session.selection.pixel.reset();
        session.selection.region = region;
        ASSERT_TRUE(saveSession(file(), session).ok());
        const auto opened = openSession(file());
        ASSERT_TRUE(opened.ok());
        EXPECT_TRUE(opened->whole);
        EXPECT_EQ(difference(opened->session, session), "");
        Dataset dataset;
        Selection selection;
        show(opened->session, dataset, selection);
        EXPECT_EQ(selection.state().region, region);
        EXPECT_EQ(PixelRegion(dataset.current().front()->pixels).text(), "region 2x1 at (0, 2)");
    }
}

TEST_F(SessionFile, WhatAReaderWouldNotBelieveIsNotSaved) {
    const auto refusal = [&](const Session& session) {
        const auto saved = saveSession(file(), session);
        EXPECT_FALSE(std::filesystem::exists(file()));
        return saved ? std::string("was saved") : saved.error().message;
    };
    Session session = sampleSession();
    session.meshes = nullptr;
    EXPECT_NE(refusal(session).find("not the scene that they lie on"), std::string::npos);
    session = sampleSession();
    auto trace = std::make_shared<Trace>(*session.traces[0]);
    trace->replays.pop_back();
    session.traces[0] = trace;
    EXPECT_NE(refusal(session).find("not one comparison per pixel"), std::string::npos);
    session.traces[0] = nullptr;
    EXPECT_NE(refusal(session).find("null"), std::string::npos);
    session = sampleSession();
    session.images[0].image = nullptr;
    EXPECT_NE(refusal(session).find("\"render 1, 64 spp\" has no pixels"), std::string::npos);
}

TEST_F(SessionFile, BothWaysCanBeWatchedAndGivenUp) {
    std::vector<double> fractions;
    RequestObserver observer;
    observer.progress = [&](double fraction) { fractions.push_back(fraction); };
    ASSERT_TRUE(saveSession(file(), sampleSession(), observer).ok());
    ASSERT_TRUE(openSession(file(), {}, observer).ok());
    EXPECT_GT(fractions.size(), 20u);
    for (const double fraction : fractions) EXPECT_TRUE(fraction > 0 && fraction <= 1) << fraction;
    observer.cancel = std::make_shared<std::atomic<bool>>(true);
    const auto before = test::contents(file());
    const auto saved = saveSession(file(), Session(), observer);
    ASSERT_FALSE(saved.ok());
    EXPECT_EQ(saved.error().code, ErrorCode::cancelled);
    EXPECT_EQ(test::contents(file()), before);
    EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder_), {}), 1) << "nothing is left beside it";
    const auto opened = openSession(file(), {}, observer);
    ASSERT_FALSE(opened.ok());
    EXPECT_EQ(opened.error().code, ErrorCode::cancelled);
}

TEST_F(SessionFile, WhatIsNoSessionIsRefusedWithASentence) {
    const auto error = [](const std::filesystem::path& path) {
        const auto opened = openSession(path);
        EXPECT_FALSE(opened.ok());
        return opened ? Error{} : opened.error();
    };
    EXPECT_EQ(error(file("none.emca")).code, ErrorCode::fileNotFound);
    EXPECT_EQ(error(folder_).code, ErrorCode::fileUnreadable);
    test::put(file(), {});
    EXPECT_EQ(error(file()).message, "The session " + file().string() + " cannot be opened: it is empty.");
    std::ofstream(file()) << "v/1 of some other program that is longer than a header";
    EXPECT_EQ(error(file()).message,
              "The session " + file().string() + " cannot be opened: it is no EMCA session, or its first bytes are damaged.");
    EXPECT_FALSE(isSession(file()));
    EXPECT_FALSE(isSession(file("none.emca")));
}

/// tests/golden/session_v1.emca was written by the first version that saved sessions, and opens for ever. It is made
/// anew, where the format is meant to differ before its first release, with EMCA_WRITE_GOLDEN=1 in the environment.
TEST_F(SessionFile, TheGoldenFileOpens) {
    const std::filesystem::path golden = EMCA_SOURCE_DIR "/tests/golden/session_v1.emca";
    Session expected = sampleSession();
    expected.filter.reset();   // these came later
    expected.view.reset();
    if (std::getenv("EMCA_WRITE_GOLDEN")) {
        ASSERT_TRUE(saveSession(golden, expected, {}, {}, test::kSavedAt, test::kSoftware).ok());
    }
    const auto opened = openSession(golden);
    ASSERT_TRUE(opened.ok()) << opened.error().message;
    EXPECT_TRUE(opened->whole);
    EXPECT_TRUE(opened->notices.empty());
    EXPECT_EQ(opened->software, test::kSoftware);
    EXPECT_EQ(opened->saved, test::kSavedAt);
    EXPECT_EQ(difference(opened->session, expected), "");
}

}  // namespace
}  // namespace emca::client
