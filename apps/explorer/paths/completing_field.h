#pragma once

#include <QLineEdit>
#include <functional>
#include <vector>

class QCompleter;
class QStandardItemModel;

namespace emca::explorer {

/// A line of text with a list of what could stand there: all of it with the arrow, Down, or a click into the empty field;
/// while one types, those that contain the text.
class CompletingField : public QLineEdit {
    Q_OBJECT
  public:
    struct Choice {
        QString text, meaning;
        friend bool operator==(const Choice&, const Choice&) = default;
    };
    explicit CompletingField(QWidget* parent = nullptr);

    void setChoices(std::vector<Choice> choices);
    /// Asked when the list is about to be shown, where it is costly to make.
    void setChoicesLater(std::function<std::vector<Choice>()> make);
    const std::vector<Choice>& choices() const { return choices_; }
    void showAll();

  signals:
    /// Typed, or taken from the list.
    void edited();

  protected:
    bool event(QEvent* event) override;
    void mousePressEvent(QMouseEvent* event) override;
    void keyPressEvent(QKeyEvent* event) override;
    void focusInEvent(QFocusEvent* event) override;

  private:
    void fill();
    void makeChoices();
    std::vector<Choice> choices_;
    std::function<std::vector<Choice>()> make_;
    QStandardItemModel* model_;
    QCompleter* completer_;
    QAction* arrow_;
};

}  // namespace emca::explorer
