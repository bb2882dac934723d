// emca-plugin-probe FILE: tries a plugin of the explorer, off screen, and says on its standard output whether it may be
// loaded. The explorer runs it for each plugin that it does not know (plugin/plugin_probe.h); by hand it tells the author
// of a plugin what the explorer would say.
// emca-plugin-probe --blocked NAME FILE PROCESS: what the explorer cannot show while a plugin blocks it (BlockedNotice).
#include <cstdio>
#include <cstdlib>

#include "base/theme.h"
#include "plugin/blocked_notice.h"
#include "plugin/plugin_guard.h"
#include "plugin/plugin_probe.h"
#include "plugin/probe_steps.h"

using namespace emca::explorer;

namespace {

int showBlocked(int argc, char** argv) {
    QApplication application(argc, argv);
    Theme theme;
    theme.applyTo(application);
    BlockedNotice notice(theme, QString::fromLocal8Bit(argv[2]), QString::fromLocal8Bit(argv[3]), QString::fromLocal8Bit(argv[4]).toLongLong());
    QObject::connect(&notice, &BlockedNotice::over, &application, &QCoreApplication::quit);
    notice.show();
    return QApplication::exec();
}

}  // namespace

int main(int argc, char** argv) {
    if (argc == 5 && qstrcmp(argv[1], "--blocked") == 0) return showBlocked(argc, argv);
    if (argc != 2) {
        std::fputs("emca-plugin-probe FILE\nTries a plugin of the EMCA explorer and says whether it may be loaded.\n", stderr);
        return 2;
    }
    if (!qEnvironmentVariableIsSet("QT_QPA_PLATFORM")) qputenv("QT_QPA_PLATFORM", "offscreen");
    GuardedApplication application(argc, argv);
    PluginGuard::instance().setUnknown([](const QString& what) {
        std::printf("%sit threw \"%s\" outside of its widget.\n", PluginProbe::kBad, qUtf8Printable(what));
        std::fflush(stdout);
        std::_Exit(1);
    });
    const QString refusal = tryPlugin(QString::fromLocal8Bit(argv[1]), [](const QString& step) {
        std::printf("%s%s\n", PluginProbe::kStep, qUtf8Printable(step));
        std::fflush(stdout);
    });
    if (refusal.isEmpty()) std::puts(PluginProbe::kGood);
    else std::printf("%s%s\n", PluginProbe::kBad, qUtf8Printable(refusal));
    std::fflush(stdout);
    // A plugin's threads and static objects have had their time: nothing of them shall change the verdict.
    std::_Exit(refusal.isEmpty() ? 0 : 1);
}
