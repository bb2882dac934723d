#include "session/session_document.h"

#include <QFileInfo>
#include <algorithm>

#include "session/session_controller.h"

namespace emca::explorer {
namespace {

/// Opened images have no samples.
bool isRender(const client::ImageEntry& entry) { return entry.image && !entry.preview && entry.samplesPerPixel != 0; }

QString absolute(const QString& file) { return QFileInfo(file).absoluteFilePath(); }

}  // namespace

SessionDocument::SessionDocument(client::Dataset& dataset, SessionController& session, QObject* parent)
    : QObject(parent), dataset_(dataset), session_(session),
      datasetListening_(dataset, [this](std::uint32_t parts) { dataChanged(parts); }) {
    connect(&session, &SessionController::sessionOpened, this, [this](const QString& file, bool complete) {
        file_ = absolute(file);
        complete_ = complete;
        saved_.clear();
        for (const auto& work : works()) saved_.push_back(work);
        savedNotes_ = notesOf(session_);
        remember(file);
    });
    connect(&session, &SessionController::sessionSaveEnded, this, &SessionDocument::saveEnded);
    connect(&session, &SessionController::notesChanged, this, &SessionDocument::changed);
    connect(&session, &SessionController::imageOpened, this, &SessionDocument::remember);
}

void SessionDocument::dataChanged(std::uint32_t parts) {
    // Another scene is here and the traces of the file are gone: saving must not write over them.
    if ((parts & client::DatasetPart::traces) && dataset_.traces().empty()) {
        file_.clear();
        complete_ = true;
    }
    if (parts & (client::DatasetPart::traces | client::DatasetPart::images)) emit changed();
}

std::vector<std::shared_ptr<const void>> SessionDocument::works() const {
    std::vector<std::shared_ptr<const void>> all(dataset_.traces().begin(), dataset_.traces().end());
    for (const client::ImageEntry& entry : dataset_.images())
        if (isRender(entry)) all.push_back(entry.image);
    return all;
}

SessionDocument::Notes SessionDocument::notesOf(const SessionController& session) { return {session.notes(), session.pixelNotes()}; }

bool SessionDocument::isSaved(const void* work) const {
    return std::ranges::any_of(saved_, [&](const auto& held) { return held.lock().get() == work; });
}

std::size_t SessionDocument::unsavedPixels() const {
    return static_cast<std::size_t>(std::ranges::count_if(dataset_.traces(), [&](const auto& t) { return !isSaved(t.get()); }));
}

std::size_t SessionDocument::unsavedRenders() const {
    const auto automatic = session_.automaticImage();
    return static_cast<std::size_t>(std::ranges::count_if(dataset_.images(), [&](const client::ImageEntry& entry) {
        return isRender(entry) && entry.image != automatic && !isSaved(entry.image.get());
    }));
}

QString SessionDocument::unsavedWork() const {
    const auto pixels = static_cast<int>(unsavedPixels()), renders = static_cast<int>(unsavedRenders());
    QStringList parts;
    if (pixels) parts << (pixels == 1 ? tr("1 traced pixel") : tr("%1 traced pixels").arg(pixels));
    if (renders) parts << (renders == 1 ? tr("1 render") : tr("%1 renders").arg(renders));
    if (hasUnsavedNotes()) parts << tr("notes");
    const QString last = parts.isEmpty() ? QString() : parts.takeLast();
    return parts.isEmpty() ? last : parts.join(QStringLiteral(", ")) + tr(" and ") + last;
}

void SessionDocument::setRecent(const QStringList& files) {
    recent_ = files.mid(0, kRecent);
    emit changed();
}

void SessionDocument::remember(const QString& file) {
    QStringList files = recent_;
    files.removeAll(absolute(file));
    files.prepend(absolute(file));
    setRecent(files);
}

void SessionDocument::forget(const QString& file) {
    QStringList files = recent_;
    if (files.removeAll(absolute(file))) setRecent(files);
}

void SessionDocument::save(const QString& file) {
    if (session_.isSavingSession()) {
        next_ = file;
        return;
    }
    saving_.clear();
    for (const auto& work : works()) saving_.push_back(work);
    savingNotes_ = notesOf(session_);
    session_.saveSession(file);
}

void SessionDocument::saveEnded(const QString& file, bool saved) {
    if (saved) {
        file_ = absolute(file);
        complete_ = true;
        saved_ = std::move(saving_);
        savedNotes_ = savingNotes_;
        remember(file);
    }
    saving_.clear();
    if (const auto next = std::exchange(next_, std::nullopt)) save(*next);
}

}  // namespace emca::explorer
