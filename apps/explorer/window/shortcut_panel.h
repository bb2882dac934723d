#pragma once

#include <QFrame>
#include <QPointer>
#include <vector>

class QAction;
class QLabel;
class QLineEdit;
class QMainWindow;
class QTreeWidget;
class QTreeWidgetItem;

namespace emca::explorer {

class Theme;

/// Everything that can be done, with its key: read from the menus and from what views say about themselves each time it
/// is shown, so that it cannot lie. Words find, Enter does it. A card above the views, which go on.
class ShortcutPanel : public QFrame {
    Q_OBJECT
  public:
    struct Entry {
        QString group;             ///< menu or view
        QString text, keys;        ///< what it does; as people write keys, empty for none
        QPointer<QAction> action;  ///< null: a key of a view, which only works there
    };
    /// Menus in their order, then views.
    static std::vector<Entry> entriesOf(const QMainWindow& window);

    ShortcutPanel(Theme& theme, QMainWindow* window);
    /// Shows it with the focus in its field, or hides it.
    void toggle();
    void clear();

    QLineEdit& field() { return *field_; }
    QTreeWidget& list() { return *list_; }

  protected:
    bool event(QEvent* event) override;
    bool eventFilter(QObject* watched, QEvent* event) override;
    void paintEvent(QPaintEvent* event) override;

  private:
    void fill();
    void find();
    void run(QTreeWidgetItem* item);
    void step(int by);
    void place();

    Theme& theme_;
    QMainWindow& window_;
    QLineEdit* field_;
    QTreeWidget* list_;
    QLabel* none_;
    std::vector<Entry> entries_;
    QPointer<QWidget> before_;     ///< had the focus
};

}  // namespace emca::explorer
