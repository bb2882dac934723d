// A plugin of a later time: it must be refused before anything of it is called.
#include <cstdlib>

#include "emca/explorer/plugin.h"

namespace {
QWidget* make(emca::explorer::PluginContext&) { std::abort(); }
}  // namespace

extern "C" EMCA_PLUGIN_EXPORT const emca::explorer::PluginEntry emca_explorer_plugin;
const emca::explorer::PluginEntry emca_explorer_plugin = {
    {'E', 'M', 'C', 'A', 'p', 'l', 'u', 'g'}, sizeof(emca::explorer::PluginEntry), 99, "9.9.9", QT_VERSION_STR, emca::explorer::binaryInterface(),
    0, "of-later", "Of later", "", emca::explorer::PluginPlace::tools, make};
