#include "emca/explorer/plugin.h"
#include "mixture_panel.h"

static QWidget* makePanel(emca::explorer::PluginContext& context) { return new mixture::MixturePanel(context); }

EMCA_EXPLORER_PLUGIN("spherical-mixture", "Mixture", "Von Mises-Fisher lobes of the light that arrives at a vertex.", PluginPlace::details, makePanel)
