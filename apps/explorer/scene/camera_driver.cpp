#include "camera_driver.h"

#include <algorithm>
#include <utility>

namespace emca::explorer {
namespace {

constexpr double kFlightSeconds = 0.33;
constexpr double kStepsPerSecond = 14;    ///< of a key that is held
constexpr std::size_t kHistory = 64;

/// Letters fly as in games.
int arrowOf(int key) {
    switch (key) {
        case Qt::Key_W: return Qt::Key_Up;
        case Qt::Key_S: return Qt::Key_Down;
        case Qt::Key_A: return Qt::Key_Left;
        case Qt::Key_D: return Qt::Key_Right;
        case Qt::Key_E: return Qt::Key_PageUp;
        case Qt::Key_Q: return Qt::Key_PageDown;
        default: return key;
    }
}

}  // namespace

CameraDriver::CameraDriver(QObject* parent) : QObject(parent) {
    timer_.setInterval(12);
    timer_.setTimerType(Qt::PreciseTimer);
    connect(&timer_, &QTimer::timeout, this, [this] { tick(); });
}

void CameraDriver::setPose(const ViewPose& pose) {
    if (pose == pose_) return;
    pose_ = pose;
    emit poseChanged(pose_);
}

void CameraDriver::setAnimated(bool animated) {
    animated_ = animated;
    if (!animated && flying_) {
        flying_ = false;
        setPose(to_);
    }
}

void CameraDriver::moveTo(const ViewPose& pose) {
    flying_ = false;
    setPose(pose);
}

void CameraDriver::remember() {
    if (!history_.empty() && history_.back() == pose_) return;
    history_.push_back(pose_);
    if (history_.size() > kHistory) history_.erase(history_.begin());
}

void CameraDriver::flyTo(const ViewPose& pose) {
    if (pose == target()) return;
    if (!flying_) remember();   // steps of one flight that is redirected are one way back
    from_ = pose_;
    to_ = pose;
    flying_ = animated_;
    if (!animated_) return setPose(to_);
    departed_ = false;
    begin();
}

void CameraDriver::back() {
    if (history_.empty()) return;
    from_ = pose_;
    to_ = history_.back();
    history_.pop_back();
    flying_ = animated_;
    if (!animated_) return setPose(to_);
    departed_ = false;
    begin();
}

void CameraDriver::begin() {
    if (!timer_.isActive()) timer_.start();
    if (!wasMoving_) emit movingChanged(wasMoving_ = true);
}

bool CameraDriver::pressKey(int key, bool fast) {
    key = arrowOf(key);
    if (key != Qt::Key_Up && key != Qt::Key_Down && key != Qt::Key_Left && key != Qt::Key_Right &&
        key != Qt::Key_PageUp && key != Qt::Key_PageDown)
        return false;
    fast_ = fast;
    if (keys_.contains(key)) return true;
    if (keys_.isEmpty()) {
        if (flying_) moveTo(pose_);
        remember();
        keyClock_.start();
    }
    const QSet<int> held = keys_;
    keys_ = {key};
    step(1);
    keys_ = held;
    keys_.insert(key);
    begin();
    return true;
}

void CameraDriver::releaseKey(int key) { keys_.remove(arrowOf(key)); }

void CameraDriver::releaseAllKeys() { keys_.clear(); }

void CameraDriver::step(double amount) {
    const double s = amount * step_ * (fast_ ? 4 : 1);
    const auto axis = [&](int plus, int minus) { return s * (int(keys_.contains(plus)) - int(keys_.contains(minus))); };
    setPose(flown(pose_, axis(Qt::Key_Up, Qt::Key_Down), axis(Qt::Key_Right, Qt::Key_Left),
                  axis(Qt::Key_PageUp, Qt::Key_PageDown)));
}

void CameraDriver::tick() {
    if (flying_) {
        // Time counts from the first step: the frame that shows what is flown to comes before, however long it takes.
        if (!std::exchange(departed_, true)) clock_.start();
        const double t = static_cast<double>(clock_.nsecsElapsed()) * 1e-9 / kFlightSeconds;
        if (t >= 1) flying_ = false;
        setPose(between(from_, to_, eased(t)));
    } else if (!keys_.isEmpty()) {
        // However slow a frame is, one tick is at most a quarter of a second of flight.
        step(kStepsPerSecond * std::min(static_cast<double>(keyClock_.nsecsElapsed()) * 1e-9, 0.25));
    }
    keyClock_.restart();
    if (isMoving()) return;
    timer_.stop();
    emit movingChanged(wasMoving_ = false);
}

}  // namespace emca::explorer
