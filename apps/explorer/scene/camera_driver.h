#pragma once

#include <QElapsedTimer>
#include <QObject>
#include <QSet>
#include <QTimer>

#include <vector>

#include "view_pose.h"

namespace emca::explorer {

/// Moves the view: flights of a third of a second, keys that are held down, and the way back. Knows nothing of OpenGL.
class CameraDriver : public QObject {
    Q_OBJECT
  public:
    explicit CameraDriver(QObject* parent = nullptr);

    const ViewPose& pose() const { return pose_; }
    /// Where a flight ends; the pose itself if there is none.
    const ViewPose& target() const { return flying_ ? to_ : pose_; }
    bool isMoving() const { return flying_ || !keys_.isEmpty(); }

    void setAnimated(bool animated);
    /// Without flight and without a way back: drags, wheel.
    void moveTo(const ViewPose& pose);
    /// Eased; remembers where it came from. Does nothing if it is there already.
    void flyTo(const ViewPose& pose);
    /// To the pose before the last flight or drag.
    void back();
    bool canGoBack() const { return !history_.empty(); }
    /// The pose now is one that `back` returns to; called where a drag begins.
    void remember();

    /// World distance of one step of a key.
    void setStep(double step) { step_ = step; }
    /// Arrow keys and page keys, or W A S D and E Q in their place; true if the key is one of these. The first step comes at once.
    bool pressKey(int key, bool fast);
    void releaseKey(int key);
    void releaseAllKeys();

  signals:
    void poseChanged(const emca::explorer::ViewPose& pose);
    void movingChanged(bool moving);

  private:
    void tick();
    void step(double amount);
    void begin();
    void setPose(const ViewPose& pose);

    ViewPose pose_, from_, to_;
    std::vector<ViewPose> history_;
    bool flying_ = false, departed_ = false, animated_ = true, wasMoving_ = false, fast_ = false;
    double step_ = 0.05;
    QSet<int> keys_;
    QTimer timer_;
    QElapsedTimer clock_, keyClock_;
};

}  // namespace emca::explorer
