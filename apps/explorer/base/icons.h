#pragma once

#include <QIcon>

namespace emca::explorer {

class Theme;

/// The few symbols of the toolbar, drawn as lines in the theme's colours, so that they fit every theme and resolution.
enum class Icon { link, render, cancel, open, save, previous, next, focus, sun, moon };

QIcon icon(Icon symbol, const Theme& theme);

}  // namespace emca::explorer
