// Every fault is found by its check and by no other, and a good server has none.
#include <gtest/gtest.h>

#include <map>
#include <memory>
#include <string>

#include "emca/doctor/examination.h"
#include "emca/server/server.h"
#include "room_renderer.h"

namespace emca::doctor {
namespace {

using test::Fault;

struct Sick {
    explicit Sick(Fault fault) : renderer(fault), probe(std::make_shared<test::RoomProbe>(renderer, fault)) {
        auto started = Server::start(renderer, {});
        EXPECT_TRUE(started.ok()) << started.error().message;
        server = std::move(started).value();
        EXPECT_TRUE(server->addTool(probe).ok());
    }
    Examination examine(ExaminationOptions options = {}) const {
        auto examined = doctor::examine({"127.0.0.1", server->port()}, options);
        EXPECT_TRUE(examined.ok());
        return std::move(examined).value();
    }
    test::RoomRenderer renderer;
    std::shared_ptr<test::RoomProbe> probe;
    std::unique_ptr<Server> server;
};

std::string listOf(const Examination& examination) {
    std::string text;
    for (const Finding& f : examination.findings) text += f.check + ": " + name(f.outcome) + ": " + f.sentence + "\n";
    return text;
}

/// Checks that warn or fail, and how. All that is not listed is well.
using Diagnosis = std::map<std::string, Outcome>;

Diagnosis diagnosisOf(const Examination& examination) {
    Diagnosis diagnosis;
    for (const Finding& f : examination.findings)
        if (f.outcome >= Outcome::warning) diagnosis[f.check] = f.outcome;
    return diagnosis;
}

constexpr Outcome kWarning = Outcome::warning, kFailed = Outcome::failed;

/// All but those that take their time; `sayings` must appear in the sentences of what warns or fails.
void expectDiagnosis(Fault fault, const Diagnosis& expected, const std::vector<std::string>& sayings = {}) {
    const Sick sick(fault);
    ExaminationOptions options;
    options.pixels = 40;
    for (const std::string_view check : checkNames())
        if (check != "overhead" && check != "cancel") options.only.emplace_back(check);
    const Examination examination = sick.examine(options);
    EXPECT_EQ(diagnosisOf(examination), expected) << listOf(examination);
    EXPECT_FALSE(examination.lost);
    std::string said;
    for (const Finding& f : examination.findings) {
        if (f.outcome < Outcome::warning) continue;
        said += f.sentence + " " + f.advice + "\n";
        EXPECT_GT(f.sentence.size(), 20u);
        EXPECT_GT(f.advice.size(), 20u) << f.check << " says what to do";
    }
    for (const std::string& saying : sayings) EXPECT_NE(said.find(saying), std::string::npos) << saying << " in\n" << said;
}

TEST(Doctor, AGoodServerIsWell) {
    const Sick well(Fault::none);
    const Examination examination = well.examine();
    EXPECT_EQ(examination.findings.size(), checkNames().size());
    for (std::size_t i = 0; i < examination.findings.size(); ++i) {
        const Finding& f = examination.findings[i];
        EXPECT_EQ(f.check, checkNames()[i]);
        EXPECT_STREQ(name(f.outcome), "ok") << f.check << ": " << f.sentence;
        EXPECT_EQ(f.advice, "") << f.check;
        EXPECT_FALSE(f.sentence.empty()) << f.check;
    }
    EXPECT_EQ(std::get<std::int64_t>(*examination.find("replay")->find("exact")), 100);
    EXPECT_GT(std::get<std::int64_t>(*examination.find("surfaces")->find("onCurvedShapes")), 40) << "the ball";
    EXPECT_EQ(examination.samplesPerPixel, test::RoomRenderer::kSamples);
    ASSERT_TRUE(examination.info);
    EXPECT_EQ(examination.info->scene, "room");
    EXPECT_NE(examination.renderId, 0u);
}

TEST(Doctor, QuickLeavesOutWhatTakesLong) {
    const Sick well(Fault::none);
    ExaminationOptions options;
    options.quick = true;
    const Examination examination = well.examine(options);
    EXPECT_EQ(examination.findings.size(), checkNames().size() - 4);
    EXPECT_EQ(examination.find("overhead"), nullptr);
    EXPECT_EQ(std::get<std::int64_t>(*examination.find("replay")->find("pixels")), 20);
    EXPECT_EQ(diagnosisOf(examination), Diagnosis());
}

TEST(Doctor, OnlyWhatIsAskedFor) {
    const Sick well(Fault::none);
    ExaminationOptions options;
    options.only = {"sums"};
    options.pixels = 5;
    options.samplesPerPixel = 2;
    const Examination examination = well.examine(options);
    ASSERT_EQ(examination.findings.size(), 1u);
    EXPECT_EQ(std::get<std::int64_t>(*examination.findings[0].find("matches")), 5);
    EXPECT_EQ(examination.samplesPerPixel, 2u);
    options.only = {"sums", "horoscope"};
    const auto refused = examine({"127.0.0.1", well.server->port()}, options);
    ASSERT_FALSE(refused.ok());
    EXPECT_NE(refused.error().message.find("horoscope"), std::string::npos);
}

TEST(Doctor, InfoAndImage) {
    expectDiagnosis(Fault::nameless, {{"info", kWarning}});
    expectDiagnosis(Fault::randomImage, {{"image", kFailed}, {"replay", kFailed}, {"concurrent", kFailed}, {"layers", kFailed}}, {"of 432 pixels differ", "Seed each sample"});
    expectDiagnosis(Fault::notDeterministicAndSaysSo, {{"info", kWarning}, {"image", kWarning}, {"replay", kFailed}, {"layers", kWarning}});
    expectDiagnosis(Fault::nanPixels, {{"image", kWarning}}, {"1 pixel is NaN", "(3, 4)"});
    expectDiagnosis(Fault::blackImage, {{"image", kWarning}, {"replay", kFailed}}, {"black"});
    expectDiagnosis(Fault::ignoresSamples, {{"paths", kFailed}, {"sums", kFailed}}, {"3 paths for 8 samples"});
    expectDiagnosis(Fault::throwsInImage, {{"image", kFailed}, {"replay", kWarning}, }, {"out of paint"});
    expectDiagnosis(Fault::renderFails, {{"image", kFailed}, {"replay", kWarning}}, {"no frame"});
}

TEST(Doctor, Replay) {
    expectDiagnosis(Fault::differentReplay, {{"replay", kFailed}}, {"different"});
    expectDiagnosis(Fault::closeReplay, {{"replay", kWarning}}, {"40 close"});
    expectDiagnosis(Fault::throwsInPixel, {{"replay", kFailed}}, {"out of caffeine"});
    expectDiagnosis(Fault::throwsForSomePixels, {{"replay", kFailed}}, {"could not be replayed", "no such pixel"});
    expectDiagnosis(Fault::stateFromPixelToPixel, {{"pixel-list", kFailed}, {"samples", kWarning}}, {"alone"});
    expectDiagnosis(Fault::seedsFromSampleCount, {{"samples", kWarning}}, {"(pixel, sample)"});
    expectDiagnosis(Fault::sharedState, {{"concurrent", kFailed}}, {"RendererInfo::concurrent"});
}

TEST(Doctor, Paths) {
    expectDiagnosis(Fault::wrongEstimates, {{"sums", kFailed}}, {"In 40 pixels"});
    expectDiagnosis(Fault::noFinalEstimates, {{"sums", kWarning}}, {"No path has a final estimate"});
    expectDiagnosis(Fault::missingPaths, {{"paths", kFailed}, {"sums", kFailed}}, {"4 paths for 8 samples"});
    expectDiagnosis(Fault::depthGaps, {{"paths", kWarning}}, {"gaps"});
    expectDiagnosis(Fault::valuesBeforePath, {{"paths", kWarning}}, {"before setPathIndex"});
    expectDiagnosis(Fault::nanData, {{"values", kWarning}}, {"pdf: ", "depth 2"});
    expectDiagnosis(Fault::infiniteData, {{"values", kWarning}}, {"infinite"});
    expectDiagnosis(Fault::nanNextEvent, {{"values", kFailed}}, {"next-event position"});
    const Sick silent(Fault::noRecording);
    const Examination examination = silent.examine({.quick = true});
    EXPECT_STREQ(name(examination.find("paths")->outcome), "failed");
    EXPECT_NE(examination.find("paths")->sentence.find("No path was recorded"), std::string::npos);
    const Sick same(Fault::samePathIndex);
    EXPECT_STREQ(name(same.examine({.quick = true}).find("paths")->outcome), "failed");
    const Sick nowhere(Fault::nanPosition);
    EXPECT_STREQ(name(nowhere.examine({.quick = true}).find("values")->outcome), "failed");
}

TEST(Doctor, Surfaces) {
    expectDiagnosis(Fault::meshBeyond, {{"surfaces", kFailed}}, {"mesh 4"});
    expectDiagnosis(Fault::faceBeyond, {{"surfaces", kFailed}}, {"mesh 0, face 2"});
    expectDiagnosis(Fault::offSurface, {{"surfaces", kFailed}}, {"off their triangle"});
    expectDiagnosis(Fault::slightlyOff, {{"surfaces", kWarning}}, {"a little beside"});
    expectDiagnosis(Fault::meshesShifted, {{"surfaces", kFailed}}, {"on floor"});
}

TEST(Doctor, Meshes) {
    expectDiagnosis(Fault::nanMesh, {{"meshes", kFailed}}, {"mesh 0 (floor), vertex 2"});
    expectDiagnosis(Fault::emptyMesh, {{"meshes", kWarning}}, {"no triangle, first mesh 4"});
    expectDiagnosis(Fault::duplicateMesh, {{"meshes", kWarning}}, {"mesh 4 (lamp) is mesh 2 (lamp)"});
    expectDiagnosis(Fault::noMeshes, {{"meshes", kWarning}, {"surfaces", kFailed}, {"layers", kFailed}}, {"nothing to show"});
    const Sick bad(Fault::badIndices);
    const Examination examination = bad.examine({.quick = true});
    EXPECT_STREQ(name(examination.find("meshes")->outcome), "failed");
    EXPECT_NE(examination.find("meshes")->sentence.find("wall"), std::string::npos) << examination.find("meshes")->sentence;
    const Sick flat(Fault::degenerateMeshes);
    EXPECT_STREQ(name(flat.examine({.quick = true}).find("meshes")->outcome), "warning");
    const Sick unsteady(Fault::unsteadyMeshes);
    EXPECT_STREQ(name(unsteady.examine({.quick = true}).find("meshes")->outcome), "failed");
}

TEST(Doctor, Camera) {
    expectDiagnosis(Fault::nearBeyondFar, {{"camera", kFailed}}, {"not before far"});
    expectDiagnosis(Fault::cameraLooksAway, {{"camera", kWarning}, {"camera-rays", kFailed}}, {"behind", "opposite"});
    expectDiagnosis(Fault::cameraMirrored, {{"camera-rays", kFailed}}, {"left and right"});
    expectDiagnosis(Fault::fieldOfViewOfTheWidth, {{"camera-rays", kFailed}}, {"width"});
    expectDiagnosis(Fault::cameraElsewhere, {{"camera-rays", kWarning}}, {"other pixels"});
    for (const auto& [fault, outcome] : std::map<Fault, Outcome>{{Fault::cameraNotUnit, kFailed}, {Fault::cameraNotOrthogonal, kFailed}, {Fault::cameraNan, kFailed},
                                                                 {Fault::fieldOfViewOutOfRange, kFailed}, {Fault::cameraFarAway, kWarning}}) {
        const Sick sick(fault);
        const Examination examination = sick.examine({.pixels = 5, .only = {"camera"}});
        EXPECT_STREQ(name(examination.findings.at(0).outcome), name(outcome)) << examination.findings[0].sentence;
    }
}

TEST(Doctor, LayersAndTools) {
    expectDiagnosis(Fault::layersChangeImage, {{"layers", kFailed}}, {"other than without layers"});
    expectDiagnosis(Fault::layersEmpty, {{"layers", kWarning}}, {"No layer has any value"});
    expectDiagnosis(Fault::layersOffTheMeshes, {{"layers", kFailed}}, {"on no face"});
    expectDiagnosis(Fault::layersInfinite, {{"layers", kWarning}}, {"\"pdf\"", "not finite"});
    expectDiagnosis(Fault::probeRandom, {{"light-probe", kFailed}}, {"other bits"});
    expectDiagnosis(Fault::probeGarbage, {{"light-probe", kFailed}});
}

TEST(Doctor, BadRequests) {
    expectDiagnosis(Fault::acceptsAnyIntegrator, {{"bad-requests", kWarning}}, {"was accepted"});
    expectDiagnosis(Fault::grunts, {{"bad-requests", kWarning}}, {"refused with \"no\""});
}

TEST(Doctor, Cancel) {
    const Sick stubborn(Fault::ignoresCancel);
    const Examination examination = stubborn.examine({.only = {"cancel"}, .cancelLimitSeconds = 0.5});
    EXPECT_EQ(diagnosisOf(examination), (Diagnosis{{"cancel", kFailed}})) << listOf(examination);
    EXPECT_NE(examination.findings[0].sentence.find("went on for"), std::string::npos);
}

TEST(Doctor, Overhead) {
    const Sick slow(Fault::slowReplay);  // renders all for one pixel
    const Examination examination = slow.examine({.pixels = 2, .samplesPerPixel = 16, .only = {"overhead"}});
    EXPECT_EQ(diagnosisOf(examination), (Diagnosis{{"overhead", kWarning}})) << listOf(examination);
    const auto figure = [&](const char* name) { return std::get<double>(*examination.findings[0].find(name)); };
    EXPECT_GT(figure("replaySecondsPerSample"), 100 * figure("imageSecondsPerSample"));
}

TEST(Doctor, APersonGivesUp) {
    const Sick well(Fault::none);
    ExaminationObserver observer;
    observer.cancel = std::make_shared<std::atomic<bool>>(false);
    std::size_t finished = 0;
    observer.finished = [&](const Finding& f) {
        ++finished;
        if (f.check == "image") *observer.cancel = true;
    };
    const auto examination = examine({"127.0.0.1", well.server->port()}, {}, observer);
    ASSERT_TRUE(examination.ok());
    EXPECT_TRUE(examination->interrupted);
    EXPECT_EQ(examination->findings.size(), 5u);
    EXPECT_EQ(finished, 5u);
}

}  // namespace
}  // namespace emca::doctor
