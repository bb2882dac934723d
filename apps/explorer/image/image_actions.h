#pragma once

#include <QObject>
#include <functional>

class QAction;
class QKeySequence;
class QString;
class QWidget;

namespace emca::explorer {

class ImageModel;

/// Everything that a key does in the image view, as actions of the view with names, texts and shortcuts, so that menus
/// and the list of shortcuts show them. Those of the window's context work wherever the focus is; the others while it is
/// in the view.
class ImageActions : public QObject {
    Q_OBJECT
  public:
    /// \param view  gets the actions
    ImageActions(ImageModel& model, QWidget& view);

    void changeExposure(double byStops);
    /// Makes this the exposure, in stops; kept within ±12.
    void setExposure(double stops);
    void toggleFalseColor();
    void toggleLog();
    void stepMetric(int by);
    void stepChannel(int by);
    void stepTransfer();
    void toggleMode(int mode);   ///< of ImageMode: shows it, or the image if it is shown

  signals:
    void nextInvalidWanted();
    void openReferenceWanted();
    void saveShownWanted();
    void stepImageWanted(int by);

  private:
    QAction* add(const char* name, const QString& text, const QKeySequence& keys, bool everywhere, std::function<void()> run);
    void refresh();
    ImageModel& model_;
    QWidget& view_;
};

}  // namespace emca::explorer
