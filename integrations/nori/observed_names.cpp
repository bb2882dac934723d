// Never linked. Compiled to assembly, from which observed_names.cmake reads what the linker calls these functions.
#include "nori_headers.h"

#define EMCA_ADDRESS(name, type, function) \
    extern "C" { __attribute__((used)) type emca_name_##name = &function; }

using AccelIntersect = bool (nori::Accel::*)(const nori::Ray3f&, nori::Intersection&, bool) const;
using MeshIntersect = bool (nori::Mesh::*)(uint32_t, const nori::Ray3f&, float&, float&, float&) const;

EMCA_ADDRESS(accel_intersect, AccelIntersect, nori::Accel::rayIntersect)
EMCA_ADDRESS(mesh_intersect, MeshIntersect, nori::Mesh::rayIntersect)
