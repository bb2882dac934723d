#pragma once

#include <QObject>
#include <QTimer>
#include <deque>
#include <functional>

#include "program/options.h"
#include "session/session_controller.h"

namespace emca::explorer {

class MainWindow;

/// Carries out the command line in an open window: opens, connects, renders, selects the pixel, and, if asked for, saves
/// pictures when everything is drawn.
class Unattended : public QObject {
    Q_OBJECT
  public:
    Unattended(Options options, client::Dataset& dataset, client::Selection& selection, SessionController& session, MainWindow& window);
    void start();

  signals:
    /// Only if options.unattended(). \param sentence  for the terminal; empty if all went well
    void ended(int exitCode, const QString& sentence);

  private:
    /// Runs when nothing is under way and everything is drawn.
    void then(std::function<void()> step) { steps_.push_back(std::move(step)); }
    void tick();
    bool isSettled();
    void end(int code, const QString& sentence = {});
    void selectPixel();
    void selectRegion();
    void showComparison();
    void selectSuspect();
    void onlyScene();
    void applyScene();
    void screenshot();
    void tour();
    void save(QWidget* widget, const QString& file, const QString& caption);

    Options options_;
    client::Dataset& dataset_;
    client::Selection& selection_;
    SessionController& session_;
    MainWindow& window_;
    std::deque<std::function<void()>> steps_;
    QTimer timer_;
    int settledTicks_ = 0;
    int pluginTicks_ = 0;   ///< for so long nothing was waited for but plugins
    bool ended_ = false;
    struct Picture {
        QString file, caption;
    };
    std::vector<Picture> pictures_;
};

}  // namespace emca::explorer
