#include "probe_canvas.h"

#include <QKeyEvent>
#include <QMouseEvent>
#include <QPainter>
#include <QPainterPath>
#include <QWheelEvent>
#include <algorithm>
#include <cmath>

namespace emca::light_probe {

namespace {

constexpr double kMarkSize = 13, kSmallMarkSize = 6;   ///< diameters, pixels
constexpr double kPickRadius = 9;

bool isSmall(DirectionKind kind) { return kind == DirectionKind::other; }

QColor colorOf(DirectionKind kind, const explorer::ThemeColors& colors) {
    switch (kind) {
        case DirectionKind::outgoing: return colors.currentSegment;
        case DirectionKind::emitter: return colors.emitter;
        case DirectionKind::nextEventVisible: return colors.nextEventVisible;
        case DirectionKind::nextEventOccluded: return colors.nextEventOccluded;
        case DirectionKind::incoming: case DirectionKind::other: break;
    }
    // On pictures, which have no theme.
    return QColor(255, 255, 255);
}

}  // namespace

void paintDirection(QPainter& painter, QPointF at, DirectionKind kind, double size, const explorer::ThemeColors& colors) {
    painter.save();
    painter.setRenderHint(QPainter::Antialiasing);
    const double r = size / 2;
    const QColor color = colorOf(kind, colors);
    QPainterPath shape;
    switch (kind) {
        case DirectionKind::nextEventVisible:
        case DirectionKind::nextEventOccluded:
            shape.addPolygon(QPolygonF({at + QPointF(0, -r), at + QPointF(r, 0), at + QPointF(0, r), at + QPointF(-r, 0), at + QPointF(0, -r)}));
            break;
        default: shape.addEllipse(at, r - 1, r - 1);
    }
    const QColor halo(0, 0, 0, 190);
    const bool hollow = kind == DirectionKind::incoming || kind == DirectionKind::nextEventOccluded;
    QPen pen(color, 2);
    if (kind == DirectionKind::nextEventOccluded) pen.setDashPattern({1.6, 1.1});
    if (hollow) {
        painter.setBrush(QColor(0, 0, 0, 70));
        painter.setPen(QPen(halo, 4.5));
        painter.drawPath(shape);
        painter.setBrush(Qt::NoBrush);
        painter.setPen(pen);
        painter.drawPath(shape);
    } else {
        painter.setPen(QPen(halo, isSmall(kind) ? 1 : 1.5));
        painter.setBrush(color);
        painter.drawPath(shape);
    }
    if (kind == DirectionKind::incoming) {   // the way of an arrow that comes towards one
        painter.setPen(Qt::NoPen);
        painter.setBrush(color);
        painter.drawEllipse(at, 1.8, 1.8);
    }
    painter.restore();
}

ProbeCanvas::ProbeCanvas(explorer::PluginContext& context, QWidget* parent) : QWidget(parent), context_(context) {
    shown_.fill(true);
    setObjectName("probeCanvas");
    setMouseTracking(true);
    setFocusPolicy(Qt::StrongFocus);
    setCursor(Qt::CrossCursor);
    setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Expanding);
    setToolTip(tr("Wheel: zoom. Middle button or Ctrl and drag: pan. Double click or 0: everything.\n"
                  "Click on a mark: go to the vertex at its other end. Click elsewhere: mark a direction, shown in the scene.\n"
                  "F: look at the outgoing direction."));
    // For the window's list of keys (F1): a title, then keys and what they do.
    setProperty("viewKeys", QStringList{tr("Light probe"), "U", tr("Render the probe of the selected vertex"), "A", tr("Follow the selection"),
                                        "F", tr("Look at the outgoing direction"), "0", tr("Show everything"), "+", tr("Closer"), "-", tr("Farther"),
                                        "E", tr("Brighter by half a stop"), "Shift+E", tr("Darker by half a stop"), "C", tr("False colour"),
                                        "L", tr("Logarithmic range"), "S", tr("Save")});
}

void ProbeCanvas::setProbe(std::shared_ptr<const probe::LightProbe> probe) {
    probe_ = std::move(probe);
    colourPixels();
}

void ProbeCanvas::setStyle(const ProbeStyle& style) {
    style_ = style;
    colourPixels();
}

void ProbeCanvas::setView(const SphereView& view) {
    view_ = view;
    transform_.setSizes(view_.size(), size());
    moved();
}

void ProbeCanvas::setDirections(std::vector<Direction> directions, Vec3f normal) {
    directions_ = std::move(directions);
    normal_ = normal;
    hoveredDirection_.reset();
    update();
}

void ProbeCanvas::setShown(DirectionKind kind, bool shown) {
    shown_[static_cast<std::size_t>(kind)] = shown;
    hoveredDirection_.reset();
    update();
}

void ProbeCanvas::setStale(const QString& words) {
    stale_ = words;
    update();
}

void ProbeCanvas::setMarked(std::optional<Vec3f> direction) {
    marked_ = direction;
    update();
}

const Direction* ProbeCanvas::hoveredDirection() const {
    return hoveredDirection_ && *hoveredDirection_ < directions_.size() ? &directions_[*hoveredDirection_] : nullptr;
}

std::optional<QPointF> ProbeCanvas::positionOf(Vec3f direction) const {
    const auto plane = view_.plane(direction);
    if (!plane) return std::nullopt;
    return transform_.toWidget(*plane);
}

void ProbeCanvas::fit() {
    transform_.fit();
    moved();
}

void ProbeCanvas::focusOn(Vec3f direction) {
    const auto plane = view_.plane(direction);
    if (!plane) return;
    if (transform_.zoom() < 4) transform_.zoomBy(4 / transform_.zoom(), transform_.toWidget(*plane));
    transform_.centre(*plane);
    moved();
}

void ProbeCanvas::colourPixels() {
    picture_ = QImage();
    update();
    if (!probe_) {
        colors_.clear();
        return;
    }
    const Image& image = probe_->image;
    std::vector<std::uint8_t> rgba(std::size_t(image.width()) * image.height() * 4);
    if (style_.falseColor) {
        analysis::falseColor(image, {analysis::ChannelChoice::kLuminance}, analysis::ColorMap::get(style_.map), style_.range, rgba);
    } else {
        analysis::ToneMapper(style_.toneMap).convert(image, rgba);
    }
    colors_.resize(rgba.size() / 4);
    for (std::size_t i = 0; i < colors_.size(); ++i) colors_[i] = qRgb(rgba[4 * i], rgba[4 * i + 1], rgba[4 * i + 2]);
}

/// Every pixel of the screen looks up the pixel of the probe in its direction.
void ProbeCanvas::projectPicture() {
    const double ratio = devicePixelRatioF();
    picture_ = QImage(QSize(std::max(1, int(width() * ratio)), std::max(1, int(height() * ratio))), QImage::Format_ARGB32_Premultiplied);
    picture_.setDevicePixelRatio(ratio);
    picture_.fill(Qt::transparent);
    const bool same = view_.projection() == Projection::latitudeLongitude && view_.frame() == probe_->map.frame();
    const std::uint32_t columns = probe_->map.width(), rows = probe_->map.height();
    for (int y = 0; y < picture_.height(); ++y) {
        auto* line = reinterpret_cast<QRgb*>(picture_.scanLine(y));
        for (int x = 0; x < picture_.width(); ++x) {
            const QPointF plane = transform_.toPlane(QPointF(x + 0.5, y + 0.5) / ratio);
            if (same) {
                if (!(plane.x() >= 0 && plane.y() >= 0 && plane.x() < 2 && plane.y() < 1)) continue;
                line[x] = colors_[static_cast<std::size_t>(plane.y() * rows) * columns + static_cast<std::size_t>(plane.x() / 2 * columns)];
            } else if (const auto direction = view_.direction(plane)) {
                const Pixel pixel = probe_->map.pixelOf(*direction);
                line[x] = colors_[std::size_t(pixel.y) * columns + pixel.x];
            }
        }
    }
}

void ProbeCanvas::moved() {
    picture_ = QImage();
    update();
}

void ProbeCanvas::paintEvent(QPaintEvent*) {
    QPainter painter(this);
    painter.fillRect(rect(), context_.colors().ground);
    if (!probe_) return;
    if (picture_.isNull()) projectPicture();
    painter.setOpacity(stale_.isEmpty() ? 1 : 0.4);
    painter.drawImage(0, 0, picture_);
    painter.setOpacity(1);
    painter.setRenderHint(QPainter::Antialiasing);
    if (stale_.isEmpty()) {
        paintHorizon(painter);
        paintDirections(painter);
        paintMarked(painter);
    } else {
        paintStale(painter);
    }
    if (hasFocus()) {
        painter.setPen(QPen(context_.colors().accent, 1));
        painter.setBrush(Qt::NoBrush);
        painter.drawRect(QRectF(rect()).adjusted(0.5, 0.5, -0.5, -0.5));
    }
}

/// Where the surface of the vertex is seen edge on: below it is the other side.
void ProbeCanvas::paintHorizon(QPainter& painter) {
    if (normal_ == Vec3f{}) return;
    const probe::SphereFrame around = probe::SphereFrame::around(normal_, view_.frame().forward);
    constexpr int kSteps = 360;
    QPainterPath line;
    std::optional<QPointF> before;
    for (int i = 0; i <= kSteps; ++i) {
        const double phi = 2 * 3.14159265358979323846 * i / kSteps;
        // A little above it, so that both discs have it.
        const auto at = positionOf(around.toWorld({std::cos(phi), std::sin(phi), 1e-3}));
        const bool near = at && before && std::hypot(at->x() - before->x(), at->y() - before->y()) < 0.3 * transform_.scale();
        if (at) near ? line.lineTo(*at) : line.moveTo(*at);
        before = at;
    }
    painter.setBrush(Qt::NoBrush);
    painter.setPen(QPen(QColor(0, 0, 0, 150), 2.5));
    painter.drawPath(line);
    QPen pen(QColor(255, 255, 255, 200), 1);
    pen.setDashPattern({4, 3});
    painter.setPen(pen);
    painter.drawPath(line);
}

void ProbeCanvas::paintDirections(QPainter& painter) {
    for (std::size_t i = 0; i < directions_.size(); ++i) {
        const Direction& direction = directions_[i];
        if (!shown_[static_cast<std::size_t>(direction.kind)]) continue;
        const auto at = positionOf(direction.towards);
        if (!at) continue;
        if (hoveredDirection_ == i) {
            painter.setBrush(Qt::NoBrush);
            painter.setPen(QPen(QColor(0, 0, 0, 190), 4));
            painter.drawEllipse(*at, kPickRadius + 1, kPickRadius + 1);
            painter.setPen(QPen(context_.colors().hover, 2));
            painter.drawEllipse(*at, kPickRadius + 1, kPickRadius + 1);
        }
        paintDirection(painter, *at, direction.kind, isSmall(direction.kind) ? kSmallMarkSize : kMarkSize, context_.colors());
    }
}

void ProbeCanvas::paintMarked(QPainter& painter) {
    const auto at = marked_ ? positionOf(*marked_) : std::nullopt;
    if (!at) return;
    for (const auto& pen : {QPen(QColor(0, 0, 0, 190), 4), QPen(context_.colors().selected, 2)}) {
        painter.setPen(pen);
        for (const QPointF arm : {QPointF(1, 0), QPointF(-1, 0), QPointF(0, 1), QPointF(0, -1)}) painter.drawLine(*at + arm * 4, *at + arm * 11);
    }
}

void ProbeCanvas::paintStale(QPainter& painter) {
    painter.setFont(context_.font());
    const QRectF words = painter.fontMetrics().boundingRect(stale_).adjusted(-12, -7, 12, 7);
    QRectF card(QPointF((width() - words.width()) / 2, (height() - words.height()) / 2), words.size());
    painter.setPen(QPen(context_.colors().border, 1));
    painter.setBrush(context_.colors().raised);
    painter.drawRoundedRect(card, 4, 4);
    painter.setPen(context_.colors().text);
    painter.drawText(card, Qt::AlignCenter, stale_);
}

std::optional<std::size_t> ProbeCanvas::directionAt(QPointF widget) const {
    std::optional<std::size_t> nearest;
    double best = kPickRadius;
    for (std::size_t i = 0; i < directions_.size(); ++i) {
        if (!stale_.isEmpty() || !shown_[static_cast<std::size_t>(directions_[i].kind)]) continue;
        const auto at = positionOf(directions_[i].towards);
        const double apart = at ? std::hypot(at->x() - widget.x(), at->y() - widget.y()) : best + 1;
        if (apart <= best) {   // of equally near ones the last, which is on top
            best = apart;
            nearest = i;
        }
    }
    return nearest;
}

void ProbeCanvas::setHovered(std::optional<QPointF> widget) {
    const auto before = hoveredDirection_;
    hovered_ = widget && probe_ ? view_.direction(transform_.toPlane(*widget)) : std::nullopt;
    hoveredDirection_ = widget && probe_ ? directionAt(*widget) : std::nullopt;
    if (before != hoveredDirection_) update();
    emit hoverChanged();
}

void ProbeCanvas::resizeEvent(QResizeEvent*) {
    transform_.setSizes(view_.size(), size());
    moved();
}

void ProbeCanvas::mousePressEvent(QMouseEvent* event) {
    if (event->button() == Qt::MiddleButton || (event->button() == Qt::LeftButton && (event->modifiers() & Qt::ControlModifier))) {
        panFrom_ = event->pos();
        setCursor(Qt::ClosedHandCursor);
    } else if (event->button() == Qt::LeftButton) {
        pressedAt_ = event->pos();
    }
}

void ProbeCanvas::mouseMoveEvent(QMouseEvent* event) {
    if (panFrom_) {
        transform_.pan(event->pos() - *panFrom_);
        panFrom_ = event->pos();
        moved();
    }
    setHovered(event->pos());
}

void ProbeCanvas::mouseReleaseEvent(QMouseEvent* event) {
    if (panFrom_ && event->button() != Qt::RightButton) {
        panFrom_.reset();
        setCursor(Qt::CrossCursor);
        return;
    }
    if (event->button() != Qt::LeftButton || !pressedAt_ || !probe_) return;
    const bool dragged = (event->pos() - pressedAt_->toPoint()).manhattanLength() > 4;
    pressedAt_.reset();
    if (dragged) return;
    if (const auto found = directionAt(event->pos())) {
        const Direction direction = directions_[*found];   // whoever listens may replace them
        emit directionClicked(direction);
    } else if (const auto direction = view_.direction(transform_.toPlane(event->pos()))) {
        setMarked(direction);
        emit markedByHand();
    }
}

void ProbeCanvas::mouseDoubleClickEvent(QMouseEvent* event) {
    pressedAt_.reset();
    if (event->button() == Qt::LeftButton && !directionAt(event->pos())) fit();
}

void ProbeCanvas::wheelEvent(QWheelEvent* event) {
    transform_.zoomBy(std::pow(1.0015, event->angleDelta().y()), event->position());
    moved();
    setHovered(event->position());
    event->accept();
}

void ProbeCanvas::leaveEvent(QEvent*) { setHovered(std::nullopt); }

/// Keys that mean something here are not those of the window while the probe has the focus.
bool ProbeCanvas::event(QEvent* event) {
    if (event->type() != QEvent::ShortcutOverride) return QWidget::event(event);
    const auto* key = static_cast<QKeyEvent*>(event);
    const bool plain = !(key->modifiers() & ~(Qt::ShiftModifier | Qt::KeypadModifier));
    constexpr int kOwn[] = {Qt::Key_F, Qt::Key_U, Qt::Key_A, Qt::Key_C, Qt::Key_L, Qt::Key_E, Qt::Key_S};
    const bool own = std::find(std::begin(kOwn), std::end(kOwn), key->key()) != std::end(kOwn) || (key->key() == Qt::Key_Escape && marked_);
    if (plain && own) event->accept();
    return QWidget::event(event);
}

void ProbeCanvas::keyPressEvent(QKeyEvent* event) {
    const QPointF middle(width() / 2.0, height() / 2.0);
    switch (event->key()) {
        case Qt::Key_Plus: case Qt::Key_Equal: transform_.zoomBy(1.25, middle); return moved();
        case Qt::Key_Minus: transform_.zoomBy(1 / 1.25, middle); return moved();
        case Qt::Key_0: case Qt::Key_Home: return fit();
        case Qt::Key_F:
            for (const Direction& direction : directions_)
                if (direction.kind == DirectionKind::outgoing || direction.kind == DirectionKind::emitter) return focusOn(direction.towards);
            return;
        case Qt::Key_Escape:
            if (marked_) {
                setMarked(std::nullopt);
                emit markedByHand();
                return;
            }
            break;
        default: break;
    }
    QWidget::keyPressEvent(event);
}

}  // namespace emca::light_probe
