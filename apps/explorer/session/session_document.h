#pragma once

#include <QObject>
#include <QStringList>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/listeners.h"
#include "emca/client/session.h"

namespace emca::explorer {

class SessionController;

/// What is in the window as a file: its name, what of it is not saved yet, and the files of before. GUI thread.
///
/// Unsaved work is what somebody waited for or wrote: traced pixels, finished renders, notes. The image that connecting renders by
/// itself is none, images from disk are there anyway, and a selection is quickly made again.
class SessionDocument : public QObject {
    Q_OBJECT
  public:
    static constexpr int kRecent = 10;

    SessionDocument(client::Dataset& dataset, SessionController& session, QObject* parent = nullptr);

    /// Absolute; empty as long as it has none.
    const QString& file() const { return file_; }
    /// Where saving writes without asking for a name. Empty if there is no file, or if only a part of it could be read:
    /// what could not be read would be lost.
    QString target() const { return complete_ ? file_ : QString(); }
    bool isComplete() const { return complete_; }
    bool isModified() const { return unsavedPixels() + unsavedRenders() > 0 || hasUnsavedNotes(); }
    std::size_t unsavedPixels() const;
    std::size_t unsavedRenders() const;
    bool hasUnsavedNotes() const { return notesOf(session_) != savedNotes_; }
    /// "3 traced pixels, 1 render and notes"; empty if all is saved.
    QString unsavedWork() const;
    /// It is one thing, not several.
    bool isOneWork() const { return unsavedPixels() + unsavedRenders() == 1 && !hasUnsavedNotes(); }

    /// Sessions and images, newest first, absolute.
    const QStringList& recent() const { return recent_; }
    void setRecent(const QStringList& files);
    void remember(const QString& file);
    void forget(const QString& file);

    /// Saves what is here now, after a save that runs.
    void save(const QString& file);

  signals:
    /// Name, unsaved work or the recent files.
    void changed();

  private:
    using Notes = std::pair<std::string, std::vector<client::PixelNote>>;
    static Notes notesOf(const SessionController& session);
    void saveEnded(const QString& file, bool saved);
    void dataChanged(std::uint32_t parts);
    std::vector<std::shared_ptr<const void>> works() const;
    bool isSaved(const void* work) const;

    client::Dataset& dataset_;
    SessionController& session_;
    QString file_;
    bool complete_ = true;
    QStringList recent_;
    /// Kept weakly: a saved image may go. An address that is used again would look saved, so addresses alone do not do.
    std::vector<std::weak_ptr<const void>> saved_, saving_;
    Notes savedNotes_, savingNotes_;
    std::optional<QString> next_;   ///< to be saved after the one that runs
    DatasetListening datasetListening_;
};

}  // namespace emca::explorer
