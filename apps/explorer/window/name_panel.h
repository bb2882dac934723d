#pragma once

#include <QFrame>
#include <functional>

class QLabel;
class QLineEdit;
class QPushButton;

namespace emca::explorer {

/// Asks for a name below the menus: a line and a button. It goes when one clicks elsewhere, or with Esc.
class NamePanel : public QFrame {
    Q_OBJECT
  public:
    explicit NamePanel(QWidget* window);
    /// \param taken  names that exist: the button says that they are replaced
    void ask(const QString& question, const QString& suggestion, const QStringList& taken, std::function<void(const QString&)> named);

  private:
    void update();
    void submit();
    QLabel* question_;
    QLineEdit* name_;
    QPushButton* button_;
    QStringList taken_;
    std::function<void(const QString&)> named_;
};

}  // namespace emca::explorer
