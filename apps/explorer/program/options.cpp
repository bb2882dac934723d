#include "program/options.h"

#include <QFileInfo>
#include <QRegularExpression>
#include <algorithm>
#include <cmath>

#include "base/qt_compat.h"
#include "emca/analysis/image_metrics.h"
#include "emca/client/session.h"

namespace emca::explorer {
namespace {

Error usageError(const QString& sentence) { return {ErrorCode::invalidArgument, sentence.toStdString()}; }

std::optional<std::pair<int, int>> twoNumbers(const QString& text, const QString& separator) {
    const QRegularExpressionMatch match = QRegularExpression("^(\\d{1,9})" + separator + "(\\d{1,9})$").match(text);
    if (!match.hasMatch()) return std::nullopt;
    return std::pair(match.captured(1).toInt(), match.captured(2).toInt());
}

bool looksLikeImage(const QString& text) {
    static const QStringList endings{"exr", "pfm", "hdr", "png", "tif", "tiff", "jpg", "jpeg"};
    return endings.contains(QFileInfo(text).suffix().toLower());
}

Result<void> setTarget(Options& options, const QString& text) {
    const bool session = QFileInfo(text).suffix().compare("emca", Qt::CaseInsensitive) == 0;
    if (QFileInfo(text).isFile()) {
        (session || client::isSession(text.toStdString()) ? options.session : options.image) = text;
        return {};
    }
    if (session) return Error{ErrorCode::fileNotFound, ("The session \"" + text + "\" is not there; check its name.").toStdString()};
    if (looksLikeImage(text) || text.contains('/'))
        return Error{ErrorCode::fileNotFound, ("The image \"" + text + "\" is not there; check its name.").toStdString()};
    const auto address = client::Address::parse(text.toStdString());
    if (!address) return address.error();
    options.address = *address;
    return {};
}

/// Numbers with commas between them: exactly as many as asked for, finite.
std::optional<std::vector<double>> numbers(const QString& text, int count) {
    const QStringList parts = text.split(',');
    if (parts.size() != count) return std::nullopt;
    std::vector<double> values;
    for (const QString& part : parts) {
        bool ok = false;
        values.push_back(part.trimmed().toDouble(&ok));
        if (!ok || !std::isfinite(values.back())) return std::nullopt;
    }
    return values;
}

Result<void> setPlace(std::optional<Vec3d>& place, const QString& name, const QString& value) {
    const auto xyz = numbers(value, 3);
    if (!xyz) return usageError(name + " takes a place like 0,1.5,-3; \"" + value + "\" is none.");
    place = Vec3d{(*xyz)[0], (*xyz)[1], (*xyz)[2]};
    return {};
}

Result<void> setLimits(std::optional<SurfaceLimits>& limits, const QString& name, const QString& value, double least, double most) {
    const auto ends = numbers(value, 2);
    if (!ends || !((*ends)[0] < (*ends)[1]) || (*ends)[0] < least || (*ends)[1] > most)
        return usageError(name + " takes two numbers, the lower one first, like 0.5,20; \"" + value + "\" is none.");
    limits = SurfaceLimits{(*ends)[0], (*ends)[1]};
    return {};
}

Result<void> setNumber(std::optional<float>& number, const QString& name, const QString& value, double least, double most) {
    const auto typed = numbers(value, 1);
    if (!typed || typed->front() < least || typed->front() > most)
        return usageError(name + QStringLiteral(" takes a number from %1 to %2; \"").arg(least).arg(most) + value + "\" is none.");
    number = static_cast<float>(typed->front());
    return {};
}

/// Options of the 3D view and its layers. False if it is none of them.
Result<bool> setSceneValue(Options& options, const QString& name, const QString& value) {
    SceneWishes& scene = options.scene;
    Result<void> done;
    if (name == "--layers") {
        for (const QString& layer : value.split(','))
            if (!layer.trimmed().isEmpty()) scene.layers.push_back(layer.trimmed().toStdString());
        if (scene.layers.empty()) done = usageError("--layers takes names of layers with commas between them, or all.");
    } else if (name == "--show-layer") {
        scene.showLayer = value.toStdString();
    } else if (name == "--layer-range") {
        done = setLimits(scene.range, name, value, -1e300, 1e300);
    } else if (name == "--layer-percentiles") {
        done = setLimits(scene.percentiles, name, value, 0, 100);
    } else if (name == "--layer-map") {
        scene.map = analysis::colorMapByName(value.toStdString());
        QStringList names;
        for (std::size_t i = 0; i < analysis::kColorMapCount; ++i) names += toQString(analysis::name(static_cast<analysis::ColorMapId>(i)));
        if (!scene.map) done = usageError("--layer-map is one of " + names.join(", ") + ", not \"" + value + "\".");
    } else if (name == "--layer-exposure") {
        done = setNumber(scene.exposure, name, value, -30, 30);
    } else if (name == "--opacity") {
        done = setNumber(scene.opacity, name, value, 0, 1);
    } else if (name == "--paths") {
        if (value != "0" && value != "1") done = usageError("--paths is 0 or 1, not \"" + value + "\".");
        scene.paths = value == "1";
    } else if (name == "--eye") {
        done = setPlace(scene.eye, name, value);
    } else if (name == "--target") {
        done = setPlace(scene.target, name, value);
    } else if (name == "--fov") {
        std::optional<float> degrees;
        done = setNumber(degrees, name, value, 1, 170);
        if (done) scene.fieldOfView = double(*degrees);
    } else if (name == "--only") {
        if (value != "scene") done = usageError("--only takes scene, not \"" + value + "\".");
        options.onlyScene = true;
    } else {
        return false;
    }
    if (!done) return done.error();
    return true;
}

Result<void> setComparison(Options& options, const QString& value) {
    QStringList known{"image", "reference", "split"};
    for (std::size_t m = 0; m < analysis::kImageMetricCount; ++m) known << toQString(analysis::name(static_cast<analysis::ImageMetric>(m)));
    if (!known.contains(value)) return usageError("--compare is one of " + known.join(", ") + ", not \"" + value + "\".");
    options.compare = value;
    return {};
}

Result<void> setValue(Options& options, const QString& name, const QString& value) {
    if (name == "--reference") {
        if (!QFileInfo(value).isFile())
            return Error{ErrorCode::fileNotFound, ("The reference \"" + value + "\" is not there; check its name.").toStdString()};
        options.reference = value;
        return {};
    }
    if (name == "--compare") return setComparison(options, value);
    if (name == "--pixel" && value == "firefly") {
        options.firefly = true;
    } else if (name == "--pixel") {
        const auto xy = twoNumbers(value, ",");
        if (!xy) return usageError("--pixel takes a column and a row like 12,34; \"" + value + "\" is none.");
        options.pixel = Pixel{static_cast<std::uint32_t>(xy->first), static_cast<std::uint32_t>(xy->second)};
    } else if (name == "--region") {
        const auto ends = numbers(value, 4);
        const bool whole = ends && std::ranges::all_of(*ends, [](double v) { return v >= 0 && v < 4e9 && v == std::floor(v); });
        if (whole) {
            const auto at = [&](std::size_t i) { return static_cast<std::uint32_t>((*ends)[i]); };
            options.region = PixelRect{at(0), at(1), at(2), at(3)};
        }
        if (!whole || options.region->empty())
            return usageError("--region takes the first column and row and those after the last, like 12,30,20,38; \"" + value + "\" is none.");
    } else if (name == "--size") {
        const auto size = twoNumbers(value, "x");
        if (!size || size->first < 640 || size->second < 400 || size->first > 8192 || size->second > 8192)
            return usageError("--size takes a width and a height from 640x400 to 8192x8192; \"" + value + "\" is none.");
        options.size = QSize(size->first, size->second);
    } else if (name == "--theme") {
        if (value != "dark" && value != "light") return usageError("--theme is dark or light, not \"" + value + "\".");
        options.theme = value == "light" ? ThemeKind::light : ThemeKind::dark;
    } else if (name == "--spp") {
        bool ok = false;
        const int samples = value.toInt(&ok);
        if (!ok || samples < 1 || samples > (1 << 20)) return usageError("--spp takes a number from 1 to 1048576; \"" + value + "\" is none.");
        options.samplesPerPixel = static_cast<std::uint32_t>(samples);
    } else if (name == "--screenshot") {
        options.screenshot = value;
    } else if (name == "--tour") {
        options.tour = value;
    } else if (name == "--front") {
        options.front = value.split(',');
    } else if (name == "--plugin") {
        options.plugins << value;
    } else if (name == "--settings") {
        options.settings = value;
    } else {
        const auto known = setSceneValue(options, name, value);
        if (!known) return known.error();
        if (!*known) return usageError("The option " + name + " is unknown; --help lists all.");
    }
    return {};
}

}  // namespace

Result<Options> parseOptions(const QStringList& arguments) {
    Options options;
    for (int i = 0; i < arguments.size(); ++i) {
        const QString& argument = arguments[i];
        Result<void> done;
        if (argument == "--help" || argument == "-h") {
            options.help = true;
        } else if (argument == "--no-plugins") {
            options.withoutPlugins = true;
        } else if (argument == "--layer-log") {
            options.scene.log = true;
        } else if (argument.startsWith("--") && argument.contains('=')) {
            done = setValue(options, argument.section('=', 0, 0), argument.section('=', 1));
        } else if (argument.startsWith("--")) {
            if (i + 1 >= arguments.size()) return usageError("The option " + argument + " needs a value; --help lists all.");
            done = setValue(options, argument, arguments[++i]);
        } else {
            done = setTarget(options, argument);
        }
        if (!done) return done.error();
    }
    if (!options.tour.isEmpty() && !options.address && options.session.isEmpty() && !options.help)
        return usageError("--tour shows a renderer at work, or a session: give HOST:PORT or a file.");
    if (options.onlyScene && options.screenshot.isEmpty() && !options.help)
        return usageError("--only scene says what --screenshot shows: give its file too.");
    if (!options.compare.isEmpty() && options.reference.isEmpty() && !options.help)
        return usageError("--compare says how an image and its --reference are shown: give the reference too.");
    // What shall be shown has to be collected.
    if (options.scene.layers.empty() && !options.scene.showLayer.empty() && options.scene.showLayer != "none")
        options.scene.layers = {options.scene.showLayer};
    return options;
}

QString usage() {
    return QStringLiteral(
        "emca-explorer [HOST:PORT] [SESSION] [IMAGE] [options]\n"
        "Shows the light paths behind the pixels of a renderer.\n\n"
        "  HOST:PORT            connect to a renderer, e.g. 127.0.0.1:50013\n"
        "  SESSION              open what was saved (.emca); needs no renderer\n"
        "  IMAGE                open an EXR, PFM, HDR or PNG file\n"
        "  --reference FILE     compare the image with this one\n"
        "  --compare HOW        show image, reference, split, or a metric: error, absolute error, squared error, …\n"
        "  --pixel X,Y          select a pixel; (0,0) is the top left; \"firefly\" finds the most striking one\n"
        "  --region X0,Y0,X1,Y1 select pixels together: columns from X0 to before X1, rows from Y0 to before Y1\n"
        "  --spp N              samples per pixel of the first render\n"
        "  --screenshot OUT.png save a picture of the window when everything is drawn, and end\n"
        "  --tour DIR           save pictures of every view around the most striking path, and index.md, and end\n"
        "  --size WxH           size of the window\n"
        "  --theme dark|light\n"
        "  --front NAME,NAME    bring these panels to the front, e.g. filter,plugin-intersection-data\n"
        "  --plugin FILE        load this plugin besides those of the folders; may be given several times\n"
        "  --no-plugins         load none, except those given by --plugin\n"
        "  --settings FILE      layout, theme and addresses from this file\n\n"
        "Data on surfaces and the 3D view:\n"
        "  --layers NAME,NAME   collect these layers in the first render; \"all\": every one that the renderer offers\n"
        "  --show-layer NAME    colour the scene by this layer, or by none; without it the first one collected\n"
        "  --layer-range LO,HI  values of the first and the last colour\n"
        "  --layer-percentiles LO,HI  the same by shares of the area in percent; 1,99 without it\n"
        "  --layer-log          logarithmic colours\n"
        "  --layer-map NAME     viridis, plasma, inferno, magma, turbo, cividis, grey, redGreen, blueOrange\n"
        "  --layer-exposure EV  of colour layers\n"
        "  --opacity X          of the surfaces, 0 to 1\n"
        "  --paths 0|1          draw the recorded paths and the camera, or not\n"
        "  --eye X,Y,Z          look from there …\n"
        "  --target X,Y,Z       … to there; without them as the renderer's camera\n"
        "  --fov DEGREES        vertical field of view\n"
        "  --only scene         the screenshot is one of the 3D view with its colour bar, --size pixels large\n\n"
        "Exit codes: 0 ok, 2 usage, 3 input, 4 connection, 5 server.\n");
}

int exitCode(const Error& error) { return error.code == ErrorCode::invalidArgument ? 2 : 3; }

}  // namespace emca::explorer
