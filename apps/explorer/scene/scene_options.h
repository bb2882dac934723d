#pragma once

#include <cstdint>

#include "clip_plane.h"
#include "path_coloring.h"

namespace emca::explorer {

/// Surfaces that turn their back on the viewer: the near walls of a room seen from outside, the insides of objects.
enum class BackFaces : std::uint8_t { show = 0, fade = 1, hide = 2 };
enum class PathChoice : std::uint8_t { all = 0, selected = 1, none = 2 };
/// Whose next-event estimation is drawn.
enum class NextEventChoice : std::uint8_t { none = 0, currentVertex = 1, currentPath = 2, selectedPaths = 3, allPaths = 4 };

/// Everything a person can change in the 3D view. A plain value: the options panel edits one, sessions may keep it.
struct SceneOptions {
    float surfaceOpacity = 0.25f;               ///< in [0, 1]; 1 is opaque
    BackFaces backFaces = BackFaces::fade;
    bool ownColors = true;                      ///< the meshes' own colours, subdued; false: plain clay
    bool edges = true;                          ///< creases and borders
    ClipChoice clip;
    bool fullDetail = false;                    ///< draw every triangle, even if a frame then takes seconds

    PathChoice paths = PathChoice::all;
    NextEventChoice nextEvents = NextEventChoice::currentPath;
    /// With a vertex selected: the whole path, or only the rays into it and out of it.
    bool wholePath = true, incoming = true, outgoing = true;
    float lineWidth = 2;                        ///< pixels; selected paths get 1.75 times that
    float pathOpacity = 1;                      ///< in [0, 1], of paths that are not selected
    PathColorStyle colors;
    bool arrows = true;
    bool depthLabels = true;
    std::uint32_t maximumPaths = 4096;          ///< drawn at once, evenly chosen; selected ones always

    bool cameraGlyph = true;
    bool lightGlyphs = true;
    bool axes = true;                           ///< the world's axes in a corner
    bool legend = true;
    bool orthographic = false;
    bool depthPeeling = false;                  ///< exact translucency, several times as slow in software
    bool smoothEdges = true;                    ///< anti-aliasing of surfaces (FXAA)
    bool flyToSelection = true;
    bool animate = true;                        ///< false: the camera jumps, for tests and pictures
    friend bool operator==(const SceneOptions&, const SceneOptions&) = default;
};

}  // namespace emca::explorer
