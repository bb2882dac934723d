#include "image/pixel_values.h"

#include <QCoreApplication>
#include <QStringList>

#include "base/qt_compat.h"
#include "emca/analysis/format.h"
#include "image/image_model.h"

namespace emca::explorer {
namespace {

using Ink = ValueLine::Ink;
using Value = ValueLine::Value;

Value valueOf(const QString& label, float value, Ink ink, bool mayBeNegative = false) {
    const std::string shown = analysis::formatNumber(double(value));
    return {label, toQString(shown), ink, analysis::isNonFiniteWord(shown) || (value < 0 && !mayBeNegative)};
}

/// A value of a channel that only renders and files of ours have.
std::optional<float> channelValue(const Image& image, std::string_view channel, Pixel pixel) {
    const int index = image.channelIndex(channel);
    if (index < 0 || !image.contains(pixel)) return std::nullopt;
    return image.at(pixel)[index];
}

std::vector<Value> colorValues(const Image& image, Pixel pixel, const ChannelSelect& select) {
    std::vector<Value> values;
    if (image.channelCount() >= 3) {
        const Color color = image.color(pixel);
        values = {valueOf("R", color.r, Ink::red), valueOf("G", color.g, Ink::green), valueOf("B", color.b, Ink::blue),
                  valueOf("Y", luminance(color), Ink::muted)};
    } else {
        for (std::uint32_t c = 0; c < image.channelCount(); ++c)
            values.push_back(valueOf(toQString(image.channels()[c]), image.at(pixel)[c], Ink::muted));
    }
    const bool listed = select.name == "R" || select.name == "G" || select.name == "B";
    if (select.kind == ChannelSelect::Kind::channel && !listed && image.channelCount() >= 3) {
        if (const auto value = channelValue(image, select.name, pixel)) values.push_back(valueOf(toQString(select.name), *value, Ink::muted, true));
    } else if (select.kind == ChannelSelect::Kind::layer) {
        const ResolvedChannel layer = resolve(select, image);
        const Ink inks[] = {Ink::red, Ink::green, Ink::blue};
        for (std::size_t i = 0; layer.picked && i < 3; ++i)
            values.push_back(valueOf(i == 0 ? toQString(select.name) : QString(), image.at(pixel)[layer.channels[i]], inks[i], true));
    }
    return values;
}

std::optional<float> samplesOf(const RenderedImage& image, Pixel pixel) {
    const auto samples = channelValue(image.samples, "samples", pixel);
    return samples ? samples : channelValue(image.color, "samples", pixel);
}

/// Variances of the channels, weighted as luminance weights the channels: one number for the eye.
std::optional<float> varianceOf(const RenderedImage& image, Pixel pixel) {
    if (image.variance.contains(pixel)) return luminance(image.variance.color(pixel));
    const auto r = channelValue(image.color, "variance.R", pixel), g = channelValue(image.color, "variance.G", pixel),
               b = channelValue(image.color, "variance.B", pixel);
    if (!r || !g || !b) return std::nullopt;
    return luminance(Color(*r, *g, *b));
}

std::vector<Value> spread(const RenderedImage& image, Pixel pixel) {
    std::vector<Value> values;
    // Number first, as people say it.
    if (const auto samples = samplesOf(image, pixel)) values.push_back({QString::number(static_cast<int>(*samples)), "spp", Ink::plain, false});
    if (const auto variance = varianceOf(image, pixel)) values.push_back(valueOf(QStringLiteral("σ²"), *variance, Ink::muted));
    return values;
}

}  // namespace

std::vector<ValueLine::Row> pixelRows(const ImageModel& model, Pixel pixel) {
    std::vector<ValueLine::Row> rows;
    const ImageDisplay& display = model.display();
    const auto tr = [](const char* text) { return QCoreApplication::translate("pixelRows", text); };
    if (!model.image()) return rows;
    const bool inImage = model.image()->color.contains(pixel), inReference = model.reference() && model.reference()->color.contains(pixel);
    if (!inImage && !inReference) return rows;
    rows.push_back({toQString(analysis::formatPixel(pixel)), false, {}, {}});
    if (inImage) {
        rows.back().values = colorValues(model.image()->color, pixel, display.channel);
        rows.back().remarks = spread(*model.image(), pixel);
    }
    const ImageContent& content = model.content();
    const bool computed = display.mode == ImageMode::difference || display.samplingError;
    std::optional<Value> shown;
    if (computed && content.values && content.values->contains(pixel) && !model.isComputing())
        shown = valueOf(toQString(display.quantity()), shownNumber(*content.values, pixel, display.channel), Ink::muted,
                        display.mode == ImageMode::difference);
    if (!model.reference()) {
        if (shown) rows.back().remarks = {*shown};
        return rows;
    }
    rows.push_back({tr("reference"), true, {}, {}});
    if (inReference) {
        rows.back().values = colorValues(model.reference()->color, pixel, display.channel);
        rows.back().remarks = shown ? std::vector<Value>{*shown} : spread(*model.reference(), pixel);
    }
    return rows;
}

QString pixelText(const ImageModel& model, Pixel pixel) {
    const auto line = [&](const RenderedImage& image) {
        QStringList parts;
        for (std::uint32_t c = 0; c < image.color.channelCount(); ++c)
            parts << QStringLiteral("%1 %2").arg(toQString(image.color.channels()[c]), toQString(analysis::formatFull(image.color.at(pixel)[c])));
        if (image.color.channelCount() >= 3) parts << QStringLiteral("Y %1").arg(toQString(analysis::formatFull(luminance(image.color.color(pixel)))));
        if (!image.samples.empty()) parts << QStringLiteral("samples %1").arg(static_cast<int>(*samplesOf(image, pixel)));
        return parts.join(QStringLiteral("  "));
    };
    if (!model.image() || !model.image()->color.contains(pixel)) return {};
    QString text = toQString(analysis::formatPixel(pixel)) + QStringLiteral("  ") + line(*model.image());
    if (model.reference() && model.reference()->color.contains(pixel))
        text += QStringLiteral("\n") + QCoreApplication::translate("pixelRows", "reference") + QStringLiteral("  ") + line(*model.reference());
    return text;
}

}  // namespace emca::explorer
