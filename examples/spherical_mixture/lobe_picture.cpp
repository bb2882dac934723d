#include "lobe_picture.h"

#include <QMouseEvent>
#include <QPainter>
#include <QPainterPath>
#include <algorithm>
#include <cmath>

#include "emca/analysis/statistics.h"
#include "emca/analysis/tone_map.h"

namespace mixture {

namespace {

constexpr std::uint32_t kWidth = 256, kHeight = 128;   ///< of the mixture's picture
constexpr double kTitle = 20, kGap = 8;                ///< pixels

Vec3d toDouble(emca::Vec3f v) { return {double(v.x), double(v.y), double(v.z)}; }
emca::Vec3f toFloat(Vec3d v) { return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)}; }

QImage colored(const emca::Image& image, const emca::analysis::ValueRange& range) {
    QImage picture(static_cast<int>(image.width()), static_cast<int>(image.height()), QImage::Format_RGBA8888);
    emca::analysis::falseColor(image, {}, emca::analysis::ColorMap::get(emca::analysis::ColorMapId::inferno), range,
                               {picture.bits(), static_cast<std::size_t>(picture.sizeInBytes())});
    return picture;
}

}  // namespace

QColor lobeColor(std::size_t lobe) {
    static const QColor colors[] = {{86, 180, 233}, {230, 159, 0}, {0, 158, 115}, {240, 228, 66}, {204, 121, 167}, {213, 94, 0}, {0, 114, 178}, {200, 200, 200}};
    return colors[lobe % std::size(colors)];
}

LobePicture::LobePicture(emca::explorer::PluginContext& context, QWidget* parent) : QWidget(parent), context_(context) {
    setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Expanding);
    setToolTip(tr("Rings: cones that hold half of a lobe. Click one to choose it.\nUp is the world's up, the middle looks back towards the camera."));
}

void LobePicture::clear() {
    lobes_.clear();
    above_ = below_ = QImage();
    update();
}

void LobePicture::show(const emca::probe::SphereFrame& frame, std::vector<Lobe> lobes, std::vector<WeightedDirection> directions,
                       const emca::probe::LightProbe* probe) {
    map_ = emca::probe::SphereMap(frame, kWidth, kHeight);
    lobes_ = std::move(lobes);
    directions_ = std::move(directions);
    current_.reset();
    // A mixture says what part of all light comes from a direction: times all light it is radiance again.
    double all = 1;
    if (probe) {
        all = 0;
        for (std::uint32_t y = 0; y < probe->map.height(); ++y)
            for (std::uint32_t x = 0; x < probe->map.width(); ++x) all += probe->map.solidAngle(y) * double(emca::luminance(probe->image.color({x, y})));
    }
    emca::Image mixture(kWidth, kHeight, {"Y"});
    for (std::uint32_t y = 0; y < kHeight; ++y)
        for (std::uint32_t x = 0; x < kWidth; ++x) *mixture.at({x, y}) = static_cast<float>(all * density(lobes_, toDouble(map_.direction({x + 0.5, y + 0.5}))));
    const auto values = emca::analysis::scalars(probe ? probe->image : mixture, {});
    emca::analysis::ValueRange range = emca::analysis::percentileRange(values, 0.01, 0.995, true);
    range.min = std::max(range.min, range.max * 1e-4);
    range = range.repaired();
    above_ = probe ? colored(probe->image, range) : QImage();
    below_ = colored(mixture, range);
    update();
}

void LobePicture::setCurrent(std::optional<std::size_t> lobe) {
    current_ = lobe;
    update();
}

QRectF LobePicture::area(bool below) const {
    const double room = (height() - kGap) / 2.0 - kTitle;
    const double w = std::min<double>(width(), 2 * room), h = w / 2;
    const double top = below ? height() / 2.0 + kGap / 2 : 0;
    return {(width() - w) / 2, top + kTitle, w, h};
}

QPointF LobePicture::place(const QRectF& area, Vec3d direction) const {
    const emca::Vec2d film = map_.film(toFloat(direction));
    return {area.left() + film.x / kWidth * area.width(), area.top() + film.y / kHeight * area.height()};
}

void LobePicture::paintEvent(QPaintEvent*) {
    QPainter painter(this);
    painter.setRenderHint(QPainter::Antialiasing);
    if (below_.isNull()) return;
    paintMap(painter, area(false), above_, above_.isNull() ? tr("Directions that paths took: %1").arg(directions_.size()) : tr("Luminance that arrives, logarithmic"));
    paintMap(painter, area(true), below_, tr("Mixture, same colours"));
    if (above_.isNull()) {
        for (const WeightedDirection& item : directions_) {
            painter.setPen(Qt::NoPen);
            painter.setBrush(QColor(255, 255, 255, 150));
            painter.drawEllipse(place(area(false), item.direction), 1.6, 1.6);
        }
    }
    for (std::size_t i = lobes_.size(); i-- > 0;) {
        paintCone(painter, area(false), i);
        paintCone(painter, area(true), i);
    }
}

void LobePicture::paintMap(QPainter& painter, const QRectF& where, const QImage& image, const QString& title) {
    painter.setFont(context_.smallFont());
    painter.setPen(context_.colors().mutedText);
    painter.drawText(QRectF(where.left(), where.top() - kTitle, where.width(), kTitle - 4), Qt::AlignLeft | Qt::AlignBottom, title);
    if (image.isNull()) painter.fillRect(where, QColor(20, 20, 20));
    else painter.drawImage(where, image);
}

/// Broken where the map is cut open.
void LobePicture::paintCone(QPainter& painter, const QRectF& where, std::size_t index) {
    const Lobe& lobe = lobes_[index];
    const auto around = emca::probe::SphereFrame::around(toFloat(lobe.mean), map_.frame().pole);
    const double half = coneOf(lobe.kappa, 0.5);
    QPainterPath ring;
    std::optional<QPointF> before;
    for (int i = 0; i <= 96; ++i) {
        const double phi = 2 * 3.14159265358979323846 * i / 96;
        const QPointF at = place(where, toDouble(around.toWorld({std::sin(half) * std::cos(phi), std::sin(half) * std::sin(phi), std::cos(half)})));
        const bool near = before && std::abs(at.x() - before->x()) < where.width() / 3;
        near ? ring.lineTo(at) : ring.moveTo(at);
        before = at;
    }
    const bool current = current_ == index;
    painter.setBrush(Qt::NoBrush);
    painter.setPen(QPen(QColor(0, 0, 0, 200), current ? 5 : 3.5));
    painter.drawPath(ring);
    painter.setPen(QPen(lobeColor(index), current ? 3 : 1.8));
    painter.drawPath(ring);
    painter.setPen(QPen(QColor(0, 0, 0, 200), 1));
    painter.setBrush(lobeColor(index));
    painter.drawEllipse(place(where, lobe.mean), current ? 5 : 3.5, current ? 5 : 3.5);
}

void LobePicture::mousePressEvent(QMouseEvent* event) {
    double best = 14;
    std::optional<std::size_t> nearest;
    for (const bool below : {false, true})
        for (std::size_t i = 0; i < lobes_.size(); ++i) {
            const QPointF at = place(area(below), lobes_[i].mean);
            const double apart = std::hypot(at.x() - event->pos().x(), at.y() - event->pos().y());
            if (apart >= best) continue;
            best = apart;
            nearest = i;
        }
    if (nearest) emit lobeClicked(*nearest);
}

}  // namespace mixture
