#pragma once

#include <QString>
#include <QVariant>
#include <QWidget>
#include <vector>

namespace emca::explorer {

/// A key that a view takes while it has the focus, for the list of keys.
struct ViewKey {
    QString keys;      ///< as QKeySequence reads it: "Shift+E"
    QString meaning;
};

/// Says which keys a widget's keyPressEvent() knows. The list of keys shows them under the title; a test presses each.
/// \param title  "Image"
inline void setViewKeys(QWidget& widget, const QString& title, const std::vector<ViewKey>& keys) {
    QStringList flat{title};
    for (const ViewKey& key : keys) flat << key.keys << key.meaning;
    widget.setProperty("viewKeys", flat);
}

/// Empty if it said none. \param title  is set if it is not null
inline std::vector<ViewKey> viewKeys(const QWidget& widget, QString* title = nullptr) {
    const QStringList flat = widget.property("viewKeys").toStringList();
    if (title && !flat.isEmpty()) *title = flat.front();
    std::vector<ViewKey> keys;
    for (int i = 1; i + 1 < flat.size(); i += 2) keys.push_back({flat[i], flat[i + 1]});
    return keys;
}

}  // namespace emca::explorer
