#include "base/theme.h"

#include <QApplication>
#include <QFontDatabase>
#include <QHash>
#include <QPalette>
#include <QStyleFactory>

#include "base/style_sheet.h"
#include "base/tabular_font.h"

/// Outside of the namespaces, as Qt's macro wants it: a static library's resources are registered by hand.
static void registerSymbols() { Q_INIT_RESOURCE(symbols); }

namespace emca::explorer {
namespace {

constexpr double kTextPixels = 13, kSmallPixels = 11;

QString installed(std::initializer_list<const char*> families, QFontDatabase::SystemFont fallback) {
    const QStringList there = QFontDatabase().families();
    for (const char* family : families)
        if (there.contains(QLatin1String(family))) return QLatin1String(family);
    return QFontDatabase::systemFont(fallback).family();
}

QFont fontOf(const QString& family, double pixels, QFont::Weight weight = QFont::Normal) {
    QFont font(family);
    font.setPixelSize(static_cast<int>(pixels));
    font.setWeight(weight);
    font.setHintingPreference(QFont::PreferNoHinting);
    return font;
}

/// A family with digits of equal width: a variant of the interface's own, else whatever has them.
QString numberFamilyFor(const QString& family) {
    // Registered once per process: themes come and go in tests.
    static QHash<QString, QString> known;
    if (const auto found = known.constFind(family); found != known.constEnd()) return *found;
    QString numbers = tabularFamily(fontOf(family, kTextPixels));
    if (numbers.isEmpty()) numbers = installed({"DejaVu Sans"}, QFontDatabase::FixedFont);
    else if (numbers != family) tabularFamily(fontOf(family, kTextPixels, QFont::DemiBold));
    return *known.insert(family, numbers);
}

QPalette paletteOf(const ThemeColors& c) {
    QPalette palette;
    palette.setColor(QPalette::Window, c.panel);
    palette.setColor(QPalette::WindowText, c.text);
    palette.setColor(QPalette::Base, c.ground);
    palette.setColor(QPalette::AlternateBase, c.panel);
    palette.setColor(QPalette::Text, c.text);
    palette.setColor(QPalette::PlaceholderText, c.mutedText);
    palette.setColor(QPalette::Button, c.raised);
    palette.setColor(QPalette::ButtonText, c.text);
    palette.setColor(QPalette::BrightText, c.error);
    palette.setColor(QPalette::ToolTipBase, c.raised);
    palette.setColor(QPalette::ToolTipText, c.text);
    palette.setColor(QPalette::Highlight, c.accent);
    palette.setColor(QPalette::HighlightedText, c.onAccent);
    palette.setColor(QPalette::Link, c.accent);
    palette.setColor(QPalette::Light, c.hoverSurface);
    palette.setColor(QPalette::Midlight, c.raised);
    palette.setColor(QPalette::Mid, c.border);
    palette.setColor(QPalette::Dark, c.border);
    palette.setColor(QPalette::Shadow, c.ground);
    for (const auto role : {QPalette::WindowText, QPalette::Text, QPalette::ButtonText}) {
        QColor disabled = c.mutedText;
        disabled.setAlphaF(0.55f);
        palette.setColor(QPalette::Disabled, role, disabled);
    }
    return palette;
}

}  // namespace

ThemeColors darkColors() {
    ThemeColors c;
    c.ground = "#1e1f22";
    c.panel = "#2b2d30";
    c.raised = "#383b3f";
    c.hoverSurface = "#43464b";
    c.border = "#3c3f43";
    c.grid = "#303236";
    c.sceneTop = "#26282b";
    c.sceneBottom = "#18191b";
    c.mesh = "#b9b4ac";
    c.meshBack = "#8a93a3";
    c.text = "#dfe1e5";
    c.mutedText = "#abaeb6";
    c.accent = "#5b9bf8";
    c.onAccent = "#101418";
    c.selectedRow = "#33425a";
    c.warning = "#f2b04b";
    c.error = "#f2716b";
    c.success = "#6cc08b";
    c.path = "#f4f4f2";
    c.currentSegment = "#2fd07a";
    c.emitter = "#ffe14d";
    c.nextEventVisible = "#4aa3ff";
    c.nextEventOccluded = "#f0504a";
    c.selected = "#ff9124";
    c.hover = "#fdf6e3";
    c.halo = "#0c0d0e";
    c.axisX = "#e5686a";
    c.axisY = "#8fd06a";
    c.axisZ = "#5c92e0";
    c.red = "#e8496a";
    c.green = "#5fbf77";
    c.blue = "#5f9df5";
    c.alpha = "#b9bcc4";
    c.luminance = "#d5d7dc";
    c.data = "#8fb3e8";
    return c;
}

ThemeColors lightColors() {
    ThemeColors c;
    c.ground = "#ffffff";
    c.panel = "#f3f4f6";
    c.raised = "#ffffff";
    c.hoverSurface = "#e6e8ec";
    c.border = "#d3d6db";
    c.grid = "#e9ebee";
    c.sceneTop = "#fbfbfc";
    c.sceneBottom = "#eceef2";
    c.mesh = "#bdb8b0";
    c.meshBack = "#9aa6b8";
    c.text = "#1f2328";
    c.mutedText = "#5c636d";
    c.accent = "#2464d1";
    c.onAccent = "#ffffff";
    c.selectedRow = "#d6e4fb";
    c.warning = "#a45f00";
    c.error = "#c22f2c";
    c.success = "#1f7a45";
    c.path = "#3a3d42";
    c.currentSegment = "#0b8f4d";
    c.emitter = "#b29500";
    c.nextEventVisible = "#1f6fe0";
    c.nextEventOccluded = "#cf2a2a";
    c.selected = "#b25300";
    c.hover = "#7a5cff";
    c.halo = "#ffffff";
    c.axisX = "#98152a";
    c.axisY = "#4c8a2b";
    c.axisZ = "#2f65c0";
    c.red = "#a3122b";
    c.green = "#1f8f45";
    c.blue = "#2a67d6";
    c.alpha = "#6b7280";
    c.luminance = "#3b4048";
    c.data = "#3e6fb8";
    return c;
}

Theme::Theme(ThemeKind kind, QObject* parent)
    : QObject(parent), kind_(kind), colors_(kind == ThemeKind::dark ? darkColors() : lightColors()),
      family_(installed({"Inter", "Inter V", "Noto Sans", "DejaVu Sans"}, QFontDatabase::GeneralFont)),
      numberFamily_(numberFamilyFor(family_)) {}

QFont Theme::font() const { return fontOf(family_, kTextPixels); }
QFont Theme::smallFont() const { return fontOf(family_, kSmallPixels); }
QFont Theme::strongFont() const { return fontOf(family_, kTextPixels, QFont::DemiBold); }
QFont Theme::numberFont() const { return fontOf(numberFamily_, kTextPixels); }
QFont Theme::smallNumberFont() const { return fontOf(numberFamily_, kSmallPixels); }

void Theme::setKind(ThemeKind kind) {
    if (kind == kind_) return;
    kind_ = kind;
    colors_ = kind == ThemeKind::dark ? darkColors() : lightColors();
    if (application_) applyTo(*application_);
    emit themeChanged();
}

void Theme::setToneMap(const analysis::ToneMap& toneMap) {
    if (toneMap == toneMap_) return;
    toneMap_ = toneMap;
    emit toneMapChanged();
}

void Theme::applyTo(QApplication& application) {
    registerSymbols();
    application_ = &application;
    application.setStyle(QStyleFactory::create("Fusion"));
    application.setPalette(paletteOf(colors_));
    application.setFont(font());
    application.setStyleSheet(styleSheet(colors_));
}

}  // namespace emca::explorer
