#include "program/options.h"

#include <QFileInfo>
#include <QRegularExpression>

#include "base/qt_compat.h"

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
    if (QFileInfo(text).isFile()) {
        options.image = text;
        return {};
    }
    if (looksLikeImage(text) || text.contains('/'))
        return Error{ErrorCode::fileNotFound, ("The image \"" + text + "\" is not there; check its name.").toStdString()};
    const auto address = client::Address::parse(text.toStdString());
    if (!address) return address.error();
    options.address = *address;
    return {};
}

Result<void> setValue(Options& options, const QString& name, const QString& value) {
    if (name == "--pixel" && value == "firefly") {
        options.firefly = true;
    } else if (name == "--pixel") {
        const auto xy = twoNumbers(value, ",");
        if (!xy) return usageError("--pixel takes a column and a row like 12,34; \"" + value + "\" is none.");
        options.pixel = Pixel{static_cast<std::uint32_t>(xy->first), static_cast<std::uint32_t>(xy->second)};
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
    } else if (name == "--settings") {
        options.settings = value;
    } else {
        return usageError("The option " + name + " is unknown; --help lists all.");
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
    if (!options.tour.isEmpty() && !options.address && !options.help)
        return usageError("--tour shows a renderer at work: give its HOST:PORT.");
    return options;
}

QString usage() {
    return QStringLiteral(
        "emca-explorer [HOST:PORT] [IMAGE] [options]\n"
        "Shows the light paths behind the pixels of a renderer.\n\n"
        "  HOST:PORT            connect to a renderer, e.g. 127.0.0.1:50013\n"
        "  IMAGE                open an EXR, PFM, HDR or PNG file\n"
        "  --pixel X,Y          select a pixel; (0,0) is the top left; \"firefly\" finds the most striking one\n"
        "  --spp N              samples per pixel of the first render\n"
        "  --screenshot OUT.png save a picture of the window when everything is drawn, and end\n"
        "  --tour DIR           save pictures of every view around the most striking path, and index.md, and end\n"
        "  --size WxH           size of the window\n"
        "  --theme dark|light\n"
        "  --settings FILE      layout, theme and addresses from this file\n\n"
        "Exit codes: 0 ok, 2 usage, 3 input, 4 connection, 5 server.\n");
}

int exitCode(const Error& error) { return error.code == ErrorCode::invalidArgument ? 2 : 3; }

}  // namespace emca::explorer
