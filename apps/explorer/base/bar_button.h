#pragma once

#include <QString>
#include <QToolButton>

namespace emca::explorer {

/// A button of words in the bar above a view. It never takes the focus, so that the view's keys go on working.
inline QToolButton* barButton(const QString& text, const QString& tip) {
    auto* button = new QToolButton;
    button->setText(text);
    button->setToolTip(tip);
    button->setFocusPolicy(Qt::NoFocus);
    return button;
}

}  // namespace emca::explorer
