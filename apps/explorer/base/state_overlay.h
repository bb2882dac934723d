#pragma once

#include <QWidget>
#include <functional>

class QLabel;
class QProgressBar;
class QPushButton;

namespace emca::explorer {

class Theme;

/// What a view shows instead of its content, or above it: an empty state that says what to do, a busy state with
/// progress, an error with a sentence and a button. Lies over its parent, follows its size, and is hidden while there is
/// content. Busy states sit in a small card at the top, so that one can go on with what is below.
class StateOverlay : public QWidget {
    Q_OBJECT
  public:
    StateOverlay(Theme& theme, QWidget* parent);

    /// \param action  text of the button; empty for none
    void showEmpty(const QString& title, const QString& sentence, const QString& action = {},
                   std::function<void()> onAction = {});
    void showError(const QString& sentence, const QString& action = {}, std::function<void()> onAction = {});
    /// \param fraction  in [0, 1]; negative: unknown, the bar moves
    void showBusy(const QString& sentence, double fraction = -1, const QString& action = {},
                  std::function<void()> onAction = {});
    void clear();

    QString sentence() const;  ///< what it says now; empty while hidden

  protected:
    bool eventFilter(QObject* watched, QEvent* event) override;
    void paintEvent(QPaintEvent* event) override;

  private:
    enum class State { none, empty, error, busy };
    void present(State state, const QString& title, const QString& sentence, const QString& action,
                 std::function<void()> onAction);
    void place();

    Theme& theme_;
    State state_ = State::none;
    QLabel* title_;
    QLabel* sentence_;
    QProgressBar* bar_;
    QPushButton* button_;
    std::function<void()> onAction_;
};

}  // namespace emca::explorer
