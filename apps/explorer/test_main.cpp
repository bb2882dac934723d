#include <gtest/gtest.h>

#include <QApplication>

int main(int argc, char** argv) {
    testing::InitGoogleTest(&argc, argv);
    QApplication application(argc, argv);
    // Tests must neither read nor leave a person's settings.
    QCoreApplication::setOrganizationName("emca-test");
    QCoreApplication::setApplicationName("emca-explorer-test");
    return RUN_ALL_TESTS();
}
