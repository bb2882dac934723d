// Plugins that behave, and every way of not behaving: what they may do, and that it harms nobody.
#include <gtest/gtest.h>

#include <QCheckBox>
#include <QDir>
#include <QFile>
#include <QProcess>
#include <QPushButton>
#include <thread>

#include "base/state_overlay.h"
#include "plugin/blocked_notice.h"
#include "plugin/plugin_for_tests.h"
#include "plugin/plugins_panel.h"
#include "plugin/probe_steps.h"

namespace emca::explorer {
namespace {

using State = PluginRecord::State;

// What may be loaded ----------------------------------------------------------------------------

PluginEntry goodEntry() {
    return {{'E', 'M', 'C', 'A', 'p', 'l', 'u', 'g'}, sizeof(PluginEntry), kPluginInterface, kEmcaVersion, QT_VERSION_STR, binaryInterface(), layoutOfSharedTypes(),
            "good", "Good", "Is good.", PluginPlace::tools, [](PluginContext&) -> QWidget* { return nullptr; }};
}

TEST(PluginEntryTest, OnlyWhatFitsExactlyIsCalled) {
    EXPECT_TRUE(checkEntry(goodEntry(), "good.so"));
    const auto refused = [](auto change, ErrorCode code) {
        PluginEntry entry = goodEntry();
        change(entry);
        const auto checked = checkEntry(entry, "bad.so");
        ASSERT_FALSE(checked);
        EXPECT_EQ(checked.error().code, code) << checked.error().message;
        EXPECT_NE(checked.error().message.find("bad.so"), std::string::npos);
    };
    refused([](PluginEntry& e) { e.magic[0] = 'X'; }, ErrorCode::fileUnreadable);
    refused([](PluginEntry& e) { e.interfaceVersion += 1; }, ErrorCode::versionMismatch);
    refused([](PluginEntry& e) { e.bytes -= 8; }, ErrorCode::versionMismatch);
    refused([](PluginEntry& e) { e.emca = "0.0.9"; }, ErrorCode::versionMismatch);
    refused([](PluginEntry& e) { e.emca = nullptr; }, ErrorCode::fileUnreadable);
    refused([](PluginEntry& e) { e.qt = "4.8.7"; }, ErrorCode::versionMismatch);
    refused([](PluginEntry& e) { e.qt = "5.99.0"; }, ErrorCode::versionMismatch);
    refused([](PluginEntry& e) { e.binary = "another"; }, ErrorCode::versionMismatch);
    refused([](PluginEntry& e) { e.layout ^= 1; }, ErrorCode::versionMismatch);
    refused([](PluginEntry& e) { e.id = "Not/Good"; }, ErrorCode::invalidArgument);
    refused([](PluginEntry& e) { e.title = ""; }, ErrorCode::invalidArgument);
    refused([](PluginEntry& e) { e.make = nullptr; }, ErrorCode::invalidArgument);
}

TEST(PluginEntryTest, TheVersionInTheHeaderIsTheProjects) {
    QFile file(EMCA_SOURCE_DIR "/CMakeLists.txt");
    ASSERT_TRUE(file.open(QIODevice::ReadOnly));
    EXPECT_TRUE(QString::fromUtf8(file.readAll()).contains(QStringLiteral("project(emca VERSION %1 ").arg(kEmcaVersion)));
}

TEST(PluginSample, HasEveryKindOfValue) {
    const auto trace = sampleTrace();
    EXPECT_EQ(trace->paths.pathCount(), 3u);
    EXPECT_EQ(trace->paths.vertexCount(), 12u);
    EXPECT_EQ(trace->paths.userColumns().size(), 7u);
}

TEST_F(PluginTest, AGoodOneIsTriedOnceLoadedAndRuns) {
    const PluginRecord& record = triedMoody();
    EXPECT_EQ(record.state, State::running) << record.reason.toStdString();
    EXPECT_EQ(record.title, "Moody");
    EXPECT_EQ(views.size(), 1u);
    EXPECT_TRUE(problems.isEmpty());
    // The verdict about this file is kept: the next start loads it at once.
    begin();
    manager->start();
    EXPECT_TRUE(manager->isSettled());
    EXPECT_EQ(manager->records().front()->state, State::running);
}

TEST_F(PluginTest, FoldersAreSearchedAndAnIdIsLoadedOnce) {
    ASSERT_TRUE(QFile::copy(pluginFile("moody"), folder.filePath("a.so")));
    ASSERT_TRUE(QFile::copy(pluginFile("moody"), folder.filePath("b.so")));
    options.folders = QStringList{folder.path(), "/nowhere"};
    begin();
    manager->start();
    ASSERT_TRUE(waitFor([&] { return manager->isSettled(); }));
    ASSERT_EQ(manager->records().size(), 2u);
    const auto running = std::count_if(manager->records().begin(), manager->records().end(), [](const auto& r) { return r->state == State::running; });
    EXPECT_EQ(running, 1);
    EXPECT_EQ(views.size(), 1u);
}

TEST_F(PluginTest, WhatIsNoPluginIsRefusedWithAWord) {
    const auto expectRefused = [this](const QString& file, const char* word) {
        const PluginRecord& record = tried(file);
        EXPECT_EQ(record.state, State::refused);
        EXPECT_TRUE(record.reason.contains(word)) << record.reason.toStdString();
        ASSERT_EQ(problems.size(), 1);
        EXPECT_TRUE(problems[0].contains(word)) << problems[0].toStdString();
        EXPECT_TRUE(views.empty());
    };
    expectRefused(pluginFile("other_version"), "version 99");
    expectRefused(pluginFile("no_plugin"), "emca_explorer_plugin");
    expectRefused(folder.filePath("absent.so"), "not there");
    QFile text(folder.filePath("text.so"));
    ASSERT_TRUE(text.open(QIODevice::WriteOnly));
    text.write("not a library");
    text.close();
    expectRefused(text.fileName(), "cannot be loaded");
    // Cut in the middle, as by a copy that failed.
    QFile whole(pluginFile("moody")), half(folder.filePath("half.so"));
    ASSERT_TRUE(whole.open(QIODevice::ReadOnly) && half.open(QIODevice::WriteOnly));
    half.write(whole.read(whole.size() / 2));
    half.close();
    EXPECT_EQ(tried(half.fileName()).state, State::refused);
}

TEST_F(PluginTest, WhatFailsWhileItIsTriedIsNeverLoaded) {
    for (const char* mood : {"throw in make", "throw in dataset", "throw in selection", "throw in look", "throw in paint", "throw in timer",
                             "throw a number in make", "crash in loading", "throw in loading", "crash in make", "make nothing"}) {
        setMood(mood);
        const PluginRecord& record = triedMoody();
        EXPECT_EQ(record.state, State::refused) << mood;
        EXPECT_FALSE(record.reason.isEmpty()) << mood;
        EXPECT_TRUE(views.empty()) << mood;
    }
}

TEST_F(PluginTest, WhatHangsWhileItIsTriedIsEndedAndTheWindowGoesOn) {
    options.probeLimit = std::chrono::milliseconds(700);
    for (const char* mood : {"hang in loading", "hang in make", "hang in selection"}) {
        setMood(mood);
        const PluginRecord& record = triedMoody();
        EXPECT_EQ(record.state, State::refused) << mood;
        EXPECT_TRUE(record.reason.contains("did not come back")) << record.reason.toStdString();
    }
    setMood("");
    options.probeLimit = std::chrono::milliseconds(20000);
    begin();
    manager->start();
    ASSERT_TRUE(waitFor([&] { return manager->isSettled(); }));
    EXPECT_EQ(manager->records().front()->state, State::running) << "a refusal is not remembered: the machine may have been busy";
}

TEST_F(PluginTest, WithoutTheChildNothingIsLoaded) {
    options.probeProgram = "/nowhere/emca-plugin-probe";
    const PluginRecord& record = triedMoody();
    EXPECT_EQ(record.state, State::refused);
    EXPECT_TRUE(record.reason.contains("does not start")) << record.reason.toStdString();
}

// What runs may fail ----------------------------------------------------------------------------

TEST_F(PluginTest, WhatThrowsLaterIsStoppedAndCanBeStartedAgain) {
    const auto trace = sampleTrace();
    std::uint32_t pixel = 0;
    const std::vector<std::pair<const char*, std::function<void()>>> occasions{
        {"dataset", [&] { dataset.addTrace(trace); }},
        {"selection", [&] { selection.setPixel(Pixel{++pixel, 1}); }},
        {"look", [&] { theme.setKind(theme.isDark() ? ThemeKind::light : ThemeKind::dark); }},
        {"pick", [&] { services.picked("box", 1); }},
        {"paint", [&] { views.back()->findChild<QWidget*>("moody")->repaint(); }},
        {"timer", [] { QTest::qWait(20); }},
        {"click", [&] { QTest::mouseClick(views.back()->findChild<QPushButton*>("moodyButton"), Qt::LeftButton); }},
    };
    for (const auto& [place, occasion] : occasions) {
        const PluginRecord& record = triedMoody();
        ASSERT_EQ(record.state, State::running) << record.reason.toStdString();
        int others = 0;
        const auto listener = selection.listen([&](std::uint32_t) { ++others; });
        setMood((std::string("throw in ") + place).c_str());
        occasion();
        ASSERT_TRUE(waitFor([&] { return record.state == State::stopped; })) << place;
        EXPECT_TRUE(record.reason.contains(QStringLiteral("thrown in %1").arg(place))) << record.reason.toStdString();
        ASSERT_TRUE(waitFor([&] { return views.back()->findChild<QWidget*>("moody") == nullptr; })) << place;
        EXPECT_TRUE(views.back()->overlay().sentence().contains("was stopped")) << place;
        EXPECT_TRUE(problems.size() == 1 && problems[0].contains("Moody")) << problems.join('|').toStdString();
        // Others are told as before, and it is not.
        selection.setPixel(Pixel{++pixel, 1});
        EXPECT_GT(others, 0) << place;
        selection.unlisten(listener);
        setMood("");
        auto* again = views.back()->overlay().findChild<QPushButton*>();
        ASSERT_NE(again, nullptr);
        QTest::mouseClick(again, Qt::LeftButton);
        EXPECT_EQ(record.state, State::running) << place;
        EXPECT_NE(views.back()->findChild<QWidget*>("moody"), nullptr) << place;
    }
}

TEST_F(PluginTest, WhoeverBlocksTheWindowIsNamed) {
    triedMoody();
    press("block in click");
    setMood("");
    ASSERT_TRUE(waitFor([&] { return !problems.isEmpty(); }));
    EXPECT_TRUE(problems[0].contains("Moody") && problems[0].contains("kept the window")) << problems[0].toStdString();
    EXPECT_TRUE(QDir(folder.path()).entryList({"*.plugin-blocks"}).isEmpty()) << "it came back, so nothing is held against it";
}

TEST_F(PluginTest, TheNoticeGoesWithTheBlockAndEndsTheExplorerIfAPersonWants) {
    QFile mark(folder.filePath("mark"));
    ASSERT_TRUE(mark.open(QIODevice::WriteOnly));
    QProcess explorer;   // stands for it
    explorer.start("sleep", {"600"});
    ASSERT_TRUE(explorer.waitForStarted());
    BlockedNotice notice(theme, "Moody", mark.fileName(), explorer.processId());
    int over = 0;
    QObject::connect(&notice, &BlockedNotice::over, [&] { ++over; });
    notice.show();
    QTest::qWait(450);
    EXPECT_EQ(over, 0);
    for (QPushButton* button : notice.findChildren<QPushButton*>())
        if (button->text().contains("End")) QTest::mouseClick(button, Qt::LeftButton);
    EXPECT_TRUE(explorer.waitForFinished());
    EXPECT_EQ(over, 1);
    EXPECT_FALSE(isAlive(999999999));
    mark.remove();
    EXPECT_TRUE(waitFor([&] { return over > 1; }));
}

TEST_F(PluginTest, AnIdleLoopThatAPluginOpenedBlocksNobody) {
    triedMoody();
    PluginGuard::instance().setIdle(true);
    {
        const PluginGuard::Scope scope(PluginGuard::instance(), 0);
        EXPECT_EQ(PluginGuard::instance().current(), PluginGuard::kNobody);
        PluginGuard::instance().setIdle(false);
        EXPECT_EQ(PluginGuard::instance().current(), 0);
    }
}

TEST_F(PluginTest, WhatEndedTheExplorerLastTimeIsLeftOutUntilAPersonWantsIt) {
    // Marks as two processes have left them that live no more.
    QFile mark(PluginManager::markPrefix(settings) + ".999999999.plugin-crash");
    ASSERT_TRUE(mark.open(QIODevice::WriteOnly));
    mark.write(pluginFile("moody").toUtf8());
    mark.close();
    const PluginRecord& record = triedMoody();
    EXPECT_EQ(record.state, State::off);
    EXPECT_TRUE(record.reason.contains("crashed")) << record.reason.toStdString();
    EXPECT_FALSE(mark.exists());
    manager->setOn(record.file, true);
    ASSERT_TRUE(waitFor([&] { return manager->isSettled(); }));
    EXPECT_EQ(record.state, State::running);
    EXPECT_EQ(triedMoody().state, State::running);
}

TEST_F(PluginTest, ACrashLeavesAMarkWithTheNameOfThePlugin) {
    triedMoody();
    setMood("crash in click");
    auto* button = views.back()->findChild<QPushButton*>("moodyButton");
    testing::FLAGS_gtest_death_test_style = "fast";
    EXPECT_EXIT(
        {
            PluginWatch::markCrashes(PluginManager::markPrefix(settings));
            QTest::mouseClick(button, Qt::LeftButton);
        },
        testing::KilledBySignal(SIGABRT), "");
    const auto marks = PluginWatch::takeMarks(PluginManager::markPrefix(settings));
    // The child of a death test shares the number with nobody: it is gone.
    const QStringList left = QDir(folder.path()).entryList({"*.plugin-crash"});
    ASSERT_TRUE(marks.size() == 1 || left.size() == 1);
    if (marks.size() == 1) {
        EXPECT_EQ(marks[0].file, pluginFile("moody"));
    }
}

// What a plugin may do --------------------------------------------------------------------------

TEST_F(PluginTest, SelectionIsLinkedBothWays) {
    triedMoody();
    dataset.addTrace(sampleTrace());
    EXPECT_EQ(label(), "3 paths, 0 selected");
    const client::PathId path{Pixel{1, 2}, 1, 0};
    selection.setPaths({path});
    EXPECT_EQ(label(), "3 paths, 1 selected");
    press("select");
    EXPECT_EQ(selection.state().vertex, (client::VertexId{{Pixel{1, 2}, 2, 0}, 3, Subpath::camera}));
    EXPECT_EQ(label(), "3 paths, 2 selected") << "it hears of what it did itself";
}

TEST_F(PluginTest, ObjectsAppearArePickedAndGoWithThePlugin) {
    triedMoody();
    press("object");
    ASSERT_EQ(services.objects.count("moody/bounds"), 1u);
    services.picked("bounds", 5);
    EXPECT_EQ(label(), "bounds5");
    press("bad object");
    EXPECT_EQ(label(), "refused");
    EXPECT_EQ(services.objects.size(), 1u);
    setMood("throw in click");
    QTest::mouseClick(views.back()->findChild<QPushButton*>("moodyButton"), Qt::LeftButton);
    EXPECT_TRUE(services.objects.empty());
}

TEST_F(PluginTest, RequestsAreAnsweredInTheGuiThread) {
    connectToRenderer();
    triedMoody();
    press("ask");
    EXPECT_TRUE(waitFor([&] { return label() == "2 bytes"; })) << label().toStdString();
}

TEST_F(PluginTest, AToolThatDoesNotAnswerTimesOut) {
    connectToRenderer();
    triedMoody();
    EXPECT_FALSE(manager->isWorking());
    press("ask in vain");
    EXPECT_TRUE(manager->isWorking()) << "a picture of the window waits for it";
    EXPECT_TRUE(waitFor([&] { return label() == QString("error %1").arg(int(ErrorCode::timedOut)); })) << label().toStdString();
    EXPECT_FALSE(manager->isWorking());
}

TEST_F(PluginTest, WithoutARendererTheAnswerSaysSo) {
    triedMoody();
    press("ask");
    EXPECT_EQ(label(), "") << "never before ask() has returned";
    EXPECT_TRUE(waitFor([&] { return label().contains("No renderer"); })) << label().toStdString();
}

TEST_F(PluginTest, WhatThrowsInAnAnswerIsStopped) {
    connectToRenderer();
    const PluginRecord& record = triedMoody();
    press("ask and throw");
    EXPECT_TRUE(waitFor([&] { return record.state == State::stopped; }));
    EXPECT_TRUE(record.reason.contains("thrown in answered")) << record.reason.toStdString();
}

TEST_F(PluginTest, WorkRunsElsewhereAndItsExceptionsArriveAsErrors) {
    triedMoody();
    press("work");
    EXPECT_TRUE(waitFor([&] { return label() == "42"; })) << label().toStdString();
    press("work throws");
    EXPECT_TRUE(waitFor([&] { return label().contains("no luck"); })) << label().toStdString();
    press("work that is replaced");
    EXPECT_TRUE(waitFor([&] { return label().contains("result 1"); })) << label().toStdString();
    EXPECT_FALSE(label().contains("result 0"));
}

TEST_F(PluginTest, SettingsAreKeptAndComeBackWithALayout) {
    triedMoody();
    press("set");
    const QVariantMap saved = manager->savedSettings();
    EXPECT_EQ(saved["moody/word"], "kept");
    settings.setValue("plugins/moody/word", "another");
    manager->restoreSettings(saved);
    EXPECT_EQ(label(), "kept");
}

TEST_F(PluginTest, TheEndWaitsForWorkAndComes) {
    triedMoody();
    press("endless work");
    EXPECT_TRUE(manager->isWorking());
    EXPECT_TRUE(manager->end()) << "it looks at TaskState::cancelled";
    EXPECT_EQ(views.back()->findChild<QWidget*>("moody"), nullptr);
    manager.reset();
    selection.setPixel(Pixel{3, 3});   // nobody is called any more
}

TEST_F(PluginTest, AViewThatGoesBeforeItsPluginIsNoProblem) {
    triedMoody();
    delete views.back();
    selection.setPixel(Pixel{3, 4});
    EXPECT_TRUE(manager->end());
}

TEST_F(PluginTest, ThePageListsAllWithReasonsAndSwitches) {
    options.files = QStringList{pluginFile("moody"), pluginFile("no_plugin")};
    begin();
    PluginsPanel panel(*manager, theme);
    panel.resize(364, 500);
    panel.show();
    manager->start();
    ASSERT_TRUE(waitFor([&] { return manager->isSettled(); }));
    QTest::qWait(10);
    const auto words = [&] {
        QStringList all;
        for (const QLabel* label : panel.findChildren<QLabel*>()) all << label->text();
        return all.join('|');
    };
    EXPECT_TRUE(words().contains("running") && words().contains("refused") && words().contains("does not export")) << words().toStdString();
    auto* on = panel.findChild<QCheckBox*>("plugin Moody");
    ASSERT_NE(on, nullptr);
    QTest::mouseClick(on, Qt::LeftButton, {}, QPoint(8, on->height() / 2));
    ASSERT_TRUE(waitFor([&] { return words().contains("Switched off"); })) << words().toStdString();
    EXPECT_EQ(manager->find(pluginFile("moody"))->state, State::off);
    EXPECT_EQ(views.back()->findChild<QWidget*>("moody"), nullptr);
    on = panel.findChild<QCheckBox*>("plugin Moody");
    QTest::mouseClick(on, Qt::LeftButton, {}, QPoint(8, on->height() / 2));
    EXPECT_TRUE(waitFor([&] { return manager->find(pluginFile("moody"))->state == State::running; }));
}

}  // namespace
}  // namespace emca::explorer
