#include "window/file_menu.h"

#include <QAction>
#include <QDir>
#include <QFileDialog>
#include <QFileInfo>
#include <QGuiApplication>
#include <QMainWindow>
#include <QMenu>
#include <QSettings>
#include <QTimer>

#include "base/qt_compat.h"
#include "session/session_controller.h"
#include "window/notice_card.h"
#include "window/toast.h"

namespace emca::explorer {
namespace {

constexpr int kRecentWidth = 420;   // pixels of a file's folder in the menu

bool isSession(const QString& file) {
    return QFileInfo(file).suffix().compare("emca", Qt::CaseInsensitive) == 0 || client::isSession(file.toStdString());
}

}  // namespace

FileMenu::FileMenu(QMainWindow& window, client::Dataset& dataset, SessionController& session, Theme& theme, Toast& toast,
                   QSettings& settings)
    : QObject(&window), window_(window), dataset_(dataset), session_(session), toast_(toast), settings_(settings),
      card_(new NoticeCard(theme, &window)), document_(dataset, session, this) {
    document_.setRecent(settings.value("files/recent").toStringList());
    connect(&document_, &SessionDocument::changed, this, &FileMenu::refresh);
    connect(&session, &SessionController::sessionOpened, this, &FileMenu::opened);
    connect(&session, &SessionController::sessionSaveEnded, this, [this](const QString& file, bool saved) {
        if (session_.isSavingSession()) return;   // again already: that one is waited for
        const auto done = std::exchange(afterSave_, nullptr);
        if (!saved) return;
        toast_.showRemark(tr("Saved %1").arg(QFileInfo(file).fileName()));
        if (done) done();
    });
    connect(&session, &SessionController::imageSaved, this, [this](const QString& file) { toast_.showRemark(tr("Saved %1").arg(file)); });
    refresh();
}

std::vector<QAction*> FileMenu::addTo(QMenu& menu) {
    std::vector<QAction*> made;
    const auto add = [&](const char* name, const QString& text, const QKeySequence& keys, auto run) {
        QAction* action = menu.addAction(text);
        action->setObjectName(name);
        action->setShortcut(keys);
        action->setShortcutContext(Qt::WindowShortcut);
        connect(action, &QAction::triggered, this, run);
        made.push_back(action);
        return action;
    };
    add("open", tr("Open…"), QKeySequence::Open, [this] { openDialog(); })->setToolTip(tr("Open a session or an image (Ctrl+O)"));
    recent_ = menu.addMenu(tr("Open recent"));
    recent_->setObjectName("recentFiles");
    recent_->setToolTipsVisible(true);
    menu.addSeparator();
    saveSession_ = add("saveSession", tr("Save session"), QKeySequence::Save, [this] { save(); });
    saveSession_->setToolTip(tr("Save images, scene, traced pixels and selection as one file (Ctrl+S)"));
    saveSessionAs_ = add("saveSessionAs", tr("Save session as…"), QKeySequence("Ctrl+Shift+S"), [this] { saveAs(); });
    saveImage_ = add("saveImage", tr("Save image…"), QKeySequence("Ctrl+E"), [this] { saveImageDialog(); });
    refresh();
    return made;
}

void FileMenu::updateActions() {
    if (!saveSession_) return;
    const bool something = dataset_.info() || !dataset_.images().empty() || !dataset_.traces().empty() || document_.hasUnsavedNotes();
    saveSession_->setEnabled(something);
    saveSessionAs_->setEnabled(something);
    saveImage_->setEnabled(dataset_.currentImage() != nullptr);
}

void FileMenu::refresh() {
    const QString& file = document_.file();
    QString title = tr("EMCA[*]");
    if (!file.isEmpty()) {
        QString name = QFileInfo(file).fileName();
        name.replace("[*]", "[*][*]");   // Qt's own mark in a title
        title = document_.isComplete() ? tr("%1[*] — EMCA").arg(name) : tr("%1[*], opened in part — EMCA").arg(name);
    }
    if (window_.windowTitle() != title) window_.setWindowTitle(title);
    window_.setWindowModified(document_.isModified());
    if (recent_) fillRecent();
    settings_.setValue("files/recent", document_.recent());
}

void FileMenu::fillRecent() {
    recent_->clear();
    recent_->setEnabled(!document_.recent().isEmpty());
    int number = 0;
    for (const QString& file : document_.recent()) {
        const QFileInfo info(file);
        const QString folder = recent_->fontMetrics().elidedText(QDir::toNativeSeparators(info.path()), Qt::ElideMiddle, kRecentWidth);
        QString name = info.fileName() + QStringLiteral("   —   ") + folder;
        name.replace('&', "&&");
        ++number;
        QAction* entry = recent_->addAction(number < 10 ? QStringLiteral("&%1   %2").arg(number).arg(name) : QStringLiteral("     ") + name);
        entry->setToolTip(QDir::toNativeSeparators(file));
        entry->setData(file);
        connect(entry, &QAction::triggered, this, [this, file] { open({file}); });
    }
    recent_->addSeparator();
    connect(recent_->addAction(tr("Clear the list")), &QAction::triggered, this, [this] { document_.setRecent({}); });
}

// Opening ----------------------------------------------------------------------------------------

void FileMenu::open(const QStringList& files) {
    QStringList images;
    QString session;
    for (const QString& file : files) {
        if (!isSession(file)) images << file;
        else if (session.isEmpty()) session = file;
    }
    if (session.isEmpty()) return openImages(images);
    withoutLoss(tr("Save before opening %1?").arg(QFileInfo(session).fileName()), tr("Open without saving"), [this, session, images] {
        imagesAfterSession_ = images;
        openSession(session);
    });
}

void FileMenu::openImages(const QStringList& images) {
    for (const QString& image : images) {
        opening_ = image;
        session_.openImage(image);
    }
}

void FileMenu::openSession(const QString& file) {
    opening_ = file;
    toast_.clear();
    card_->clear();
    session_.openSession(file);
}

void FileMenu::opened(const QString& file, bool complete, const QStringList& notices) {
    const QString name = QFileInfo(file).fileName();
    const QString notes = toQString(session_.notes());
    if (!complete) {
        QStringList lines = notices;
        lines << tr("What could be read is here; the file stays as it is, and saving asks for another name.");
        card_->present(NoticeCard::Tone::warning, tr("%1 is not whole").arg(name), lines,
                       {{tr("Save what was read as…"), [this] { saveAs(); }, false}});
    } else if (!notes.isEmpty()) {
        card_->present(NoticeCard::Tone::remark, tr("Notes in %1").arg(name), notes.split('\n'));
    }
    openImages(std::exchange(imagesAfterSession_, {}));
}

void FileMenu::chooseFile(QFileDialog* dialog, std::function<void(const QString&)> chosen) {
    dialog->setAttribute(Qt::WA_DeleteOnClose);
    connect(dialog, &QFileDialog::fileSelected, this, [this, chosen = std::move(chosen)](const QString& file) {
        settings_.setValue("folder", QFileInfo(file).absolutePath());
        chosen(file);
    });
    dialog->open();   // the window goes on drawing
}

void FileMenu::openDialog() {
    auto* dialog = new QFileDialog(&window_, tr("Open"), settings_.value("folder").toString(),
                                   tr("Sessions and images (*.emca *.exr *.pfm *.hdr *.png *.tif *.tiff *.jpg *.jpeg);;Sessions (*.emca);;All files (*)"));
    dialog->setFileMode(QFileDialog::ExistingFile);
    chooseFile(dialog, [this](const QString& file) { open({file}); });
}

// Saving -----------------------------------------------------------------------------------------

QString FileMenu::suggestion() const {
    const QFileInfo file(document_.file());
    if (!document_.file().isEmpty()) return document_.isComplete() ? file.filePath() : file.path() + '/' + file.completeBaseName() + tr(" (rescued)") + ".emca";
    QString name = dataset_.info() ? QFileInfo(toQString(dataset_.info()->scene)).completeBaseName() : QString();
    if (name.isEmpty()) name = tr("session");
    return QDir(settings_.value("folder").toString()).filePath(name + ".emca");
}

void FileMenu::save(std::function<void()> done) {
    if (document_.target().isEmpty()) saveAs(std::move(done));
    else saveTo(document_.target(), std::move(done));
}

void FileMenu::saveAs(std::function<void()> done) {
    auto* dialog = new QFileDialog(&window_, tr("Save session"), settings_.value("folder").toString(), tr("Sessions (*.emca)"));
    dialog->setAcceptMode(QFileDialog::AcceptSave);
    dialog->setDefaultSuffix("emca");
    const QFileInfo suggested(suggestion());
    dialog->setDirectory(suggested.path());
    dialog->selectFile(suggested.fileName());
    chooseFile(dialog, [this, done = std::move(done)](const QString& file) { saveTo(file, done); });
}

void FileMenu::saveTo(const QString& file, std::function<void()> done) {
    saving_ = file;
    toast_.clear();
    afterSave_ = std::move(done);
    document_.save(file);
}

void FileMenu::saveImageDialog() {
    auto* dialog = new QFileDialog(&window_, tr("Save image"), settings_.value("folder").toString(),
                                   tr("OpenEXR (*.exr);;PFM (*.pfm);;Radiance HDR (*.hdr);;PNG (*.png)"));
    dialog->setAcceptMode(QFileDialog::AcceptSave);
    chooseFile(dialog, [this](const QString& file) { session_.saveImage(QFileInfo(file).suffix().isEmpty() ? file + ".exr" : file); });
}

// Unsaved work -----------------------------------------------------------------------------------

void FileMenu::withoutLoss(const QString& question, const QString& discard, std::function<void()> action) {
    if (!document_.isModified()) return action();
    const QString work = document_.unsavedWork();
    const QString sentence = document_.file().isEmpty() ? tr("%1 are in no file yet.") : tr("%1 are not in the file yet.");
    const QString single = document_.file().isEmpty() ? tr("%1 is in no file yet.") : tr("%1 is not in the file yet.");
    card_->present(NoticeCard::Tone::question, question, {(document_.isOneWork() ? single : sentence).arg(work)},
                   {{tr("Cancel"), {}, false},
                    {discard, action, false},
                    {document_.target().isEmpty() ? tr("Save as…") : tr("Save"), [this, action] { save(action); }, true}});
}

bool FileMenu::mayClose() {
    // A desktop that ends its session asks no questions of ours.
    if (mayLose_ || !document_.isModified() || qApp->isSavingSession()) return true;
    withoutLoss(tr("Save before closing?"), tr("Close without saving"), [this] {
        mayLose_ = true;
        // Not from inside the button or the save that this is called by.
        QTimer::singleShot(0, &window_, &QWidget::close);
    });
    return false;
}

bool FileMenu::showFailure(FailedTask task, const QString& sentence) {
    switch (task) {
        case FailedTask::openImage:
        case FailedTask::openSession:
            if (!QFileInfo::exists(opening_)) document_.forget(opening_);
            toast_.showError(sentence, tr("Open another…"), [this] { openDialog(); });
            if (task == FailedTask::openSession) openImages(std::exchange(imagesAfterSession_, {}));
            return true;
        case FailedTask::saveSession:
            toast_.showError(sentence, tr("Save elsewhere…"), [this, done = afterSave_] { saveAs(done); });
            return true;
        case FailedTask::saveImage: toast_.showError(sentence, tr("Save elsewhere…"), [this] { saveImageDialog(); }); return true;
        default: return false;
    }
}

}  // namespace emca::explorer
