#pragma once

#include <QImage>
#include <QObject>
#include <QString>
#include <QThreadPool>
#include <memory>

#include "emca/core/image.h"

class QWidget;

namespace emca::explorer {

/// Files of the image view: the question for a reference, and saving what is shown. Nothing blocks the window.
class ImageFiles : public QObject {
    Q_OBJECT
  public:
    /// \param window  parent of the dialogs
    explicit ImageFiles(QWidget* window);
    ~ImageFiles() override;

    void askForReference();
    /// \param name  suggested, without extension; \param picture  as the screen has it; \param values  behind it
    void askWhereToSave(const QString& name, QImage picture, std::shared_ptr<const Image> values);
    /// PNG: the picture. Other extensions: the values. \param file  gets ".png" if it has no extension
    void save(const QString& file, QImage picture, std::shared_ptr<const Image> values);
    bool isSaving() const { return saving_ > 0; }

  signals:
    void referenceChosen(const QString& file);
    void saved(const QString& file);
    void failed(const QString& sentence);

  private:
    QWidget* window_;
    QString folder_;
    int saving_ = 0;
    QThreadPool pool_;
};

}  // namespace emca::explorer
