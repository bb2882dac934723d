#pragma once

#include <QFont>
#include <QObject>

#include "emca/analysis/tone_map.h"
#include "emca/explorer/look.h"

class QApplication;

namespace emca::explorer {

enum class ThemeKind { dark, light };

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
