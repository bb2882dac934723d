#include "parallel/parallel_canvas.h"

#include <QFontMetricsF>
#include <QResizeEvent>
#include <algorithm>

#include "base/theme.h"
#include "base/view_keys.h"

namespace emca::explorer {

ParallelCanvas::ParallelCanvas(ParallelAxes& axes, Theme& theme, QWidget* parent) : QWidget(parent), axes_(axes), theme_(theme) {
    setMouseTracking(true);
    setFocusPolicy(Qt::StrongFocus);
    setMinimumSize(200, 140);
    setAttribute(Qt::WA_OpaquePaintEvent);
    setViewKeys(*this, tr("Parallel coordinates"),
                {{"Left", tr("Axis to the left")}, {"Right", tr("Axis to the right")}, {"Shift+Left", tr("Move the axis to the left")},
                 {"Shift+Right", tr("Move the axis to the right")}, {"L", tr("Logarithmic axis")}, {"I", tr("Turn the axis upside down")},
                 {"Del", tr("Remove the axis")}, {"Ins", tr("Add an axis")}, {"Esc", tr("Clear the marks")}, {"Ctrl+C", tr("Copy the values")}});
    connect(&theme_, &Theme::themeChanged, this, [this] {
        forgetPictures();
        update();
    });
}

void ParallelCanvas::forgetPictures() { pictures_ = {}; }

void ParallelCanvas::reload() {
    drag_ = Drag::none;
    hovered_.reset();
    hoveredAxis_.reset();
    bubble_.clear();
    if (currentAxis_ && *currentAxis_ >= axes_.size()) currentAxis_.reset();
    selected_.erase(std::remove_if(selected_.begin(), selected_.end(), [&](Index p) { return p >= axes_.paths().pathCount(); }), selected_.end());
    if (current_ && *current_ >= axes_.paths().pathCount()) current_.reset();
    layoutFrame();
}

void ParallelCanvas::layoutFrame() {
    // Labels of ticks stand to the left of their axis, titles around it.
    const QFontMetricsF metrics(theme_.smallNumberFont());
    const double ticks = metrics.horizontalAdvance(QStringLiteral("60,000")) + 14;
    double right = 34;
    if (axes_.size() > 0) right = std::clamp(metrics.horizontalAdvance(axes_[axes_.size() - 1].wish.expression) / 2 + 8, 34.0, 80.0);
    frame_ = ParallelFrame(QSizeF(size()), axes_.all(), std::max(ticks, 46.0), right);
    placeLines();
}

void ParallelCanvas::placeLines() {
    lines_.canvas = frame_.canvas();
    lines_.xs.clear();
    lines_.ys.assign(axes_.size(), {});
    const Index count = axes_.paths().pathCount();
    for (std::size_t i = 0; i < axes_.size(); ++i) {
        lines_.xs.push_back(frame_.x(i));
        lines_.ys[i].resize(count);
        for (Index path = 0; path < count; ++path) lines_.ys[i][path] = static_cast<float>(frame_.y(axes_[i], path));
    }
    forgetPictures();
    update();
}

void ParallelCanvas::setSelected(std::vector<Index> paths, std::optional<Index> current) {
    if (paths == selected_ && current == current_) return;
    if (paths != selected_) pictures_.markedFresh = false;
    selected_ = std::move(paths);
    current_ = current;
    update();
}

void ParallelCanvas::setHovered(std::optional<Index> path) {
    if (path == hovered_) return;
    hovered_ = path;
    update();
}

std::optional<std::size_t> ParallelCanvas::currentAxis() const {
    if (hoveredAxis_ && *hoveredAxis_ < axes_.size()) return hoveredAxis_;
    return currentAxis_;
}

void ParallelCanvas::setCurrentAxis(std::optional<std::size_t> axis) {
    currentAxis_ = axis;
    update();
}

void ParallelCanvas::toggleLog(std::size_t axis) {
    if (axis >= axes_.size() || axes_[axis].isText()) return;
    axes_.setLog(axis, !axes_[axis].wish.log);
    layoutFrame();
    emit axesChanged();
}

void ParallelCanvas::toggleFlipped(std::size_t axis) {
    if (axis >= axes_.size()) return;
    axes_.setFlipped(axis, !axes_[axis].wish.flipped);
    layoutFrame();
    emit axesChanged();
}

void ParallelCanvas::removeAxis(std::size_t axis) {
    if (axis >= axes_.size()) return;
    const bool marked = !axes_[axis].brushes.empty();
    axes_.remove(axis);
    hoveredAxis_.reset();
    if (currentAxis_ && (*currentAxis_ == axis || *currentAxis_ >= axes_.size())) currentAxis_.reset();
    layoutFrame();
    emit axesChanged();
    if (marked) emit brushed(true);
}

void ParallelCanvas::moveAxis(std::size_t from, std::size_t to) {
    if (from >= axes_.size() || to >= axes_.size() || from == to) return;
    axes_.move(from, to);
    currentAxis_ = to;
    hoveredAxis_.reset();
    layoutFrame();
    emit axesChanged();
}

void ParallelCanvas::resizeEvent(QResizeEvent* event) {
    QWidget::resizeEvent(event);
    layoutFrame();
}

QRectF ParallelCanvas::chipRect(std::size_t axis, Chip chip) const {
    constexpr double kWidths[] = {30, 22, 22}, kHeight = 18, kGap = 2;
    const QRectF header = frame_.header(axis);
    double x = std::clamp(frame_.x(axis) - (kWidths[0] + kWidths[1] + kWidths[2] + 2 * kGap) / 2, header.left(), header.right());
    for (int i = 0; i < int(chip); ++i) x += kWidths[i] + kGap;
    return {x, 22, kWidths[int(chip)], kHeight};
}

}  // namespace emca::explorer
