#include "emca/explorer/plugin.h"

#include "data_panel.h"

namespace {
QWidget* makePanel(emca::explorer::PluginContext& context) { return new emca::intersection_data::DataPanel(context); }
}  // namespace

EMCA_EXPLORER_PLUGIN("intersection-data", "Intersection data", "What the renderer recorded at the vertices of the selected path, over its depth.",
                     PluginPlace::details, makePanel)
