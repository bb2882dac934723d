#include <QApplication>
#include <QTemporaryDir>
#include <cstdio>
#include <cstdlib>

#include "program/options.h"
#include "program/unattended.h"
#include "scene/scene_view.h"
#include "plugin/plugin_guard.h"
#include "window/main_window.h"
#include "window/window_plugins.h"

using namespace emca;
using namespace emca::explorer;

namespace {

int run(QApplication& application, const Options& options) {
    // Pictures look the same on every machine: nobody's layout takes part in them.
    QTemporaryDir fresh;
    const QString file = !options.settings.isEmpty() ? options.settings : options.unattended() ? fresh.filePath("settings.ini") : QString();
    auto settings = file.isEmpty() ? std::make_unique<QSettings>() : std::make_unique<QSettings>(file, QSettings::IniFormat);

    Theme theme;
    client::Dataset dataset;
    client::Selection selection;
    SessionController session(dataset, selection);
    if (options.theme) settings->setValue("theme", *options.theme == ThemeKind::light ? "light" : "dark");
    theme.applyTo(application);
    MainWindow window(dataset, selection, session, theme, *settings);
    PluginManager::Options pluginOptions = PluginManager::Options::standard();
    pluginOptions.files = options.plugins;
    if (options.withoutPlugins) pluginOptions.folders.clear();
    WindowPlugins plugins(window, dataset, selection, session, theme, *settings, std::move(pluginOptions));
    PluginWatch::markCrashes(PluginManager::markPrefix(*settings));
    plugins.start();
    if (options.size.isValid()) window.resize(options.size);
    window.show();

    Unattended steps(options, dataset, selection, session, window);
    QObject::connect(&steps, &Unattended::ended, &application, [](int code, const QString& sentence) {
        if (!sentence.isEmpty()) std::fprintf(stderr, "emca-explorer: %s\n", qUtf8Printable(sentence));
        QCoreApplication::exit(code);
    }, Qt::QueuedConnection);
    steps.start();
    const int code = QApplication::exec();
    if (!plugins.manager().end()) {
        // Work of a plugin that does not end, however often it was told to, must not keep the process.
        settings->sync();
        std::fflush(nullptr);
        std::_Exit(code);
    }
    return code;
}

}  // namespace

int main(int argc, char** argv) {
    QStringList arguments;
    for (int i = 1; i < argc; ++i) arguments += QString::fromLocal8Bit(argv[i]);
    const auto options = parseOptions(arguments);
    if (!options) {
        std::fprintf(stderr, "emca-explorer: %s\n", options.error().message.c_str());
        return exitCode(options.error());
    }
    if (options->help) {
        std::fputs(qUtf8Printable(usage()), stdout);
        return 0;
    }
    prepareOpenGl();
    QCoreApplication::setOrganizationName("emca");
    QCoreApplication::setApplicationName("emca-explorer");
#if QT_VERSION < QT_VERSION_CHECK(6, 0, 0)
    QCoreApplication::setAttribute(Qt::AA_EnableHighDpiScaling);
    QCoreApplication::setAttribute(Qt::AA_UseHighDpiPixmaps);
#endif
    // Of our options some are called as Qt's own (--plugin, --style): all have been read.
    int own = 1;
    GuardedApplication application(own, argv);
    return run(application, *options);
}
