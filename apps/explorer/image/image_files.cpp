#include "image/image_files.h"

#include <QDir>
#include <QFileDialog>
#include <QFileInfo>
#include <QRunnable>
#include <QSaveFile>
#include <QWidget>
#include <filesystem>

#include "base/qt_compat.h"
#include "emca/imageio/imageio.h"

namespace emca::explorer {
namespace {

/// Empty: written.
QString writePicture(const QString& file, const QImage& picture) {
    // Beside its place and renamed: a crash leaves the old file whole.
    QSaveFile out(file);
    if (out.open(QIODevice::WriteOnly) && picture.save(&out, "PNG") && out.commit()) return {};
    return ImageFiles::tr("%1 was not saved: %2.").arg(file, out.errorString());
}

QString writeValues(const QString& file, const Image& values) {
    const auto written = imageio::write(std::filesystem::path(file.toStdString()), values);
    return written ? QString() : toQString(written.error().message);
}

}  // namespace

ImageFiles::ImageFiles(QWidget* window) : QObject(window), window_(window) { pool_.setMaxThreadCount(2); }

ImageFiles::~ImageFiles() { pool_.waitForDone(); }

void ImageFiles::askForReference() {
    auto* dialog = new QFileDialog(window_, tr("Open a reference"), folder_,
                                   tr("Images (*.exr *.pfm *.hdr *.png *.tif *.tiff *.jpg *.jpeg);;All files (*)"));
    dialog->setFileMode(QFileDialog::ExistingFile);
    dialog->setAttribute(Qt::WA_DeleteOnClose);
    connect(dialog, &QFileDialog::fileSelected, this, [this](const QString& file) {
        folder_ = QFileInfo(file).absolutePath();
        emit referenceChosen(file);
    });
    dialog->open();   // the window goes on drawing
}

void ImageFiles::askWhereToSave(const QString& name, QImage picture, std::shared_ptr<const Image> values) {
    auto* dialog = new QFileDialog(window_, tr("Save what is shown"), folder_,
                                   tr("Picture as it is shown (*.png);;Values, OpenEXR (*.exr);;Values, PFM (*.pfm);;Values, Radiance HDR (*.hdr)"));
    dialog->setAcceptMode(QFileDialog::AcceptSave);
    dialog->setAttribute(Qt::WA_DeleteOnClose);
    dialog->setDefaultSuffix("png");
    dialog->selectFile(name + ".png");
    connect(dialog, &QFileDialog::filterSelected, dialog, [dialog](const QString& filter) {
        dialog->setDefaultSuffix(filter.section("*.", 1).section(')', 0, 0));
    });
    connect(dialog, &QFileDialog::fileSelected, this, [this, picture, values](const QString& file) {
        folder_ = QFileInfo(file).absolutePath();
        save(file, picture, values);
    });
    dialog->open();
}

void ImageFiles::save(const QString& chosen, QImage picture, std::shared_ptr<const Image> values) {
    const QString suffix = QFileInfo(chosen).suffix().toLower(), file = suffix.isEmpty() ? chosen + ".png" : chosen;
    const bool asShown = suffix.isEmpty() || suffix == "png";
    ++saving_;
    pool_.start(QRunnable::create([this, file, asShown, picture, values] {
        const QString sentence = asShown ? writePicture(file, picture) : writeValues(file, *values);
        QMetaObject::invokeMethod(this, [this, file, sentence] {
            --saving_;
            if (sentence.isEmpty()) emit saved(file);
            else emit failed(sentence);
        }, Qt::QueuedConnection);
    }));
}

}  // namespace emca::explorer
