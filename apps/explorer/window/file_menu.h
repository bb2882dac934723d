#pragma once

#include <QObject>
#include <QStringList>
#include <functional>
#include <vector>

#include "session/session_document.h"

class QAction;
class QFileDialog;
class QMainWindow;
class QMenu;
class QSettings;

namespace emca::explorer {

class NoticeCard;
class SessionController;
class Theme;
class Toast;
enum class FailedTask;

/// Files in the window: the File menu with its keys, files that are dropped, the title, and the question before unsaved
/// work goes. What a file is does not depend on how it came: from the menu, the command line, or dropped.
class FileMenu : public QObject {
    Q_OBJECT
  public:
    /// All outlive this object.
    FileMenu(QMainWindow& window, client::Dataset& dataset, SessionController& session, Theme& theme, Toast& toast, QSettings& settings);

    /// Fills a menu. Actions have the names open, saveSession, saveSessionAs, saveImage.
    std::vector<QAction*> addTo(QMenu& menu);
    void updateActions();
    /// Sessions by what they contain or are named, everything else as images. Of several sessions the first one.
    void open(const QStringList& files);
    void openDialog();
    void saveImageDialog();
    /// \param done  after a save that succeeded
    void save(std::function<void()> done = {});
    void saveAs(std::function<void()> done = {});
    /// Calls it at once if nothing is unsaved, else after the question, or never.
    void withoutLoss(const QString& question, const QString& discard, std::function<void()> action);
    /// False: the question is asked, and the window closes later if the answer is yes.
    bool mayClose();
    /// Says what failed and offers the way on. False: that is none of a file.
    bool showFailure(FailedTask task, const QString& sentence);

    NoticeCard& card() { return *card_; }
    SessionDocument& document() { return document_; }

  private:
    void chooseFile(QFileDialog* dialog, std::function<void(const QString&)> chosen);
    void openSession(const QString& file);
    void openImages(const QStringList& images);
    void opened(const QString& file, bool complete, const QStringList& notices);
    void saveTo(const QString& file, std::function<void()> done);
    void fillRecent();
    void refresh();
    QString suggestion() const;

    QMainWindow& window_;
    client::Dataset& dataset_;
    SessionController& session_;
    Toast& toast_;
    QSettings& settings_;
    NoticeCard* card_;
    SessionDocument document_;
    QMenu* recent_ = nullptr;
    QAction* saveSession_ = nullptr;
    QAction* saveSessionAs_ = nullptr;
    QAction* saveImage_ = nullptr;
    QString opening_, saving_;               ///< what a failure is about
    QStringList imagesAfterSession_;         ///< came with a session, which takes the place of all images when it is open
    std::function<void()> afterSave_;
    bool mayLose_ = false;                   ///< asked and answered: the window closes
};

}  // namespace emca::explorer
