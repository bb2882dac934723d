#pragma once

#include <QDockWidget>

class QLabel;

namespace emca::explorer {

class Theme;

/// A dock with a quiet title line. In a group of tabs the tab is the title and the line goes.
class PanelDock : public QDockWidget {
    Q_OBJECT
  public:
    /// \param name  of the saved layout; stays the same when the title changes
    PanelDock(const QString& title, const QString& name, QWidget* content, QWidget* parent);
    /// Shows or hides the title line after docks moved.
    void updateTitle();

  private:
    QWidget* title_;
    QWidget* none_;
    QLabel* label_;
};

}  // namespace emca::explorer
