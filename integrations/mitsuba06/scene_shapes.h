#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

#include "emca/core/mesh.h"
#include "mitsuba_headers.h"
#include "nearest_face.h"

namespace emca::mitsuba06 {

/// Where on the meshes of a scene something is; mesh -1: on none of them.
struct SurfacePlace {
    std::int32_t mesh = -1, face = -1;
    explicit operator bool() const { return mesh >= 0 && face >= 0; }
};

/// The shapes of a scene as EMCA's meshes: triangle meshes as they are, others as Mitsuba tessellates them
/// (Shape::createTriMesh), instances as one mesh for each shape of their group. Shapes that cannot be tessellated have
/// none. World space, at the time when the shutter opens. Immutable, for any thread; the scene must outlive it.
class SceneShapes {
  public:
    explicit SceneShapes(mts::Scene& scene);

    const std::vector<Mesh>& meshes() const { return meshes_; }
    SurfacePlace place(const mts::Intersection& its) const;
    /// Of a point on a shape that is no instance, for example one that an emitter chose.
    SurfacePlace place(const mts::Shape* shape, const mts::Point& point) const;

  private:
    struct Entry {
        std::int32_t mesh;
        bool isTriMesh;                              ///< faces are those of Mitsuba
        std::unique_ptr<const NearestFace> nearest;  ///< where they are not, and for emitters
    };
    void add(mts::Shape& shape);
    void addInstance(mts::Shape& instance, mts::Float time);
    void add(const mts::Shape* instance, const mts::Shape& shape, Mesh mesh, bool isTriMesh);
    const Entry* find(const mts::Shape* instance, const mts::Shape* shape) const;

    std::vector<Mesh> meshes_;
    std::unordered_map<const mts::Shape*, Entry> entries_;                        ///< of shapes of the scene
    std::map<std::pair<const mts::Shape*, const mts::Shape*>, Entry> instanced_;  ///< (instance, shape)
};

/// The shapes of the group that an instance places in the scene; none if the shape is no instance.
std::vector<mts::Shape*> shapesOfInstance(mts::Shape& shape);

/// The ID that the scene file gives an object, else what kind of object it is. Valid as long as the object.
std::string_view nameOf(const mts::ConfigurableObject& object);
/// Name of a light: the shape's, if it is one's.
std::string nameOf(const mts::Emitter& emitter);
/// Name of a shape: its own (often the file's), else as above.
std::string nameOf(const mts::Shape& shape);

}  // namespace emca::mitsuba06
