#include "image/image_view.h"

#include <QApplication>
#include <QClipboard>
#include <QComboBox>
#include <QHBoxLayout>
#include <QKeyEvent>
#include <QLabel>
#include <QMenu>
#include <QSignalBlocker>
#include <QToolButton>
#include <QVariant>
#include <QVBoxLayout>
#include <algorithm>
#include <cmath>
#include <limits>

#include "base/color_bar.h"
#include "base/qt_compat.h"
#include "base/state_overlay.h"
#include "base/theme.h"
#include "emca/analysis/format.h"
#include "emca/analysis/statistics.h"
#include "image/image_canvas.h"
#include "image/image_controls.h"
#include "image/region_tool.h"

namespace emca::explorer {
namespace {

QToolButton* button(const QString& text, const QString& tip) {
    auto* made = new QToolButton;
    made->setText(text);
    made->setToolTip(tip);
    return made;
}

/// A value of a channel that only renders and files of ours have.
std::optional<float> channelValue(const Image& image, std::string_view channel, Pixel pixel) {
    const int index = image.channelIndex(channel);
    if (index < 0 || !image.contains(pixel)) return std::nullopt;
    return image.at(pixel)[index];
}

QString number(float value) { return toQString(analysis::formatNumber(double(value))); }

QString zoomText(double zoom) {
    const double percent = zoom * 100;
    return QStringLiteral("%1 %").arg(percent >= 10 ? QString::number(std::lround(percent)) : QString::number(percent, 'f', 1));
}

}  // namespace

ImageView::ImageView(client::Dataset& dataset, client::Selection& selection, Theme& theme, QWidget* parent)
    : QWidget(parent), dataset_(dataset), selection_(selection), theme_(theme),
      canvas_(new ImageCanvas(pixels_, theme)), region_(new RegionTool(dataset, *canvas_, selection, theme)), bar_(new ColorBar(theme)), controls_(new ImageControls(theme)),
      overlay_(nullptr),
      datasetListening_(dataset, [this](std::uint32_t parts) { datasetChanged(parts); }),
      selectionListening_(selection, [this](std::uint32_t parts) {
          if (parts & client::SelectionPart::pixel) canvas_->setMarked(selection_.state().pixel);
          if (parts & client::SelectionPart::pixel) showValues();
      }) {
    auto* middle = new QWidget;
    auto* row = new QHBoxLayout(middle);
    row->setContentsMargins(0, 0, 0, 0);
    row->setSpacing(0);
    row->addWidget(canvas_, 1);
    row->addWidget(bar_);
    bar_->hide();
    auto* layout = new QVBoxLayout(this);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->setSpacing(0);
    layout->addWidget(header());
    layout->addWidget(middle, 1);
    layout->addWidget(infoLine());
    layout->addWidget(controls_);
    overlay_ = new StateOverlay(theme, middle);

    ImageStyle style;
    style.toneMap = theme.toneMap();
    controls_->setStyle(style);
    connect(controls_, &ImageControls::styleChanged, this, &ImageView::applyStyle);
    connect(controls_, &ImageControls::automaticRangeWanted, this, &ImageView::automaticRange);
    connect(bar_, &ColorBar::rangeEdited, this, [this](const analysis::ValueRange& range) {
        ImageStyle edited = controls_->style();
        edited.range = range;
        controls_->setStyle(edited);
        applyStyle();
    });
    connect(canvas_, &ImageCanvas::clicked, this, [this](Pixel pixel) { selection_.setPixel(pixel); });
    connect(canvas_, &ImageCanvas::hoverChanged, this, &ImageView::showValues);
    connect(canvas_, &ImageCanvas::zoomChanged, this, [this] { zoom_->setText(zoomText(canvas_->transform().zoom())); });
    connect(canvas_, &ImageCanvas::contextMenuWanted, this, &ImageView::pixelMenu);
    connect(&pixels_, &ImagePixels::pictureChanged, this, [this] {
        showInvalid();
        showValues();
    });
    setFocusProxy(canvas_);
    datasetChanged(client::DatasetPart::images | client::DatasetPart::currentImage);
    canvas_->setMarked(selection_.state().pixel);
}

ImageView::~ImageView() = default;

QWidget* ImageView::header() {
    auto* bar = new QWidget;
    auto* layout = new QHBoxLayout(bar);
    layout->setContentsMargins(Spacing::small, Spacing::tiny, Spacing::small, Spacing::tiny);
    layout->setSpacing(Spacing::tiny);
    images_ = new QComboBox;
    images_->setObjectName("images");
    images_->setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
    images_->setMinimumContentsLength(12);
    images_->setToolTip(tr("Renders and opened files"));
    invalid_ = button({}, tr("Go to the next of them (N)"));
    invalid_->setObjectName("invalid");
    zoom_ = button(QStringLiteral("100 %"), tr("Zoom: wheel at the cursor, + and −. Click: fit (0)"));
    zoom_->setFont(theme_.numberFont());
    zoom_->setMinimumWidth(72);
    auto* fit = button(tr("Fit"), tr("Whole image (0)"));
    auto* one = button(QStringLiteral("1:1"), tr("One screen pixel per image pixel (1)"));
    layout->addWidget(images_, 1);
    layout->addWidget(invalid_);
    layout->addWidget(zoom_);
    layout->addWidget(fit);
    layout->addWidget(one);
    connect(images_, qOverload<int>(&QComboBox::activated), this, [this](int index) {
        dataset_.setCurrentImage(static_cast<std::size_t>(index));
    });
    connect(invalid_, &QToolButton::clicked, this, &ImageView::goToNextInvalid);
    connect(zoom_, &QToolButton::clicked, canvas_, &ImageCanvas::fit);
    connect(fit, &QToolButton::clicked, canvas_, &ImageCanvas::fit);
    connect(one, &QToolButton::clicked, this, [this] { canvas_->zoomTo(1); });
    return bar;
}

QWidget* ImageView::infoLine() {
    auto* line = new QWidget;
    auto* layout = new QHBoxLayout(line);
    layout->setContentsMargins(Spacing::medium, 2, Spacing::medium, 0);
    layout->setSpacing(Spacing::large);
    position_ = new QLabel;
    values_ = new QLabel;
    statistics_ = new QLabel;
    values_->setTextFormat(Qt::RichText);
    statistics_->setTextFormat(Qt::RichText);
    for (QLabel* label : {position_, values_, statistics_}) label->setFont(theme_.numberFont());
    position_->setMinimumWidth(84);
    // The line must never make the view wider than its place.
    values_->setMinimumWidth(1);
    statistics_->setMinimumWidth(1);
    layout->addWidget(position_);
    layout->addWidget(values_, 1);
    layout->addWidget(statistics_);
    line->setFixedHeight(22);
    return line;
}

void ImageView::datasetChanged(std::uint32_t parts) {
    using client::DatasetPart;
    if (parts & (DatasetPart::images | DatasetPart::currentImage)) {
        listImages();
        showImage();
    }
    if (parts & DatasetPart::pixels) pixels_.refresh();
}

void ImageView::listImages() {
    const QSignalBlocker quiet(images_);
    images_->clear();
    for (const client::ImageEntry& entry : dataset_.images()) images_->addItem(toQString(entry.title));
    images_->setCurrentIndex(dataset_.images().empty() ? -1 : static_cast<int>(dataset_.currentImageIndex()));
    images_->setEnabled(!dataset_.images().empty());
}

void ImageView::showImage() {
    const client::ImageEntry* entry = dataset_.currentImage();
    const bool changed = (entry ? entry->image : nullptr) != pixels_.image();
    if (entry && entry->image) controls_->setChannels(entry->image->color.channels());
    pixels_.set(entry ? entry->image : nullptr, controls_->style());
    if (changed && !rangeChosen_ && controls_->style().falseColor) automaticRange();
    showInvalid();
    showValues();
}

void ImageView::applyStyle() {
    const ImageStyle& style = controls_->style();
    theme_.setToneMap(style.toneMap);
    if (style.falseColor && !rangeChosen_) {
        automaticRange();
        return;
    }
    bar_->setVisible(style.falseColor);
    const client::ImageEntry* entry = dataset_.currentImage();
    const bool channel = style.channel.index >= 0 && entry && entry->image &&
                         style.channel.index < static_cast<int>(entry->image->color.channelCount());
    bar_->show(style.colorMap, style.range,
               channel ? toQString(entry->image->color.channels()[static_cast<std::size_t>(style.channel.index)])
                       : QStringLiteral("W/(sr m²)"));
    pixels_.setStyle(style);
}

void ImageView::automaticRange() {
    const client::ImageEntry* entry = dataset_.currentImage();
    if (!entry || !entry->image) return;
    ImageStyle style = controls_->style();
    const bool log = style.range.log;
    style.range = analysis::percentileRange(analysis::scalars(entry->image->color, style.channel), 0.005, 0.995, log);
    rangeChosen_ = true;
    controls_->setStyle(style);
    applyStyle();
}

QString ImageView::describe(Pixel pixel) const {
    const auto& rendered = pixels_.image();
    if (!rendered || !rendered->color.contains(pixel)) return {};
    const Color color = rendered->color.color(pixel);
    QString text = QStringLiteral("%1  R %2  G %3  B %4  Y %5")
                       .arg(toQString(analysis::formatPixel(pixel)), number(color.r), number(color.g), number(color.b),
                            number(luminance(color)));
    if (const auto samples = channelValue(rendered->samples, "samples", pixel)) text += tr("  %1 samples").arg(static_cast<int>(*samples));
    return text;
}

void ImageView::showValues() {
    const auto& rendered = pixels_.image();
    const auto pixel = canvas_->hovered() ? canvas_->hovered() : selection_.state().pixel;
    if (!rendered || !pixel || !rendered->color.contains(*pixel)) {
        for (QLabel* label : {position_, values_, statistics_}) label->clear();
        bar_->setPointer(std::numeric_limits<double>::quiet_NaN());
        return;
    }
    const ThemeColors& c = theme_.colors();
    const auto part = [&](const QString& label, float value, const QColor& tint) {
        const QString shown = number(value);
        const QColor ink = analysis::isNonFiniteWord(shown.toStdString()) || value < 0 ? c.warning : c.text;
        return QStringLiteral("<span style='color:%1'>%2</span>&nbsp;<span style='color:%3'>%4</span>")
            .arg(tint.name(), label, ink.name(), shown);
    };
    const Color color = rendered->color.color(*pixel);
    position_->setText(toQString(analysis::formatPixel(*pixel)));
    values_->setText(QStringList{part("R", color.r, c.red), part("G", color.g, c.green), part("B", color.b, c.blue),
                                 part("Y", luminance(color), c.mutedText)}.join(QStringLiteral("&nbsp;&nbsp; ")));
    QStringList statistics;
    auto samples = channelValue(rendered->samples, "samples", *pixel);
    if (!samples) samples = channelValue(rendered->color, "samples", *pixel);
    if (samples) statistics += QStringLiteral("%1 <span style='color:%2'>spp</span>").arg(static_cast<int>(*samples)).arg(c.mutedText.name());
    if (rendered->variance.contains(*pixel))
        statistics += part(tr("σ²"), luminance(rendered->variance.color(*pixel)), c.mutedText);
    statistics_->setText(statistics.join(QStringLiteral("&nbsp;&nbsp; ")));
    bar_->setPointer(double(analysis::scalar(rendered->color, *pixel, controls_->style().channel)));
}

void ImageView::showInvalid() {
    const InvalidPixels& found = pixels_.invalid();
    QStringList words;
    if (found.nan) words += tr("%1 NaN").arg(found.nan);
    if (found.infinite) words += tr("%1 infinite").arg(found.infinite);
    if (found.negative) words += tr("%1 negative").arg(found.negative);
    invalid_->setVisible(!words.isEmpty());
    invalid_->setText(words.join(", "));
    invalid_->setStyleSheet(QStringLiteral("color: %1").arg(theme_.colors().warning.name()));
}

void ImageView::goToNextInvalid() {
    const auto& pixels = pixels_.invalid().pixels;
    if (pixels.empty()) return;
    const auto from = selection_.state().pixel;
    auto next = from ? std::upper_bound(pixels.begin(), pixels.end(), *from) : pixels.begin();
    if (next == pixels.end()) next = pixels.begin();
    selection_.setPixel(*next);
    canvas_->focusOn(*next);
}

void ImageView::focusSelection() {
    if (selection_.state().pixel) canvas_->focusOn(*selection_.state().pixel);
}

void ImageView::toggleLog() {
    if (controls_->style().falseColor) controls_->toggleLog();
}

void ImageView::pixelMenu(Pixel pixel, QPoint global) {
    QMenu menu;
    const bool selected = selection_.state().pixel == pixel;
    connect(menu.addAction(selected ? tr("Trace again") : tr("Trace pixel %1").arg(toQString(analysis::formatPixel(pixel)))),
            &QAction::triggered, this, [this, pixel, selected] {
                if (selected) emit traceAgainWanted();
                else selection_.setPixel(pixel);
            });
    connect(menu.addAction(tr("Zoom to it")), &QAction::triggered, this, [this, pixel] { canvas_->focusOn(pixel); });
    if (const client::PixelRegion& region = selection_.state().region; !region.empty()) {
        menu.addSeparator();
        connect(menu.addAction(region.contains(pixel) ? tr("Take this pixel out of the region") : tr("Add this pixel to the region")),
                &QAction::triggered, this, [this, pixel] { selection_.togglePixel(pixel); });
        connect(menu.addAction(tr("Trace the region again")), &QAction::triggered, this, [this] { emit traceAgainWanted(); });
        connect(menu.addAction(tr("Clear the region")), &QAction::triggered, this, [this] { selection_.setRegion({}); });
    }
    menu.addSeparator();
    connect(menu.addAction(tr("Copy values")), &QAction::triggered, this,
            [this, pixel] { QApplication::clipboard()->setText(describe(pixel)); });
    connect(menu.addAction(tr("Expose for this pixel")), &QAction::triggered, this, [this, pixel] {
        const float brightest = maxComponent(pixels_.image()->color.color(pixel));
        if (!(brightest > 0) || std::isinf(brightest)) return;
        controls_->changeExposure(-std::log2(double(brightest)) - double(controls_->style().toneMap.exposure));
    });
    menu.exec(global);
}

void ImageView::keyPressEvent(QKeyEvent* event) {
    switch (event->key()) {
        case Qt::Key_E: controls_->changeExposure(event->modifiers() & Qt::ShiftModifier ? -0.5 : 0.5); break;
        case Qt::Key_C: controls_->toggleFalseColor(); break;
        case Qt::Key_N: goToNextInvalid(); break;
        default: QWidget::keyPressEvent(event);
    }
}

}  // namespace emca::explorer
