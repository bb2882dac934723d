#include <QFileDialog>
#include <QFormLayout>
#include <QHBoxLayout>
#include <QLabel>
#include <QPushButton>
#include <QSpinBox>

#include "base/qt_compat.h"
#include "scene_panels.h"

namespace emca::explorer {

PicturePanel::PicturePanel(SceneView& view, Theme& theme, QWidget* parent) : QWidget(parent), view_(view), theme_(theme) {
    auto* form = new QFormLayout(this);
    form->setContentsMargins(0, 0, 0, 0);
    form->setHorizontalSpacing(Spacing::medium);
    form->setVerticalSpacing(Spacing::tiny);
    form->setFieldGrowthPolicy(QFormLayout::AllNonFixedFieldsGrow);
    width_ = new QSpinBox;
    height_ = new QSpinBox;
    width_->setObjectName("pictureWidth");
    height_->setObjectName("pictureHeight");
    for (QSpinBox* spin : {width_, height_}) {
        spin->setRange(16, 8192);
        spin->setSuffix(" px");
        spin->setToolTip(spin == width_ ? "Width of the picture in pixels" : "Height of the picture in pixels");
    }
    width_->setValue(1920);
    height_->setValue(1080);
    auto* sizes = new QHBoxLayout;
    sizes->setSpacing(Spacing::small);
    sizes->addWidget(width_, 1);
    sizes->addWidget(new QLabel("×"));
    sizes->addWidget(height_, 1);
    auto* asShown = new QPushButton("As shown");
    asShown->setObjectName("pictureAsShown");
    asShown->setToolTip("The size of the view");
    sizes->addWidget(asShown);
    form->addRow("Size", sizes);
    auto* saveButton = new QPushButton("Save PNG…");
    saveButton->setObjectName("savePicture");
    saveButton->setToolTip("The picture with labels, legend and colour bars (P)");
    form->addRow(saveButton);
    answer_ = new QLabel;
    answer_->setObjectName("pictureAnswer");
    answer_->setWordWrap(true);
    answer_->hide();
    form->addRow(answer_);
    connect(asShown, &QPushButton::clicked, this, [this] {
        width_->setValue(view_.width());
        height_->setValue(view_.height());
    });
    connect(saveButton, &QPushButton::clicked, this, [this] { ask(); });
    connect(&view_, &SceneView::pictureRequested, this, [this] { ask(); });
}

void PicturePanel::ask() {
    auto* dialog = new QFileDialog(view_.window(), "Save the 3D view", last_, "PNG (*.png)");
    dialog->setObjectName("pictureDialog");
    dialog->setAttribute(Qt::WA_DeleteOnClose);
    dialog->setAcceptMode(QFileDialog::AcceptSave);
    dialog->setDefaultSuffix("png");
    dialog->selectFile(last_);
    connect(dialog, &QFileDialog::fileSelected, this, [this](const QString& file) { save(file); });
    dialog->open();
}

void PicturePanel::save(const QString& file) {
    last_ = file;
    const QSize size(width_->value(), height_->value());
    const Result<void> saved = view_.saveImage(file, size);
    answer_->setText(saved ? QString("Saved as %1, %2 × %3 pixels.").arg(file).arg(size.width()).arg(size.height())
                           : toQString(saved.error().message));
    answer_->setStyleSheet(QStringLiteral("color: %1;").arg((saved ? theme_.colors().mutedText : theme_.colors().error).name()));
    answer_->show();
}

}  // namespace emca::explorer
