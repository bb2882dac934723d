#pragma once

#include <QFrame>
#include <QStringList>
#include <functional>
#include <vector>

class QHBoxLayout;
class QLabel;

namespace emca::explorer {

class Theme;

/// A card below the toolbar that asks a question or says something of several sentences, where other programs would
/// stop a person with a dialog: all views go on. One at a time; a new one takes the place of an old one.
class NoticeCard : public QFrame {
    Q_OBJECT
  public:
    enum class Tone { remark, question, warning };
    struct Answer {
        QString text;
        std::function<void()> run;    ///< called after the card has gone
        bool primary = false;         ///< has the focus: Return chooses it
    };
    static constexpr int kLines = 6;  ///< more are counted

    NoticeCard(Theme& theme, QWidget* window);
    /// \param answers  empty: only the cross. The cross and Esc choose nothing.
    void present(Tone tone, const QString& title, const QStringList& lines, std::vector<Answer> answers = {});
    void clear();
    /// Title and lines as they are shown; empty while it is hidden.
    QString text() const;

  protected:
    bool event(QEvent* event) override;
    bool eventFilter(QObject* watched, QEvent* event) override;
    void keyPressEvent(QKeyEvent* event) override;
    void paintEvent(QPaintEvent* event) override;

  private:
    void place();
    Theme& theme_;
    Tone tone_ = Tone::remark;
    QLabel* title_;
    QLabel* lines_;
    QWidget* row_;
    QHBoxLayout* answers_;
};

}  // namespace emca::explorer
