#pragma once

#include <QWidget>

#include "base/listeners.h"

class QLabel;
class QListWidget;
class QPlainTextEdit;

namespace emca::explorer {

class SessionController;
class Theme;

/// What a person writes: about the session, and about the pixel that is selected. Kept with the session; the list has
/// the pixels with notes, and a click selects one of them.
class NotesPanel : public QWidget {
    Q_OBJECT
  public:
    NotesPanel(client::Selection& selection, SessionController& session, Theme& theme, QWidget* parent = nullptr);

    QPlainTextEdit& sessionNotes() { return *sessionNotes_; }
    QPlainTextEdit& pixelNotes() { return *pixelNotes_; }
    QListWidget& list() { return *list_; }

  private:
    void showNotes();
    void showPixel();
    void fill();

    client::Selection& selection_;
    SessionController& session_;
    QPlainTextEdit* sessionNotes_;
    QLabel* pixelTitle_;
    QPlainTextEdit* pixelNotes_;
    QLabel* listTitle_;
    QListWidget* list_;
    bool writing_ = false;   ///< what is typed here comes back
    SelectionListening selectionListening_;
};

}  // namespace emca::explorer
