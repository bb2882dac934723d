#include "image/image_view.h"

#include <QApplication>
#include <QClipboard>
#include <QDragEnterEvent>
#include <QFileInfo>
#include <QHBoxLayout>
#include <QMenu>
#include <QMimeData>
#include <QPainter>
#include <QVBoxLayout>
#include <algorithm>
#include <cmath>
#include <limits>

#include "base/color_bar.h"
#include "base/qt_compat.h"
#include "base/state_overlay.h"
#include "base/theme.h"
#include "base/view_keys.h"
#include "emca/analysis/format.h"
#include "image/compare_bar.h"
#include "image/image_actions.h"
#include "image/image_canvas.h"
#include "image/image_controls.h"
#include "image/image_drop.h"
#include "image/image_files.h"
#include "image/image_header.h"
#include "image/pixel_values.h"
#include "image/region_tool.h"
#include "image/value_line.h"

namespace emca::explorer {
namespace {

constexpr int kPatienceMilliseconds = 300;

/// Picture and colour bar on one ground, also where the bar leaves its place empty.
class Ground : public QWidget {
  public:
    explicit Ground(Theme& theme) : theme_(theme) {}

  protected:
    void paintEvent(QPaintEvent*) override { QPainter(this).fillRect(rect(), theme_.colors().ground); }

  private:
    Theme& theme_;
};

}  // namespace

ImageView::ImageView(client::Dataset& dataset, client::Selection& selection, Theme& theme, QWidget* parent)
    : QWidget(parent), dataset_(dataset), selection_(selection), theme_(theme), model_(new ImageModel(dataset, theme, this)),
      actions_(new ImageActions(*model_, *this)), files_(new ImageFiles(this)), canvas_(new ImageCanvas(*model_, theme)),
      region_(new RegionTool(dataset, *canvas_, selection, theme)), bar_(new ColorBar(theme)), header_(new ImageHeader(dataset, *model_, theme)), compare_(new CompareBar(*model_, theme)),
      values_(new ValueLine(theme)), controls_(new ImageControls(*model_, *actions_, theme)), overlay_(nullptr), computing_(nullptr),
      drop_(nullptr), datasetListening_(dataset, [this](std::uint32_t parts) { model_->datasetChanged(parts); }),
      selectionListening_(selection, [this](std::uint32_t parts) {
          if (!(parts & client::SelectionPart::pixel)) return;
          canvas_->setMarked(selection_.state().pixel);
          showValues();
      }) {
    setAcceptDrops(true);
    build();
    connectParts();
    setFocusProxy(canvas_);
    setViewKeys(*canvas_, tr("Image"), {{"+", tr("Zoom in")}, {"-", tr("Zoom out")}, {"1", tr("One pixel per pixel")}, {"0", tr("All of the image")},
        {"Home", tr("All of the image")}, {"Left", tr("Pixel at the left")}, {"Right", tr("Pixel at the right")}, {"Up", tr("Pixel above")},
        {"Down", tr("Pixel below")}, {"Space", tr("Held: the left button moves the image")}});
    canvas_->setMarked(selection_.state().pixel);
    showDisplay();
}

ImageView::~ImageView() = default;

void ImageView::build() {
    auto* middle = new Ground(theme_);
    auto* row = new QHBoxLayout(middle);
    row->setContentsMargins(0, 0, 0, 0);
    row->setSpacing(0);
    row->addWidget(canvas_, 1);
    row->addWidget(bar_);
    ColorBarContent titled;
    titled.title = QStringLiteral(" ");   // its width does not depend on the quantity
    bar_->show(titled);
    bar_->hide();
    auto* layout = new QVBoxLayout(this);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->setSpacing(0);
    layout->addWidget(header_);
    layout->addWidget(compare_);
    layout->addWidget(middle, 1);
    layout->addWidget(values_);
    layout->addWidget(controls_);
    computing_ = new StateOverlay(theme_, middle);
    overlay_ = new StateOverlay(theme_, middle);
    drop_ = new ImageDrop(theme_, middle);
    patience_.setSingleShot(true);
    patience_.setInterval(kPatienceMilliseconds);
}

void ImageView::connectParts() {
    connect(model_, &ImageModel::displayChanged, this, &ImageView::showDisplay);
    connect(model_, &ImageModel::computingChanged, this, &ImageView::showComputing);
    connect(model_, &ImageModel::pictureChanged, this, &ImageView::showValues);
    connect(&patience_, &QTimer::timeout, this, &ImageView::showComputing);
    connect(bar_, &ColorBar::rangeEdited, this, [this](const analysis::ValueRange& range) {
        ImageDisplay display = model_->display();
        display.scale().range = range;
        display.scale().automatic = false;
        model_->setDisplay(display);
    });
    connect(canvas_, &ImageCanvas::clicked, this, [this](Pixel pixel) { selection_.setPixel(pixel); });
    connect(canvas_, &ImageCanvas::hoverChanged, this, &ImageView::showValues);
    connect(canvas_, &ImageCanvas::zoomChanged, this, [this] { header_->setZoom(canvas_->transform().zoom()); });
    connect(canvas_, &ImageCanvas::contextMenuWanted, this, &ImageView::pixelMenu);
    connect(header_, &ImageHeader::fitWanted, canvas_, &ImageCanvas::fit);
    connect(header_, &ImageHeader::zoomWanted, canvas_, &ImageCanvas::zoomTo);
    connect(header_, &ImageHeader::nextInvalidWanted, this, &ImageView::goToNextInvalid);
    connect(header_, &ImageHeader::openReferenceWanted, files_, &ImageFiles::askForReference);
    connect(actions_, &ImageActions::openReferenceWanted, files_, &ImageFiles::askForReference);
    connect(actions_, &ImageActions::nextInvalidWanted, this, &ImageView::goToNextInvalid);
    connect(actions_, &ImageActions::saveShownWanted, this, &ImageView::saveShown);
    connect(actions_, &ImageActions::stepImageWanted, this, &ImageView::stepImage);
    connect(files_, &ImageFiles::referenceChosen, this, &ImageView::openReferenceWanted);
}

bool ImageView::isSettled() const { return model_->isSettled() && !files_->isSaving(); }

void ImageView::showDisplay() {
    const ImageDisplay& display = model_->display();
    const ImageStyle style = display.style();
    values_->setRowCount(model_->reference() ? 2 : 1);
    // While one flips between images and differences, the pixels stay where they are: the bar keeps its place.
    QSizePolicy place = bar_->sizePolicy();
    place.setRetainSizeWhenHidden(model_->reference() != nullptr);
    bar_->setSizePolicy(place);
    bar_->setVisible(style.falseColor && model_->image() && model_->obstacle().isEmpty());
    if (style.falseColor && !model_->isComputing()) {
        ColorBarContent content = bar_->content();
        content.map = style.colorMap;
        content.range = style.range;
        const bool single = style.channel.kind == ChannelSelect::Kind::channel || style.channel.kind == ChannelSelect::Kind::layer;
        // A channel that is no colour has a unit that only its maker knows.
        const bool color = !single || style.channel.name.size() == 1;
        content.title = toQString(color || display.quantity() != "radiance" ? display.quantity() : style.channel.name);
        if (single && content.title != toQString(style.channel.name)) content.title += QStringLiteral(" ") + toQString(style.channel.name);
        if (!display.unit().empty() && color) content.title += QStringLiteral(", ") + toQString(display.unit());
        bar_->show(content);
        bar_->updateGeometry();
    }
    showComputing();
    showValues();
}

void ImageView::showComputing() {
    const ImageDisplay& display = model_->display();
    const auto leave = [this] {
        ImageDisplay back = model_->display();
        back.mode = ImageMode::image;
        back.samplingError.reset();
        model_->setDisplay(back);
    };
    if (model_->isComputing()) {
        if (!waiting_) patience_.start();
        waiting_ = true;
        if (patience_.isActive()) return;
        computing_->showBusy(tr("Computing: %1").arg(toQString(display.quantity())), model_->fraction() > 0 ? model_->fraction() : -1, tr("Cancel"), leave);
        return;
    }
    patience_.stop();
    waiting_ = false;
    if (model_->image() && !model_->obstacle().isEmpty()) computing_->showError(model_->obstacle(), tr("Show the image"), leave);
    else if (!computing_->sentence().isEmpty()) computing_->clear();
}

void ImageView::showValues() {
    const auto pixel = canvas_->hovered() ? canvas_->hovered() : selection_.state().pixel;
    values_->setRows(pixel ? pixelRows(*model_, *pixel) : std::vector<ValueLine::Row>{});
    const auto& shown = model_->content().values;
    bar_->setPointer(shown && pixel && shown->contains(*pixel) ? double(shownNumber(*shown, *pixel, model_->display().channel))
                                                               : std::numeric_limits<double>::quiet_NaN());
}

void ImageView::goToNextInvalid() {
    const ImagePixels& front = model_->front();
    const auto next = front.image() ? analysis::nextFault(*front.image(), selection_.state().pixel, faultRules(front.style())) : std::nullopt;
    if (!next) return;
    selection_.setPixel(next->pixel);
    canvas_->focusOn(next->pixel);
}

void ImageView::focusSelection() {
    if (selection_.state().pixel) canvas_->focusOn(*selection_.state().pixel);
    else canvas_->focusOn(selection_.state().region.bounds());
}

void ImageView::toggleLog() { actions_->toggleLog(); }

void ImageView::stepImage(int by) {
    const auto count = static_cast<int>(dataset_.images().size());
    if (count > 1) dataset_.setCurrentImage(static_cast<std::size_t>((static_cast<int>(dataset_.currentImageIndex()) + by + count) % count));
}

QImage ImageView::shownPicture() const {
    if (model_->front().picture().isNull()) return {};
    QImage picture = model_->front().picture().full().copy();
    if (model_->display().mode == ImageMode::split && !model_->back().picture().isNull()) {
        const int from = static_cast<int>(std::lround(canvas_->transform().toImage(QPointF(canvas_->split() * canvas_->width(), 0)).x()));
        QPainter painter(&picture);
        painter.setClipRect(QRect(from, 0, std::max(0, picture.width() - from), picture.height()));
        painter.drawImage(0, 0, model_->back().picture().full());
    }
    return picture;
}

void ImageView::saveShown() {
    const client::ImageEntry* entry = dataset_.currentImage();
    const auto& values = model_->content().values;
    if (!entry || !values || model_->front().picture().isNull()) return;
    const ImageDisplay& display = model_->display();
    QString name = QFileInfo(toQString(entry->title)).completeBaseName();
    if (display.quantity() != "radiance") name += QStringLiteral(", ") + toQString(display.quantity());
    // A preview is still written to: a copy of it is saved.
    files_->askWhereToSave(name, shownPicture(), entry->preview ? std::make_shared<const Image>(*values) : values);
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
            [this, pixel] { QApplication::clipboard()->setText(pixelText(*model_, pixel)); });
    connect(menu.addAction(tr("Expose for this pixel")), &QAction::triggered, this, [this, pixel] {
        const float brightest = model_->image()->color.contains(pixel) ? maxComponent(model_->image()->color.color(pixel)) : 0;
        if (brightest > 0 && std::isfinite(brightest)) actions_->setExposure(-std::log2(double(brightest)));
    });
    menu.addSeparator();
    for (const char* name : {"flipReference", "splitReference", "difference", "useAsReference", "openReference", "saveShown"})
        for (QAction* action : actions())
            if (action->objectName() == name) menu.addAction(action);
    menu.exec(global);
}

void ImageView::dragEnterEvent(QDragEnterEvent* event) {
    // Without an image there is nothing to compare with: the window opens what is dropped.
    if (!model_->image() || ImageDrop::imagesIn(*event->mimeData()).isEmpty()) return event->ignore();
    drop_->present(drop_->parentWidget()->mapFrom(this, positionOf(*event).toPoint()));
    event->acceptProposedAction();
}

void ImageView::dragMoveEvent(QDragMoveEvent* event) {
    drop_->present(drop_->parentWidget()->mapFrom(this, positionOf(*event).toPoint()));
    event->acceptProposedAction();
}

void ImageView::dragLeaveEvent(QDragLeaveEvent*) { drop_->hide(); }

void ImageView::dropEvent(QDropEvent* event) {
    drop_->hide();
    QStringList files = ImageDrop::imagesIn(*event->mimeData());
    if (files.isEmpty()) return event->ignore();
    const bool reference = drop_->isOnReference(drop_->parentWidget()->mapFrom(this, positionOf(*event).toPoint()));
    event->acceptProposedAction();
    if (reference) emit openReferenceWanted(files.takeFirst());
    if (!files.isEmpty()) emit openWanted(files);
}

}  // namespace emca::explorer
