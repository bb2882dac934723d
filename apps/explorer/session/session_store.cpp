// Sessions of SessionController: opened and saved in other threads, shown in this one.
#include <QScopedValueRollback>
#include <algorithm>

#include "base/qt_compat.h"
#include "session/session_controller.h"

namespace emca::explorer {
namespace {

QStringList sentences(const std::vector<std::string>& notices) {
    QStringList list;
    for (const std::string& notice : notices) list << toQString(notice);
    return list;
}

/// Nothing renders on: what has arrived of a preview is an image like others.
void endPreviews(std::vector<client::ImageEntry>& images) {
    constexpr std::string_view kRendering = ", rendering";
    for (client::ImageEntry& entry : images) {
        if (!entry.preview) continue;
        entry.preview = false;
        if (entry.title.ends_with(kRendering)) entry.title.resize(entry.title.size() - kRendering.size());
        entry.title += ", incomplete";
    }
}

bool byRow(Pixel a, Pixel b) { return a.y != b.y ? a.y < b.y : a.x < b.x; }

}  // namespace

void SessionController::setNotes(std::string notes) {
    if (notes == notes_) return;
    notes_ = std::move(notes);
    emit notesChanged();
}

const std::string& SessionController::pixelNote(Pixel pixel) const {
    static const std::string none;
    const auto found = std::ranges::find(pixelNotes_, pixel, &client::PixelNote::pixel);
    return found == pixelNotes_.end() ? none : found->text;
}

void SessionController::setPixelNote(Pixel pixel, std::string text) {
    if (text == pixelNote(pixel)) return;
    const auto found = std::ranges::find(pixelNotes_, pixel, &client::PixelNote::pixel);
    if (text.empty()) pixelNotes_.erase(found);
    else if (found != pixelNotes_.end()) found->text = std::move(text);
    else pixelNotes_.insert(std::ranges::lower_bound(pixelNotes_, pixel, byRow, &client::PixelNote::pixel), {pixel, std::move(text)});
    emit notesChanged();
}

void SessionController::openSession(const QString& file) {
    if (opening_) *opening_->cancel = true;
    auto activity = std::make_shared<Activity>();
    opening_ = activity;
    begin();
    workers_.run([path = std::filesystem::path(file.toStdString()),
                  activity] { return client::openSession(path, {}, Activity::observer(activity)); },
                 [this, activity, file](Result<client::OpenedSession> result) {
                     if (activity != opening_) return;
                     opening_.reset();
                     if (result) {
                         showSession(std::move(result->session));
                         emit sessionOpened(file, result->whole && result->notices.empty(), sentences(result->notices));
                     } else if (result.error().code != ErrorCode::cancelled) {
                         fail(FailedTask::openSession, result.error());
                     }
                     emit activityChanged();
                 });
}

void SessionController::showSession(client::Session session) {
    const bool stays = connection_ && dataset_.info() && session.info && sameScene(*dataset_.info(), *session.info);
    if (stays) {
        // What is under way belongs to what goes.
        cancelRender();
        cancelTrace();
        for (auto* activity : {&scene_, &layers_}) {
            if (*activity) *(*activity)->cancel = true;
            activity->reset();
        }
        session.info = dataset_.info();
    } else {
        disconnectFromRenderer();
    }
    endPreviews(session.images);
    known_.clear();
    for (const auto& trace : session.traces) {
        // Of the matches of a query the file does not know which one it was.
        if (trace->pixels.empty() || trace->renderId == 0 || trace->matches) continue;
        for (const client::ImageEntry& entry : session.images)
            if (entry.renderId == trace->renderId) known_.push_back({client::PixelRegion(trace->pixels), entry.image.get(), {}, trace});
    }
    // The server may have begun to count anew since the session was saved.
    if (stays)
        for (client::ImageEntry& entry : session.images) entry.renderId = 0;
    notes_ = std::move(session.notes);
    pixelNotes_ = std::move(session.pixelNotes);
    std::erase_if(pixelNotes_, [](const client::PixelNote& note) { return note.text.empty(); });
    std::ranges::stable_sort(pixelNotes_, byRow, &client::PixelNote::pixel);
    filter_ = std::move(session.filter);
    view_ = std::move(session.view);
    renderCount_ = std::max(renderCount_, static_cast<int>(session.images.size()));
    lastRequest_.clear();
    {
        const QScopedValueRollback<bool> quiet(showing_, true);
        client::show(session, dataset_, selection_);
    }
    emit notesChanged();
    if (!stays) return;
    if (!session.meshes) loadScene();
    if (session.shown.empty()) ensureTraced(true);
}

void SessionController::saveSession(const QString& file) {
    if (saving_) return;
    client::Session session = client::sessionOf(dataset_, selection_);
    session.notes = notes_;
    session.pixelNotes = pixelNotes_;
    session.filter = filter_;
    if (viewSource_) session.view = viewSource_();
    // Layers without the scene they lie on cannot be kept: it is still on its way, as they were.
    if (!session.meshes) session.surface = nullptr;
    auto activity = std::make_shared<Activity>();
    saving_ = activity;
    begin();
    workers_.run(
        [path = std::filesystem::path(file.toStdString()), session = std::move(session), activity] {
            return client::saveSession(path, session, Activity::observer(activity));
        },
        [this, file](Result<void> result) {
            saving_.reset();
            if (!result && result.error().code != ErrorCode::cancelled) fail(FailedTask::saveSession, result.error());
            emit sessionSaveEnded(file, result.ok());
            emit activityChanged();
        });
}

void SessionController::cancelSession() {
    if (saving_) *saving_->cancel = true;
    if (!opening_) return;
    *opening_->cancel = true;
    opening_.reset();
    emit activityChanged();
}

}  // namespace emca::explorer
