#pragma once

/// The few places where Qt 5 and Qt 6 differ. Built with Qt 5.15; Qt 6 is meant to work through this header alone.

#include <QDropEvent>
#include <QKeyEvent>
#include <QMouseEvent>
#include <QString>
#include <QWheelEvent>
#include <string>
#include <string_view>

namespace emca::explorer {

#if QT_VERSION >= QT_VERSION_CHECK(6, 0, 0)
inline QPointF positionOf(const QMouseEvent& event) { return event.position(); }
inline QPoint globalPositionOf(const QMouseEvent& event) { return event.globalPosition().toPoint(); }
inline QPointF positionOf(const QDropEvent& event) { return event.position(); }
#else
inline QPointF positionOf(const QMouseEvent& event) { return event.localPos(); }
inline QPoint globalPositionOf(const QMouseEvent& event) { return event.globalPos(); }
inline QPointF positionOf(const QDropEvent& event) { return event.posF(); }
#endif
inline QPointF positionOf(const QWheelEvent& event) { return event.position(); }

/// Redo differs between desktops; the window takes all of them.
inline bool isUndoKey(const QKeyEvent& event) {
    return event.key() == Qt::Key_Z && (event.modifiers() == Qt::ControlModifier || event.modifiers() == (Qt::ControlModifier | Qt::ShiftModifier));
}

inline QString toQString(std::string_view text) { return QString::fromUtf8(text.data(), static_cast<int>(text.size())); }

}  // namespace emca::explorer
