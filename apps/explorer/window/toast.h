#pragma once

#include <QFrame>
#include <QTimer>
#include <functional>

class QLabel;
class QPushButton;

namespace emca::explorer {

class Theme;

/// A message card at the lower edge of the window: a sentence, a button for the way on, and a cross. Errors stay until
/// they are closed, settled or replaced; remarks go by themselves.
class Toast : public QFrame {
    Q_OBJECT
  public:
    Toast(Theme& theme, QWidget* window);
    void showError(const QString& sentence, const QString& action = {}, std::function<void()> onAction = {});
    void showRemark(const QString& sentence);
    void clear();
    QString sentence() const;

  protected:
    bool eventFilter(QObject* watched, QEvent* event) override;
    void paintEvent(QPaintEvent* event) override;

  private:
    void present(const QString& sentence, const QString& action, std::function<void()> onAction, bool error);
    void place();
    Theme& theme_;
    QLabel* label_;
    QPushButton* button_;
    std::function<void()> onAction_;
    QTimer timer_;
    bool error_ = false;
};

}  // namespace emca::explorer
