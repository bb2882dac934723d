#pragma once

#include <QWidget>

#include "emca/client/dataset.h"

class QLabel;
class QProgressBar;
class QToolButton;

namespace emca::explorer {

class SessionController;
class Theme;

/// Content of the status bar: connection, what runs (with a cancel button), time of the last request, samples per pixel
/// and the replay verdict of what the views show.
class StatusStrip : public QWidget {
    Q_OBJECT
  public:
    StatusStrip(client::Dataset& dataset, SessionController& session, Theme& theme, QWidget* parent = nullptr);
    void refresh();

  protected:
    void paintEvent(QPaintEvent* event) override;

  private:
    void showLink();
    void showActivity();
    void showReplay();
    client::Dataset& dataset_;
    SessionController& session_;
    Theme& theme_;
    QLabel* link_;
    QLabel* activity_;
    QProgressBar* progress_;
    QToolButton* cancel_;
    QLabel* last_;
    QLabel* samples_;
    QLabel* verdict_;
};

}  // namespace emca::explorer
