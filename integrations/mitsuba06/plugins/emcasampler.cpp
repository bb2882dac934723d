#include "plugin_entries.h"

EMCA_MITSUBA06_PLUGIN(emca::mitsuba06::makeSampler, "EMCA: independent samples, addressed by pixel and index")
