#include "base/theme.h"

#include <gtest/gtest.h>

#include <QFontMetricsF>
#include <QRegularExpression>
#include <QSignalSpy>
#include <array>
#include <cmath>

#include "base/seen_on.h"
#include "base/style_sheet.h"

namespace emca::explorer {
namespace {

using Rgb = std::array<double, 3>;

double linear(double v) { return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4); }

Rgb linearOf(const QColor& color) { return {linear(color.redF()), linear(color.greenF()), linear(color.blueF())}; }

/// WCAG 2.1 contrast ratio.
double contrast(const QColor& a, const QColor& b) {
    const auto y = [](const QColor& c) {
        const Rgb v = linearOf(c);
        return 0.2126 * v[0] + 0.7152 * v[1] + 0.0722 * v[2];
    };
    const double high = std::max(y(a), y(b)), low = std::min(y(a), y(b));
    return (high + 0.05) / (low + 0.05);
}

/// Dichromat simulation in linear RGB. Source: Machado, Oliveira and Fernandes 2009, table 1, severity 1.0.
constexpr std::array<std::array<double, 9>, 4> kVision{{
    {1, 0, 0, 0, 1, 0, 0, 0, 1},
    {0.152286, 1.052583, -0.204868, 0.114503, 0.786281, 0.099216, -0.003882, -0.048116, 1.051998},
    {0.367322, 0.860646, -0.227968, 0.280085, 0.672501, 0.047413, -0.011820, 0.042940, 0.968881},
    {1.255528, -0.076749, -0.178779, -0.078411, 0.930809, 0.147602, 0.004733, 0.691367, 0.303900},
}};

/// CIE L*a*b* under D65 of a colour as a person with that vision sees it.
Rgb labOf(const QColor& color, const std::array<double, 9>& m) {
    const Rgb in = linearOf(color);
    Rgb v{};
    for (std::size_t i = 0; i < 3; ++i)
        v[i] = std::max(0.0, m[3 * i] * in[0] + m[3 * i + 1] * in[1] + m[3 * i + 2] * in[2]);
    const Rgb xyz{(0.4124 * v[0] + 0.3576 * v[1] + 0.1805 * v[2]) / 0.9505, 0.2126 * v[0] + 0.7152 * v[1] + 0.0722 * v[2],
                  (0.0193 * v[0] + 0.1192 * v[1] + 0.9505 * v[2]) / 1.089};
    const auto f = [](double t) { return t > 0.008856 ? std::cbrt(t) : 7.787 * t + 16.0 / 116; };
    return {116 * f(xyz[1]) - 16, 500 * (f(xyz[0]) - f(xyz[1])), 200 * (f(xyz[1]) - f(xyz[2]))};
}

double difference(const Rgb& a, const Rgb& b) { return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]); }

TEST(Theme, TextIsReadableOnEverySurface) {
    for (const ThemeColors& c : {darkColors(), lightColors()}) {
        for (const QColor& surface : {c.ground, c.panel, c.raised, c.selectedRow}) {
            EXPECT_GE(contrast(c.text, surface), 7.0) << surface.name().toStdString();
        }
        for (const QColor& surface : {c.ground, c.panel, c.raised, c.selectedRow}) EXPECT_GE(contrast(c.mutedText, surface), 4.5) << surface.name().toStdString();
        for (const QColor& surface : {c.ground, c.panel})
            for (const QColor& text : {c.warning, c.error, c.success})
                EXPECT_GE(contrast(text, surface), 4.5) << text.name().toStdString() << " on " << surface.name().toStdString();
        EXPECT_GE(contrast(c.onAccent, c.accent), 4.5);
    }
}

/// How a role is drawn besides its colour: who cannot tell two colours apart sees it from the shape.
enum class Shape { solid, dashed, ring };

struct Role {
    const char* name;
    QColor color;
    Shape shape = Shape::solid;
};

/// The pair that is closest, over all kinds of vision, among those of the same shape.
void expectApart(const std::vector<Role>& roles, double least) {
    for (std::size_t vision = 0; vision < kVision.size(); ++vision)
        for (std::size_t i = 0; i < roles.size(); ++i)
            for (std::size_t j = i + 1; j < roles.size(); ++j) {
                if (roles[i].shape != roles[j].shape) continue;
                EXPECT_GE(difference(labOf(roles[i].color, kVision[vision]), labOf(roles[j].color, kVision[vision])), least)
                    << roles[i].name << " and " << roles[j].name << ", vision " << vision;
            }
}

TEST(Theme, PathsAreSeenOnTheScenesGround) {
    for (const ThemeColors& c : {darkColors(), lightColors()})
        for (const QColor& ground : {c.sceneTop, c.sceneBottom, c.ground})
            for (const Role& role : {Role{"path", c.path}, Role{"current segment", c.currentSegment}, Role{"emitter", c.emitter}, Role{"visible", c.nextEventVisible},
                                     Role{"occluded", c.nextEventOccluded}, Role{"selected", c.selected}, Role{"hover", c.hover}})
                EXPECT_GE(contrast(role.color, ground), 2.5) << role.name << " on " << ground.name().toStdString();
}

TEST(Theme, ColoursOfMapsAreMadeToBeSeenAndKeepTheirHue) {
    for (const ThemeColors& c : {darkColors(), lightColors()})
        for (std::size_t id = 0; id < analysis::kColorMapCount; ++id)
            for (const analysis::Color8 entry : analysis::ColorMap::get(static_cast<analysis::ColorMapId>(id)).entries()) {
                const analysis::Color8 seen = seenOn(entry, c.sceneBottom);
                const QColor before(entry.r, entry.g, entry.b), after(seen.r, seen.g, seen.b);
                EXPECT_GE(contrast(after, c.sceneBottom), 2.1) << before.name().toStdString();
                if (contrast(before, c.sceneBottom) >= 2.2) {
                    EXPECT_EQ(after, before) << "what is seen already stays";
                } else if (before.hslSaturation() > 60 && after.hslSaturation() > 60) {
                    const int apart = std::abs(before.hslHue() - after.hslHue());
                    EXPECT_LE(std::min(apart, 360 - apart), 20) << before.name().toStdString() << " became " << after.name().toStdString();
                }
            }
}

// CIE 1976 distances: about 2.3 can just be seen side by side; lines and dots that are far from each other need more.
TEST(Theme, PathRolesStayApartForEveryColourVision) {
    for (const ThemeColors& c : {darkColors(), lightColors()})
        expectApart({{"path", c.path}, {"current segment", c.currentSegment}, {"emitter", c.emitter}, {"visible", c.nextEventVisible},
                     {"selected", c.selected}, {"occluded", c.nextEventOccluded, Shape::dashed}, {"hover", c.hover, Shape::ring}}, 15);
}

TEST(Theme, SelectedPointsStandOutOfEveryChannelForEveryColourVision) {
    for (const ThemeColors& c : {darkColors(), lightColors()})
        for (const Role& channel : {Role{"red", c.red}, Role{"green", c.green}, Role{"blue", c.blue}, Role{"alpha", c.alpha},
                                    Role{"luminance", c.luminance}, Role{"data", c.data}})
            expectApart({channel, {"selected", c.selected}}, 15);
}

TEST(Theme, AxesAndStatesStayApartForEveryColourVision) {
    for (const ThemeColors& c : {darkColors(), lightColors()}) {
        expectApart({{"x", c.axisX}, {"y", c.axisY}, {"z", c.axisZ}}, 15);
        expectApart({{"success", c.success}, {"warning", c.warning}, {"error", c.error}}, 10);   // words beside them
    }
}

TEST(Theme, SwitchingTellsOnceAndOnlyOnAChange) {
    Theme theme(ThemeKind::dark);
    QSignalSpy spy(&theme, &Theme::themeChanged);
    theme.setKind(ThemeKind::dark);
    EXPECT_EQ(spy.count(), 0);
    theme.setKind(ThemeKind::light);
    EXPECT_EQ(spy.count(), 1);
    EXPECT_EQ(theme.colors().ground, lightColors().ground);
}

TEST(Theme, StyleSheetNamesNoUnknownColour) {
    const QString sheet = styleSheet(darkColors());
    EXPECT_FALSE(sheet.contains("{text}"));
    EXPECT_EQ(sheet.count('{'), sheet.count('}'));
    EXPECT_FALSE(sheet.contains(QRegularExpression("\\{[a-zA-Z]+\\}")));
}

TEST(Theme, DigitsHaveEqualWidth) {
    const Theme theme;
    // Where Inter is installed its own tabular digits serve, not those of another font.
    if (theme.font().family() == "Inter") {
        EXPECT_EQ(theme.numberFont().family(), "Inter Tabular");
    }
    const QFontMetricsF metrics(theme.numberFont());
    for (char digit = '0'; digit <= '9'; ++digit)
        EXPECT_DOUBLE_EQ(metrics.horizontalAdvance(QLatin1Char(digit)), metrics.horizontalAdvance(QLatin1Char('0'))) << digit;
}

}  // namespace
}  // namespace emca::explorer
