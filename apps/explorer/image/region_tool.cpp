#include "image/region_tool.h"

#include <QKeyEvent>
#include <QPainter>
#include <algorithm>
#include <cmath>
#include <utility>

#include "base/qt_compat.h"
#include "base/theme.h"
#include "image/image_canvas.h"
#include "image/region_outline.h"

namespace emca::explorer {
namespace {

constexpr double kStill = 6;        // a hand that moves less has clicked
constexpr double kSmallest = 20;    // a region that is smaller on the screen is framed at this size

PixelRect around(Pixel a, Pixel b) {
    return {std::min(a.x, b.x), std::min(a.y, b.y), std::max(a.x, b.x) + 1, std::max(a.y, b.y) + 1};
}

QRectF boxOf(const PixelRect& r) { return QRectF(r.x0, r.y0, double(r.x1) - r.x0, double(r.y1) - r.y0); }

std::vector<QLineF> sidesOf(const PixelRect& r) {
    const QRectF box = boxOf(r);
    return {QLineF(box.topLeft(), box.topRight()), QLineF(box.bottomLeft(), box.bottomRight()),
            QLineF(box.topLeft(), box.bottomLeft()), QLineF(box.topRight(), box.bottomRight())};
}

}  // namespace

RegionTool::RegionTool(const client::Dataset& dataset, ImageCanvas& canvas, client::Selection& selection, Theme& theme)
    : QWidget(&canvas), dataset_(dataset), canvas_(canvas), selection_(selection), theme_(theme),
      selectionListening_(selection, [this](std::uint32_t parts) { selectionChanged(parts); }) {
    setAttribute(Qt::WA_TransparentForMouseEvents);
    setAttribute(Qt::WA_NoSystemBackground);
    setFocusPolicy(Qt::NoFocus);
    setGeometry(canvas.rect());
    canvas.installEventFilter(this);
    selectionChanged(client::SelectionPart::region);
}

QSize RegionTool::imageSize() const {
    const client::ImageEntry* entry = dataset_.currentImage();
    if (!entry || !entry->image) return {0, 0};
    return {static_cast<int>(entry->image->color.width()), static_cast<int>(entry->image->color.height())};
}

void RegionTool::setRectangleMode(bool on) {
    if (on == rectangleMode_) return;
    rectangleMode_ = on;
    if (!on) endDrag();
    emit rectangleModeChanged(on);
}

bool RegionTool::eventFilter(QObject*, QEvent* event) {
    switch (event->type()) {
        case QEvent::Resize: setGeometry(canvas_.rect()); return false;
        case QEvent::MouseButtonPress: return press(static_cast<const QMouseEvent&>(*event));
        case QEvent::MouseMove:
            if (from_) {
                to_ = positionOf(static_cast<const QMouseEvent&>(*event));
                update();
            }
            return false;   // the canvas says what is under the cursor
        case QEvent::MouseButtonRelease: return release(static_cast<const QMouseEvent&>(*event));
        case QEvent::ShortcutOverride:
            // A drag is given up before anything that is selected.
            if (!from_ || static_cast<const QKeyEvent*>(event)->key() != Qt::Key_Escape) return false;
            event->accept();
            return true;
        case QEvent::KeyPress: return key(static_cast<const QKeyEvent&>(*event));
        default: return false;
    }
}

bool RegionTool::press(const QMouseEvent& event) {
    ctrlFrom_.reset();
    if (event.button() != Qt::LeftButton || imageSize().isEmpty()) return false;
    if (rectangleMode_ || (event.modifiers() & Qt::ShiftModifier)) {
        from_ = to_ = positionOf(event);
        return true;
    }
    if (event.modifiers() & Qt::ControlModifier) ctrlFrom_ = positionOf(event);
    return false;   // the canvas pans with it, if it moves
}

bool RegionTool::release(const QMouseEvent& event) {
    if (event.button() != Qt::LeftButton) return false;
    const QPointF at = positionOf(event);
    if (const auto pressed = std::exchange(ctrlFrom_, std::nullopt); pressed && (at - *pressed).manhattanLength() < kStill) {
        if (const auto pixel = canvas_.transform().pixelAt(*pressed)) {
            selection_.togglePixel(*pixel);
            emit chosen();
        }
        return false;
    }
    if (!from_) return false;
    const QPointF pressed = *from_;
    const bool still = (at - pressed).manhattanLength() < kStill, inMode = rectangleMode_;
    endDrag();
    setRectangleMode(false);
    PixelRect rect = rectOf(pressed, still ? pressed : at);
    const auto start = anchor();
    if (still && !inMode && start && !rect.empty()) rect = around(*start, {rect.x0, rect.y0});
    if (rect.empty()) return true;
    choose(rect, event.modifiers() & Qt::ControlModifier);
    if (still && start && !inMode) first_ = start;
    return true;
}

bool RegionTool::key(const QKeyEvent& event) {
    if (event.key() == Qt::Key_Escape && from_) {
        endDrag();
        setRectangleMode(false);
        return true;
    }
    if (!(event.modifiers() & Qt::ShiftModifier) || imageSize().isEmpty()) return false;
    int dx = 0, dy = 0;
    switch (event.key()) {
        case Qt::Key_Left: dx = -1; break;
        case Qt::Key_Right: dx = 1; break;
        case Qt::Key_Up: dy = -1; break;
        case Qt::Key_Down: dy = 1; break;
        default: return false;
    }
    const auto start = anchor();
    if (!start) return true;
    const bool going = first_ && last_ && selection_.pixels() == client::PixelRegion(around(*first_, *last_));
    const Pixel first = going ? *first_ : *start, end = going ? *last_ : *start;
    const auto moved = [](std::uint32_t v, int by, int size) { return static_cast<std::uint32_t>(std::clamp(static_cast<int>(v) + by, 0, size - 1)); };
    const Pixel last{moved(end.x, dx, imageSize().width()), moved(end.y, dy, imageSize().height())};
    choose(around(first, last), false);
    first_ = first;
    last_ = last;
    return true;
}

void RegionTool::endDrag() {
    if (!from_) return;
    from_.reset();
    update();
}

void RegionTool::choose(const PixelRect& rect, bool add) {
    first_ = Pixel{rect.x0, rect.y0};
    last_ = Pixel{rect.x1 - 1, rect.y1 - 1};
    const client::PixelRegion drawn(rect);
    selection_.setRegion(add ? selection_.pixels().with(drawn) : drawn);
    emit chosen();
}

PixelRect RegionTool::rectOf(QPointF a, QPointF b) const {
    if (imageSize().isEmpty()) return {};
    const QRectF box = QRectF(canvas_.transform().toImage(a), canvas_.transform().toImage(b)).normalized();
    const double width = imageSize().width(), height = imageSize().height();
    if (box.right() < 0 || box.bottom() < 0 || box.left() >= width || box.top() >= height) return {};
    const auto clamped = [](double v, double limit) { return static_cast<std::uint32_t>(std::clamp(std::floor(v), 0.0, limit - 1)); };
    return {clamped(box.left(), width), clamped(box.top(), height), clamped(box.right(), width) + 1, clamped(box.bottom(), height) + 1};
}

/// Where a rectangle by Shift and a click or an arrow begins.
std::optional<Pixel> RegionTool::anchor() const {
    if (selection_.state().pixel) return selection_.state().pixel;
    if (selection_.state().region.empty()) return std::nullopt;
    if (first_ && selection_.state().region.contains(*first_)) return first_;
    return selection_.state().region.pixels().front();
}

void RegionTool::selectionChanged(std::uint32_t parts) {
    using client::SelectionPart;
    const client::PixelRegion& region = selection_.state().region;
    if (parts & SelectionPart::region) {
        outline_ = regionOutline(region.pixels());
        update();
    }
    if (region.empty() && !current_ && !hovered_) return;
    const auto inside = [&](std::optional<Pixel> pixel) { return pixel && region.contains(*pixel) ? pixel : std::nullopt; };
    const auto& path = selection_.state().currentPath;
    const auto& hovered = selection_.hovered();
    setMark(inside(path ? std::optional(path->pixel) : std::nullopt), current_);
    setMark(inside(hovered ? std::optional(hovered->path.pixel) : std::nullopt), hovered_);
}

void RegionTool::setMark(std::optional<Pixel> pixel, std::optional<Pixel>& mark) {
    if (pixel == mark) return;
    for (const auto& changed : {pixel, mark})
        if (changed) update(canvas_.transform().rectOf(*changed).toAlignedRect().adjusted(-12, -12, 12, 12));
    mark = pixel;
}

void RegionTool::paintEvent(QPaintEvent*) {
    const client::PixelRegion& region = selection_.state().region;
    if (imageSize().isEmpty() || (region.empty() && !from_)) return;
    QPainter painter(this);
    painter.setRenderHint(QPainter::Antialiasing);
    if (!region.empty()) paintOutline(painter, outline_, boxOf(region.bounds()));
    if (hovered_ && hovered_ != current_) paintMark(painter, *hovered_, theme_.colors().hover);
    if (current_) paintMark(painter, *current_, theme_.colors().selected);
    if (!from_) return;
    if (const PixelRect rect = rectOf(*from_, to_); !rect.empty()) {
        painter.fillRect(canvas_.transform().toWidget(boxOf(rect)), QColor(255, 255, 255, 28));
        paintOutline(painter, sidesOf(rect), boxOf(rect));
        paintSize(painter, rect);
    }
}

/// Dark, light and orange lines on each other show on whatever lies below.
void RegionTool::paintOutline(QPainter& painter, const std::vector<QLineF>& lines, const QRectF& bounds) const {
    const ImageTransform& transform = canvas_.transform();
    QVector<QLineF> shown;
    QRectF box = transform.toWidget(bounds);
    if (std::max(box.width(), box.height()) < kSmallest) {
        const double x = std::max(0.0, (kSmallest - box.width()) / 2), y = std::max(0.0, (kSmallest - box.height()) / 2);
        box = QRectF(box.adjusted(-x, -y, x, y).toAlignedRect());
        shown = {QLineF(box.topLeft(), box.topRight()), QLineF(box.bottomLeft(), box.bottomRight()), QLineF(box.topLeft(), box.bottomLeft()),
                 QLineF(box.topRight(), box.bottomRight())};
    } else {
        const auto at = [&](QPointF p) {
            const QPointF widget = transform.toWidget(p);
            return QPointF(std::round(widget.x()), std::round(widget.y()));
        };
        shown.reserve(static_cast<int>(lines.size()));
        for (const QLineF& line : lines) shown.push_back(QLineF(at(line.p1()), at(line.p2())));
    }
    const std::pair<QColor, double> strokes[] = {{QColor(0, 0, 0, 200), 5}, {QColor(255, 255, 255), 3.5}, {theme_.colors().selected, 2}};
    for (const auto& [color, width] : strokes) {
        painter.setPen(QPen(color, width, Qt::SolidLine, Qt::SquareCap));
        painter.drawLines(shown);
    }
}

void RegionTool::paintMark(QPainter& painter, Pixel pixel, const QColor& color) const {
    QRectF box = canvas_.transform().rectOf(pixel);
    const double grow = std::max(0.0, (7 - box.width()) / 2);
    box = QRectF(box.adjusted(-grow, -grow, grow, grow).toAlignedRect());
    painter.setBrush(Qt::NoBrush);
    painter.setPen(QPen(QColor(0, 0, 0, 200), 4, Qt::SolidLine, Qt::SquareCap, Qt::MiterJoin));
    painter.drawRect(box);
    painter.setPen(QPen(color, 2, Qt::SolidLine, Qt::SquareCap, Qt::MiterJoin));
    painter.drawRect(box);
}

/// "8 × 8" beside the cursor.
void RegionTool::paintSize(QPainter& painter, const PixelRect& rect) const {
    const QString text = QStringLiteral("%1 × %2").arg(rect.x1 - rect.x0).arg(rect.y1 - rect.y0);
    painter.setFont(theme_.smallNumberFont());
    QRect box = painter.fontMetrics().boundingRect(text).adjusted(-6, -3, 6, 3);
    box.moveTopLeft(to_.toPoint() + QPoint(14, 14));
    if (box.right() > width()) box.moveRight(static_cast<int>(to_.x()) - 10);
    if (box.bottom() > height()) box.moveBottom(static_cast<int>(to_.y()) - 10);
    QColor ground = theme_.colors().raised;
    ground.setAlpha(235);
    painter.setPen(Qt::NoPen);
    painter.setBrush(ground);
    painter.drawRoundedRect(box, Spacing::radius, Spacing::radius);
    painter.setPen(theme_.colors().text);
    painter.drawText(box, Qt::AlignCenter, text);
}

}  // namespace emca::explorer
