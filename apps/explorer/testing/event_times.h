#pragma once

#include <QApplication>
#include <QElapsedTimer>
#include <QEvent>
#include <QWidget>

#include <functional>
#include <map>
#include <string>
#include <vector>

namespace emca::explorer {

/// A QApplication that says where the time of its events went: whatever a widget does in an event counts for the view
/// that it is part of, without what other widgets did meanwhile.
class EventTimes : public QApplication {
  public:
    using QApplication::QApplication;

    /// What a widget counts for, asked once for each; an empty name: as its parent does.
    std::function<std::string(const QWidget&)> nameOf;
    std::map<std::string, double> milliseconds;   ///< exclusive, of each name; "" is everything else
    std::map<std::string, int> paints;            ///< paint events that widgets of the name got
    /// Called after each event that is not part of another one.
    std::function<void()> handled;

    void clear() {
        milliseconds.clear();
        paints.clear();
    }

    bool notify(QObject* receiver, QEvent* event) override {
        const std::string name = nameFor(receiver, *event);
        if (event->type() == QEvent::Paint) ++paints[name];
        QElapsedTimer clock;
        clock.start();
        inner_.push_back(0);
        const bool result = QApplication::notify(receiver, event);
        const double all = double(clock.nsecsElapsed()) * 1e-6;
        milliseconds[name] += all - inner_.back();
        inner_.pop_back();
        if (!inner_.empty()) inner_.back() += all;
        else if (handled) handled();
        return result;
    }

  private:
    std::string nameFor(const QObject* receiver, const QEvent& event) const {
        if (event.type() == QEvent::UpdateRequest) return "compose";
        for (const QObject* o = receiver; o && nameOf; o = o->parent())
            if (o->isWidgetType())
                if (std::string name = nameOf(*static_cast<const QWidget*>(o)); !name.empty()) return name;
        return {};
    }

    std::vector<double> inner_;
};

}  // namespace emca::explorer
