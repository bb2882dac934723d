#include "plugin_entries.h"

EMCA_MITSUBA06_PLUGIN(emca::mitsuba06::makeObserver, "EMCA: a stock integrator, observed and served")
