#pragma once

#include <QSize>
#include <QString>
#include <QStringList>
#include <optional>

#include "base/theme.h"
#include "emca/client/connection.h"
#include "emca/core/pixel.h"
#include "emca/core/result.h"
#include "emca/core/vector.h"
#include "scene/surface_style.h"

namespace emca::explorer {

/// What the 3D view shall show; what is not given stays as it is.
struct SceneWishes {
    std::vector<std::string> layers;     ///< 3D data to collect while rendering; the one word "all": every one that there is
    std::string showLayer;               ///< the one that colours the scene, "none" for none; empty: the first collected
    std::optional<SurfaceLimits> range;  ///< of the colours
    std::optional<SurfaceLimits> percentiles;  ///< in percent of the area, if there is no range
    bool log = false;
    std::optional<analysis::ColorMapId> map;
    std::optional<float> exposure;       ///< of colour layers, in stops
    std::optional<float> opacity;        ///< of the surfaces, in [0, 1]
    std::optional<bool> paths;
    std::optional<Vec3d> eye, target;    ///< where the view is and where it looks; world space
    std::optional<double> fieldOfView;   ///< vertical, degrees
};

/// What was asked for on the command line.
struct Options {
    std::optional<client::Address> address;
    QString image, session;              ///< files to open; empty for none
    QString reference;                   ///< image file to compare with; empty for none
    QString compare;                     ///< "image", "reference", "split", or a name of analysis::ImageMetric
    std::optional<Pixel> pixel;
    std::optional<PixelRect> region;     ///< in place of a pixel
    bool firefly = false;                ///< the most striking pixel in place of a given one, and its outlier path
    QString screenshot;                  ///< PNG to write, then end; empty: stay open
    QString tour;                        ///< folder for pictures and index.md, then end; empty: stay open
    QSize size;                          ///< invalid: as it was left
    std::optional<ThemeKind> theme;
    std::uint32_t samplesPerPixel = 0;   ///< 0: the scene's
    QString settings;                    ///< file in place of the person's settings
    SceneWishes scene;
    QStringList front;                   ///< docks whose tabs come to the front, by the names of the saved layout
    QStringList plugins;                 ///< files, besides those of the folders
    bool withoutPlugins = false;         ///< not even those of the folders
    bool onlyScene = false;              ///< the screenshot is one of the 3D view alone
    bool help = false;
    bool unattended() const { return !screenshot.isEmpty() || !tour.isEmpty(); }
};

/// \param arguments  without the program's name
/// Errors: invalidArgument (usage), fileNotFound (a file that is not there).
Result<Options> parseOptions(const QStringList& arguments);
QString usage();

/// Exit code of DESIGN.md for an error of parseOptions: 2 usage, 3 input.
int exitCode(const Error& error);

}  // namespace emca::explorer
