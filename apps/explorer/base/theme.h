#pragma once

#include <QColor>
#include <QFont>
#include <QObject>

#include "emca/analysis/tone_map.h"

class QApplication;

namespace emca::explorer {

enum class ThemeKind { dark, light };

/// Colours by what they mean; the same meaning has the same colour in every view (docs: LOOK). The roles of paths stay
/// apart under protanopia, deuteranopia and tritanopia (theme_test measures it), dashes and shapes help.
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

/// Distances in device-independent pixels; everything is a multiple of 4.
struct Spacing {
    static constexpr int tiny = 4, small = 8, medium = 12, large = 16, huge = 24;
    static constexpr int row = 24;     ///< height of a row in trees and tables
    static constexpr int control = 26; ///< height of buttons and fields
    static constexpr int radius = 4;   ///< corner radius
};

/// The look of the program: owned by the application, outlives all views. GUI thread only.
class Theme : public QObject {
    Q_OBJECT
  public:
    explicit Theme(ThemeKind kind = ThemeKind::dark, QObject* parent = nullptr);

    ThemeKind kind() const { return kind_; }
    bool isDark() const { return kind_ == ThemeKind::dark; }
    const ThemeColors& colors() const { return colors_; }

    /// Text of the interface. Inter where it is installed, else the system's sans serif.
    QFont font() const;
    QFont smallFont() const;   ///< axis ticks, captions
    QFont strongFont() const;  ///< titles of panels, current values
    /// For columns of numbers: digits of equal width.
    QFont numberFont() const;
    QFont smallNumberFont() const;

    /// Does nothing if it is the current one.
    void setKind(ThemeKind kind);
    /// Sets palette, font and style sheet of the whole application; again after each change of kind.
    void applyTo(QApplication& application);

    /// How radiance becomes a colour of the screen, in the image and in every swatch: the image view sets it.
    const analysis::ToneMap& toneMap() const { return toneMap_; }
    void setToneMap(const analysis::ToneMap& toneMap);

  signals:
    /// colors() has changed; repaint.
    void themeChanged();
    /// toneMap() has changed; repaint swatches.
    void toneMapChanged();

  private:
    ThemeKind kind_;
    ThemeColors colors_;
    analysis::ToneMap toneMap_;
    QString family_, numberFamily_;
    QApplication* application_ = nullptr;
};

ThemeColors darkColors();
ThemeColors lightColors();

}  // namespace emca::explorer
