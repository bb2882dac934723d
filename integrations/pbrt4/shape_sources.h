#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "pbrt_headers.h"

namespace emca::pbrt4 {

/// Where a shape comes from: pbrt forgets it when it has made the shape.
struct ShapeSource {
    std::string type;     ///< "trianglemesh", "plymesh", "sphere", …
    std::string plyFile;  ///< as the scene calls it; empty if it is none
    std::string sceneFile;
    int line = 0, column = 0;
    /// For people: the PLY file's name, else type and line.
    std::string name() const;
};

/// What the scene's shapes were made of; filled by pbrt's threads while it makes them (hit_watch.h says how it is
/// seen).
class ShapeSources {
  public:
    /// Begins to listen. One at a time.
    ShapeSources();
    ~ShapeSources();
    ShapeSources(const ShapeSources&) = delete;
    ShapeSources& operator=(const ShapeSources&) = delete;

    /// Of what a shape belongs to: its mesh, or the shape itself where it has none. Null if it is not known.
    const ShapeSource* find(const pbrt::Shape& shape) const;

    /// What identifies the thing that a shape is a part of: triangles their mesh, segments their curve, others
    /// themselves.
    static const void* wholeOf(const pbrt::Shape& shape);

  private:
    friend struct WrappedShapes;
    struct Impl;
    Impl* impl_;
};

}  // namespace emca::pbrt4
