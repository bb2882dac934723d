#pragma once

#include <QColor>

namespace emca::explorer {

/// Colours by what they mean; the same meaning has the same colour in every view. The roles of paths stay apart under
/// protanopia, deuteranopia and tritanopia; dashes and shapes help.
struct ThemeColors {
    // Surfaces, from the back to the front.
    QColor ground;       ///< behind everything; canvas of image, plots and tree
    QColor panel;        ///< docks, toolbars, headers
    QColor raised;       ///< buttons, fields, menus
    QColor hoverSurface; ///< a row or button under the cursor
    QColor border;       ///< hairlines between surfaces
    QColor grid;         ///< lines inside plots: quieter than `border`
    QColor sceneTop, sceneBottom;  ///< background gradient of the 3D view
    QColor mesh, meshBack;         ///< matte clay, and the tint of back faces

    QColor text;
    QColor mutedText;    ///< labels, units, axis ticks
    QColor accent;       ///< focus, checked, progress: the one accent
    QColor onAccent;     ///< text on `accent`
    QColor selectedRow;  ///< background of a selected row, below `text`
    QColor warning;      ///< NaN, Inf, clipped, "different"
    QColor error;
    QColor success;      ///< "replay exact"

    // Paths.
    QColor path;
    QColor currentSegment;   ///< green
    QColor emitter;          ///< yellow: the segment into an emitter or the environment
    QColor nextEventVisible; ///< blue
    QColor nextEventOccluded;///< red; draw it dashed
    QColor selected;         ///< orange: selected vertices, selected points
    QColor hover;            ///< light ring
    QColor halo;             ///< thin dark (light theme: light) outline below lines and marks
    QColor axisX, axisY, axisZ;

    // Channels in plots.
    QColor red, green, blue, alpha, luminance;
    QColor data;             ///< a plot of a quantity without a colour of its own
};
/// One of them, whatever the theme is.
using ColorRole = QColor ThemeColors::*;

/// Distances in device-independent pixels; everything is a multiple of 4.
struct Spacing {
    static constexpr int tiny = 4, small = 8, medium = 12, large = 16, huge = 24;
    static constexpr int row = 24;     ///< height of a row in trees and tables
    static constexpr int control = 26; ///< height of buttons and fields
    static constexpr int radius = 4;   ///< corner radius
};

}  // namespace emca::explorer
