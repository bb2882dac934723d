#include "parallel/line_pictures.h"

#include <QPainter>
#include <QPolygonF>
#include <algorithm>
#include <cmath>

#include "emca/analysis/parallel_axes.h"

namespace emca::explorer {
namespace {

QPolygonF lineOf(const LineField& field, std::size_t path) {
    QPolygonF line;
    line.reserve(int(field.xs.size()));
    for (std::size_t i = 0; i < field.xs.size(); ++i) line << QPointF(field.xs[i], double(field.ys[i][path]));
    return line;
}

/// Density between all neighbouring axes, into one picture of square cells.
class DensityPicture {
  public:
    DensityPicture(const LineField& field, std::optional<std::span<const Index>> paths, const QColor& color)
        : field_(field), paths_(paths), color_(color) {
        const std::size_t lines = paths ? paths->size() : field.lines();
        cell_ = lines > 16384 ? 2 : 1;
        width_ = cells(field.canvas.width());
        height_ = std::min<std::uint32_t>(cells(field.canvas.height()), 4096);
    }

    QImage make() {
        std::vector<analysis::LineDensity> gaps;
        std::vector<std::uint16_t> left = rows(0), right;
        std::uint32_t largest = 0;
        for (std::size_t i = 0; i + 1 < field_.xs.size(); ++i) {
            right = rows(i + 1);
            gaps.push_back(analysis::lineDensity(left, right, column(i + 1) - column(i), height_));
            largest = std::max(largest, gaps.back().largest);
            left.swap(right);
        }
        QImage image(int(width_), int(height_), QImage::Format_ARGB32_Premultiplied);
        image.setDevicePixelRatio(1.0 / cell_);
        image.fill(Qt::transparent);
        const std::vector<QRgb> tones = tonesUpTo(largest);
        for (std::size_t i = 0; i < gaps.size(); ++i) paint(gaps[i], column(i), tones, largest, image);
        return image;
    }

  private:
    std::uint32_t cells(double length) const { return static_cast<std::uint32_t>(std::max(1.0, std::ceil(length / cell_))); }
    std::uint32_t column(std::size_t axis) const {
        return std::min(width_, static_cast<std::uint32_t>(std::max(0.0, std::round(field_.xs[axis] / cell_))));
    }
    std::vector<std::uint16_t> rows(std::size_t axis) const {
        const std::vector<float>& ys = field_.ys[axis];
        std::vector<std::uint16_t> out(paths_ ? paths_->size() : ys.size());
        const float scale = 1.f / float(cell_), most = float(height_ - 1);
        for (std::size_t i = 0; i < out.size(); ++i)
            out[i] = static_cast<std::uint16_t>(std::clamp(ys[paths_ ? (*paths_)[i] : i] * scale, 0.f, most));
        return out;
    }
    /// Opacity by the logarithm of the count, in steps that nobody sees.
    static constexpr std::size_t kTones = 1024;
    std::vector<QRgb> tonesUpTo(std::uint32_t largest) const {
        std::vector<QRgb> tones(kTones + 1);
        const double scale = largest > 0 ? 1 / std::log1p(double(largest)) : 0;
        for (std::size_t i = 1; i <= kTones; ++i) {
            // The first tones stand for single counts, the last for equal steps of the logarithm.
            const double count = i <= kTones / 2 ? double(i) : std::expm1(std::log1p(double(largest)) * (double(i) / double(kTones)));
            const double alpha = std::min(1.0, 0.07 + 0.88 * std::pow(std::log1p(count) * scale, 1.4));
            tones[i] = qPremultiply(qRgba(color_.red(), color_.green(), color_.blue(), int(alpha * color_.alpha())));
        }
        return tones;
    }
    std::size_t toneOf(std::uint32_t count, double scale) const {
        if (count <= kTones / 2) return count;
        return std::clamp(static_cast<std::size_t>(std::log1p(double(count)) * scale * double(kTones)), kTones / 2, kTones);
    }
    void paint(const analysis::LineDensity& gap, std::uint32_t first, const std::vector<QRgb>& tones, std::uint32_t largest, QImage& image) const {
        const double scale = largest > 0 ? 1 / std::log1p(double(largest)) : 0;
        const int stride = image.bytesPerLine() / 4;
        auto* pixels = reinterpret_cast<QRgb*>(image.bits());
        for (std::uint32_t k = 0; k < gap.width; ++k)
            for (std::uint32_t row = 0; row < gap.height; ++row)
                if (const std::uint32_t count = gap.count(k, row)) pixels[std::ptrdiff_t(row) * stride + first + k] = tones[toneOf(count, scale)];
    }

    const LineField& field_;
    std::optional<std::span<const Index>> paths_;
    QColor color_;
    int cell_ = 1;   ///< pixels
    std::uint32_t width_ = 1, height_ = 1;
};

}  // namespace

double lineOpacity(std::size_t lines) { return lines <= 64 ? 0.8 : lines <= 256 ? 0.5 : lines <= 1024 ? 0.28 : 0.18; }

void drawLines(QPainter& painter, const LineField& field, std::span<const Index> paths, const QColor& color, double width) {
    painter.setPen(QPen(color, width));
    painter.setBrush(Qt::NoBrush);
    for (const Index path : paths)
        if (path < field.lines()) painter.drawPolyline(lineOf(field, path));
}

void drawAllLines(QPainter& painter, const LineField& field, const QColor& color, double width) {
    painter.setPen(QPen(color, width));
    painter.setBrush(Qt::NoBrush);
    for (std::size_t path = 0; path < field.lines(); ++path) painter.drawPolyline(lineOf(field, path));
}

QImage linePicture(const LineField& field, std::optional<std::span<const Index>> paths, const QColor& color, double ratio) {
    const std::size_t lines = paths ? paths->size() : field.lines();
    if (field.xs.size() < 2 || lines == 0) return {};
    if (lines > kMostLines) return DensityPicture(field, paths, color).make();
    QImage image((field.canvas * ratio).toSize().expandedTo(QSize(1, 1)), QImage::Format_ARGB32_Premultiplied);
    image.setDevicePixelRatio(ratio);
    image.fill(Qt::transparent);
    QPainter painter(&image);
    painter.setRenderHint(QPainter::Antialiasing);
    QColor ink = color;
    ink.setAlphaF(ink.alphaF() * lineOpacity(lines));
    if (paths) drawLines(painter, field, *paths, ink, 1);
    else drawAllLines(painter, field, ink, 1);
    return image;
}

std::optional<Index> lineAt(const LineField& field, QPointF position, double radius) {
    const auto right = std::upper_bound(field.xs.begin(), field.xs.end(), position.x());
    if (right == field.xs.begin() || right == field.xs.end()) return std::nullopt;
    const auto gap = static_cast<std::size_t>(right - field.xs.begin()) - 1;
    const double length = field.xs[gap + 1] - field.xs[gap], t = (position.x() - field.xs[gap]) / length;
    const std::vector<float>&a = field.ys[gap], &b = field.ys[gap + 1];
    std::optional<Index> best;
    double nearest = radius * radius;
    for (std::size_t i = 0; i < a.size(); ++i) {
        const double slope = (double(b[i]) - double(a[i])) / length, dy = double(a[i]) + t * length * slope - position.y();
        const double squared = dy * dy / (1 + slope * slope);   // perpendicular to the line
        if (squared > nearest) continue;
        nearest = squared;
        best = static_cast<Index>(i);
    }
    return best;
}

}  // namespace emca::explorer
