#include "image/image_header.h"

#include <QComboBox>
#include <QHBoxLayout>
#include <QLabel>
#include <QSignalBlocker>
#include <QToolButton>
#include <QVariant>
#include <algorithm>
#include <cmath>

#include "base/qt_compat.h"
#include "base/theme.h"
#include "emca/analysis/format.h"
#include "image/image_model.h"

namespace emca::explorer {
namespace {

QToolButton* button(const QString& text, const QString& tip) {
    auto* made = new QToolButton;
    made->setText(text);
    made->setToolTip(tip);
    return made;
}

QComboBox* list(const char* name, const QString& tip, int letters) {
    auto* made = new QComboBox;
    made->setObjectName(name);
    made->setToolTip(tip);
    made->setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
    made->setMinimumContentsLength(letters);
    return made;
}

QString zoomText(double zoom) {
    const double percent = zoom * 100;
    return QStringLiteral("%1 %").arg(percent >= 10 ? QString::number(std::lround(percent)) : QString::number(percent, 'f', 1));
}

}  // namespace

ImageHeader::ImageHeader(client::Dataset& dataset, ImageModel& model, Theme& theme, QWidget* parent)
    : QWidget(parent), dataset_(dataset), model_(model), theme_(theme),
      images_(list("images", tr("Renders and opened files (PgUp, PgDown)"), 9)),
      references_(list("references", tr("What the image is compared with: an earlier render, an opened image, or a file. "
                                        "Files can also be dropped on the picture."), 9)),
      invalid_(button({}, tr("Go to the next of them (N)"))),
      zoom_(button(QStringLiteral("100 %"), tr("Zoom: wheel at the cursor, + and −. Click: fit (0)"))) {
    auto* layout = new QHBoxLayout(this);
    layout->setContentsMargins(Spacing::small, Spacing::tiny, Spacing::small, Spacing::tiny);
    layout->setSpacing(Spacing::tiny);
    invalid_->setObjectName("invalid");
    zoom_->setFont(theme_.numberFont());
    zoom_->setMinimumWidth(64);
    auto* against = new QLabel(tr("vs"));
    against->setProperty("role", "muted");
    auto* fit = button(tr("Fit"), tr("Whole image (0)"));
    auto* one = button(QStringLiteral("1:1"), tr("One screen pixel per image pixel (1)"));
    layout->addWidget(images_, 3);
    layout->addWidget(against);
    layout->addWidget(references_, 2);
    for (QToolButton* tool : {invalid_, zoom_, fit, one}) layout->addWidget(tool);
    connect(images_, qOverload<int>(&QComboBox::activated), this, [this](int index) { dataset_.setCurrentImage(static_cast<std::size_t>(index)); });
    connect(references_, qOverload<int>(&QComboBox::activated), this, &ImageHeader::referenceChosen);
    connect(invalid_, &QToolButton::clicked, this, &ImageHeader::nextInvalidWanted);
    connect(zoom_, &QToolButton::clicked, this, &ImageHeader::fitWanted);
    connect(fit, &QToolButton::clicked, this, &ImageHeader::fitWanted);
    connect(one, &QToolButton::clicked, this, [this] { emit zoomWanted(1); });
    connect(&model_, &ImageModel::displayChanged, this, [this] {
        listImages();
        listReferences();
    });
    connect(&model_, &ImageModel::pictureChanged, this, &ImageHeader::showInvalid);
    connect(&theme_, &Theme::themeChanged, this, &ImageHeader::showInvalid);
    listImages();
    listReferences();
    showInvalid();
}

void ImageHeader::setZoom(double zoom) { zoom_->setText(zoomText(zoom)); }

void ImageHeader::listImages() {
    const QSignalBlocker quiet(images_);
    images_->clear();
    for (const client::ImageEntry& entry : dataset_.images()) images_->addItem(toQString(entry.title));
    images_->setCurrentIndex(dataset_.images().empty() ? -1 : static_cast<int>(dataset_.currentImageIndex()));
    images_->setEnabled(!dataset_.images().empty());
}

/// "No reference", the images, "Open a file…".
void ImageHeader::listReferences() {
    const QSignalBlocker quiet(references_);
    references_->clear();
    references_->addItem(tr("No reference"));
    int chosen = 0;
    for (const client::ImageEntry& entry : dataset_.images()) {
        references_->addItem(toQString(entry.title));
        if (model_.reference() && entry.image == model_.reference()) chosen = references_->count() - 1;
    }
    references_->insertSeparator(references_->count());
    references_->addItem(tr("Open a file…"));
    references_->setCurrentIndex(chosen);
    references_->setEnabled(!dataset_.images().empty());
}

void ImageHeader::referenceChosen(int index) {
    const auto& images = dataset_.images();
    if (index == references_->count() - 1) {
        listReferences();   // the choice comes when a file is there
        emit openReferenceWanted();
    } else if (index >= 1 && static_cast<std::size_t>(index) <= images.size()) {
        model_.setReference(images[static_cast<std::size_t>(index) - 1].image);
    } else {
        model_.setReference(nullptr);
    }
}

void ImageHeader::showInvalid() {
    const analysis::FaultCounts& found = model_.front().invalid().counts;
    QStringList words;
    if (found.nan) words += tr("%1 NaN").arg(found.nan);
    if (found.infinite) words += tr("%1 infinite").arg(found.infinite);
    if (found.negative) words += tr("%1 negative").arg(found.negative);
    invalid_->setVisible(!words.isEmpty());
    if (const QString text = words.join(", "); text != invalid_->text()) invalid_->setText(text);
    const QString style = QStringLiteral("color: %1").arg(theme_.colors().warning.name());
    if (style != invalid_->styleSheet()) invalid_->setStyleSheet(style);
}

}  // namespace emca::explorer
