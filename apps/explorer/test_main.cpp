#include <gtest/gtest.h>

#include <QApplication>

#ifdef EMCA_GUARDED_TEST
#include "plugin/plugin_guard.h"
using TestedApplication = emca::explorer::GuardedApplication;
#else
using TestedApplication = QApplication;
#endif

int main(int argc, char** argv) {
    testing::InitGoogleTest(&argc, argv);
    TestedApplication application(argc, argv);
    // Tests must neither read nor leave a person's settings.
    QCoreApplication::setOrganizationName("emca-test");
    QCoreApplication::setApplicationName("emca-explorer-test");
    return RUN_ALL_TESTS();
}
