#include "camera_driver.h"

#include <gtest/gtest.h>

#include <QTest>

namespace emca::explorer {
namespace {

const ViewPose kHere{{0, 0, 5}, {0, 0, 0}, {0, 1, 0}, 45, false};
const ViewPose kThere{{5, 0, 0}, {0, 0, 0}, {0, 1, 0}, 45, false};

TEST(CameraDriver, flightEndsWhereItShouldAndBackReturns) {
    CameraDriver driver;
    driver.moveTo(kHere);
    int poses = 0;
    QObject::connect(&driver, &CameraDriver::poseChanged, [&](const ViewPose&) { ++poses; });
    driver.flyTo(kThere);
    EXPECT_TRUE(driver.isMoving());
    EXPECT_EQ(driver.target(), kThere);
    EXPECT_EQ(driver.pose(), kHere);
    ASSERT_TRUE(QTest::qWaitFor([&] { return !driver.isMoving(); }, 5000));
    EXPECT_EQ(driver.pose(), kThere);
    EXPECT_GT(poses, 1);
    ASSERT_TRUE(driver.canGoBack());
    driver.back();
    ASSERT_TRUE(QTest::qWaitFor([&] { return !driver.isMoving(); }, 5000));
    EXPECT_EQ(driver.pose(), kHere);
    EXPECT_FALSE(driver.canGoBack());
}

TEST(CameraDriver, withoutAnimationItJumps) {
    CameraDriver driver;
    driver.setAnimated(false);
    driver.moveTo(kHere);
    driver.flyTo(kThere);
    EXPECT_FALSE(driver.isMoving());
    EXPECT_EQ(driver.pose(), kThere);
    driver.flyTo(kThere);   // nowhere to go: nothing to return from
    driver.back();
    EXPECT_EQ(driver.pose(), kHere);
    driver.back();
    EXPECT_EQ(driver.pose(), kHere);
}

TEST(CameraDriver, aRedirectedFlightIsOneWayBack) {
    CameraDriver driver;
    driver.moveTo(kHere);
    driver.flyTo(kThere);
    driver.flyTo(flown(kThere, 1, 0, 0));
    driver.setAnimated(false);   // arrives at once
    EXPECT_EQ(driver.pose(), flown(kThere, 1, 0, 0));
    driver.back();
    EXPECT_EQ(driver.pose(), kHere);
}

TEST(CameraDriver, heldKeysFlyUntilReleased) {
    CameraDriver driver;
    driver.moveTo(kHere);
    driver.setStep(0.1);
    EXPECT_FALSE(driver.pressKey(Qt::Key_B, false));
    EXPECT_TRUE(driver.pressKey(Qt::Key_Up, false));
    EXPECT_NEAR(driver.pose().position.z, 4.9, 1e-12);   // the first step comes at once
    EXPECT_TRUE(QTest::qWaitFor([&] { return driver.pose().position.z < 4.7; }, 5000));
    driver.releaseKey(Qt::Key_Up);
    ASSERT_TRUE(QTest::qWaitFor([&] { return !driver.isMoving(); }, 5000));
    driver.back();
    driver.setAnimated(false);
    EXPECT_EQ(driver.pose(), kHere);
}

TEST(CameraDriver, LettersFlyAsArrowsDo) {
    for (const auto& [letter, arrow] : {std::pair(Qt::Key_W, Qt::Key_Up), std::pair(Qt::Key_S, Qt::Key_Down), std::pair(Qt::Key_A, Qt::Key_Left),
                                        std::pair(Qt::Key_D, Qt::Key_Right), std::pair(Qt::Key_E, Qt::Key_PageUp), std::pair(Qt::Key_Q, Qt::Key_PageDown)}) {
        CameraDriver a, b;
        for (CameraDriver* driver : {&a, &b}) driver->moveTo(kHere);
        EXPECT_TRUE(a.pressKey(letter, true));
        EXPECT_TRUE(b.pressKey(arrow, true));
        EXPECT_EQ(a.pose(), b.pose());
        EXPECT_NE(a.pose(), kHere);
        a.releaseKey(letter);
        EXPECT_TRUE(QTest::qWaitFor([&] { return !a.isMoving(); }, 5000));
    }
}

}  // namespace
}  // namespace emca::explorer
