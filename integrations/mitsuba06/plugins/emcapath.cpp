#include "plugin_entries.h"

EMCA_MITSUBA06_PLUGIN(emca::mitsuba06::makePathIntegrator, "EMCA: path tracer that records every value, served")
