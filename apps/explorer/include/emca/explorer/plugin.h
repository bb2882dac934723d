#pragma once

#include <QtGlobal>
#include <cstddef>
#include <cstdint>

#include "emca/explorer/plugin_context.h"

class QWidget;

/// A plugin of the explorer is a shared library that exports one object, `emca_explorer_plugin`. The macro at the end of
/// this file makes it. docs/plugins.md leads through writing one.
namespace emca::explorer {

/// Raised with every change of this folder's headers that an older plugin does not survive.
inline constexpr std::uint32_t kPluginInterface = 1;
/// Types of EMCA cross the boundary as they are, so explorer and plugin must be of the same version.
inline constexpr const char* kEmcaVersion = "0.1.0";

/// Where the widget is put at first; a person may move it.
enum class PluginPlace : std::uint32_t {
    tools = 0,     ///< right edge, beside filter and outliers: narrow
    details = 1,   ///< below the 3D view, beside the intersection table
    plots = 2,     ///< beside the contribution plots
};

/// What differs between compilers, standard libraries and their settings, so that objects of one cannot be used by the
/// other.
constexpr const char* binaryInterface() {
#if defined(_LIBCPP_VERSION) && defined(__LP64__)
    return "itanium, libc++, 64 bit";
#elif defined(__GLIBCXX__) && defined(__LP64__) && defined(_GLIBCXX_DEBUG)
    return "itanium, libstdc++ with debug containers, 64 bit";
#elif defined(__GLIBCXX__) && defined(__LP64__) && _GLIBCXX_USE_CXX11_ABI
    return "itanium, libstdc++, 64 bit";
#elif defined(__GLIBCXX__) && defined(__LP64__)
    return "itanium, libstdc++ with strings of before C++11, 64 bit";
#else
    return "unknown";
#endif
}

/// Sizes of the types that cross the boundary, as one number: differs where a type has changed within a version.
constexpr std::uint64_t layoutOfSharedTypes() {
    std::uint64_t hash = 14695981039346656037ull;  // FNV-1a
    for (const std::size_t size :
         {sizeof(client::Dataset), sizeof(client::Selection), sizeof(client::Trace), sizeof(client::ServerInfo), sizeof(client::ImageEntry),
          sizeof(client::VertexId), sizeof(PathColumns), sizeof(Column), sizeof(NextEvent), sizeof(Contribution), sizeof(Mesh),
          sizeof(Camera), sizeof(SurfaceField), sizeof(RenderedImage), sizeof(Value), sizeof(Error), sizeof(SceneObject),
          sizeof(PlotAxis), sizeof(PlotSeries), sizeof(ThemeColors), sizeof(AskOptions), sizeof(analysis::ToneMap)})
        hash = (hash ^ size) * 1099511628211ull;
    return hash;
}

/// The exported object: plain data, read before anything of the plugin is called. The first three members keep their
/// place in all versions; a plugin whose other members do not fit is refused with a sentence and never called.
struct PluginEntry {
    char magic[8];                 ///< "EMCAplug"
    std::uint32_t bytes;           ///< sizeof(PluginEntry)
    std::uint32_t interfaceVersion;  ///< kPluginInterface
    const char* emca;              ///< kEmcaVersion
    const char* qt;                ///< QT_VERSION_STR: same major version, not newer than that of the explorer
    const char* binary;            ///< binaryInterface()
    std::uint64_t layout;          ///< layoutOfSharedTypes()
    const char* id;                ///< unique, lower case, e.g. "light-probe": names its settings and its dock
    const char* title;             ///< for people: tab and menu; UTF-8
    const char* summary;           ///< one sentence; UTF-8
    PluginPlace place;
    /// Makes the widget; the explorer owns it and deletes it before the context ends. May throw; null is refused.
    QWidget* (*make)(PluginContext& context);
};

}  // namespace emca::explorer

#if defined(_WIN32)
#define EMCA_PLUGIN_EXPORT __declspec(dllexport)
#else
#define EMCA_PLUGIN_EXPORT __attribute__((visibility("default")))
#endif

/// Once in one source file, outside of all namespaces:
///     EMCA_EXPLORER_PLUGIN("light-probe", "Light probe", "What a vertex sees in all directions.", PluginPlace::details, makeLightProbe)
/// \param make  a function QWidget*(PluginContext&)
#define EMCA_EXPLORER_PLUGIN(id, title, summary, place, make)                                                             \
    extern "C" EMCA_PLUGIN_EXPORT const ::emca::explorer::PluginEntry emca_explorer_plugin;                               \
    const ::emca::explorer::PluginEntry emca_explorer_plugin = {                                                          \
        {'E', 'M', 'C', 'A', 'p', 'l', 'u', 'g'}, sizeof(::emca::explorer::PluginEntry), ::emca::explorer::kPluginInterface, \
        ::emca::explorer::kEmcaVersion, QT_VERSION_STR, ::emca::explorer::binaryInterface(),                              \
        ::emca::explorer::layoutOfSharedTypes(), id, title, summary, ::emca::explorer::place, make};
