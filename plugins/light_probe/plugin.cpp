#include "emca/explorer/plugin.h"

#include "probe_panel.h"

static QWidget* makeLightProbe(emca::explorer::PluginContext& context) { return new emca::light_probe::ProbePanel(context); }

EMCA_EXPLORER_PLUGIN("light-probe", "Light probe", "What the selected vertex sees in all directions, and where paths went.", PluginPlace::details, makeLightProbe)
