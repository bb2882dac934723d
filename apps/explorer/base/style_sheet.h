#pragma once

#include <QString>

#include "base/theme.h"

namespace emca::explorer {

/// Qt style sheet of the whole application for a set of colours.
QString styleSheet(const ThemeColors& colors);

}  // namespace emca::explorer
