#pragma once

#include <QByteArray>
#include <QObject>
#include <QStringList>
#include <QVariantMap>
#include <functional>
#include <vector>

class QAction;
class QActionGroup;
class QMainWindow;
class QMenu;
class QSettings;

namespace emca::explorer {

class NamePanel;
class PanelDock;

/// Layouts of the window: those that come with the program (layoutPlans), a person's own, and the one that it was left
/// with. A layout is where docks are, how large, which tabs are in front, what is hidden, and the options of views that
/// `options` reads and writes. Docks that a saved layout does not know join the tools; docks that are no longer there (a
/// plugin's) keep their place until they come back.
class Layouts : public QObject {
    Q_OBJECT
  public:
    static constexpr int kOwn = 5;   ///< so many of a person's own have keys, after those of the program

    struct Options {
        std::function<QVariantMap()> read;
        std::function<void(const QVariantMap&)> write;
    };

    /// All outlive this object. \param docks  those that there are, whenever it is called
    Layouts(QMainWindow& window, QSettings& settings, std::function<std::vector<PanelDock*>()> docks, Options options, QObject* parent = nullptr);

    /// Actions have the names "layout-" and a plan's; own ones are made anew when they change.
    void addTo(QMenu& menu);

    /// By name of a plan, or of an own one. False: there is none of that name, and nothing changed.
    bool apply(const QString& name);
    void saveAs(const QString& name);
    void remove(const QString& name);
    QStringList own() const;   ///< sorted
    /// Asks for a name.
    void askAndSave();

    /// How it is now; how it was left last time. False: it was never left.
    void keep();
    bool restore();

  signals:
    /// Docks may have new neighbours.
    void arranged();

  private:
    QString key(const QString& name) const;
    void write(const QString& group);
    bool read(const QString& group);
    void fill();

    QMainWindow& window_;
    QSettings& settings_;
    std::function<std::vector<PanelDock*>()> docks_;
    Options options_;
    NamePanel* name_;
    QMenu* menu_ = nullptr;
    QMenu* removal_ = nullptr;
    QAction* end_ = nullptr;           ///< own layouts stand before it
    std::vector<QAction*> ownActions_;
};

}  // namespace emca::explorer
