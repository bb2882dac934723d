#include "scene_surfaces.h"

#include <algorithm>
#include <array>
#include <tuple>
#include <unordered_map>

#include "inside.h"

namespace emca::pbrt4 {

namespace {

/// Triangles in the space of what contains the shape.
struct LocalMesh {
    std::vector<pbrt::Point3f> positions;
    std::vector<Triangle> triangles;

    /// Triangles of a grid whose points are in this space; returns the number of the first.
    std::uint32_t add(const adapter::ParametricMesh& grid, const auto& pointAt) {
        const auto firstPosition = static_cast<std::uint32_t>(positions.size());
        const auto firstFace = static_cast<std::uint32_t>(triangles.size());
        const Mesh part = grid.mesh([&](Vec2f uv) {
            const pbrt::Point3f p = pointAt(uv);
            return Vec3f{p.x, p.y, p.z};
        });
        for (const Vec3f p : part.positions) positions.push_back({p.x, p.y, p.z});
        for (Triangle t : part.triangles) {
            for (std::uint32_t& corner : t) corner += firstPosition;
            triangles.push_back(t);
        }
        return firstFace;
    }
};

LocalMesh trianglesOf(const pbrt::TriangleMesh& mesh) {
    LocalMesh out;
    out.positions.assign(mesh.p, mesh.p + mesh.nVertices);
    out.triangles.reserve(std::size_t(mesh.nTriangles));
    for (int i = 0; i < mesh.nTriangles; ++i) {
        const int* v = &mesh.vertexIndices[3 * i];
        Triangle t{static_cast<std::uint32_t>(v[0]), static_cast<std::uint32_t>(v[1]),
                   static_cast<std::uint32_t>(v[2])};
        bool back = mesh.reverseOrientation != mesh.transformSwapsHandedness;
        if (mesh.n) {  // shading normals say which side is the front
            const pbrt::Vector3f normal = Cross(mesh.p[v[1]] - mesh.p[v[0]], mesh.p[v[2]] - mesh.p[v[0]]);
            back = Dot(normal, pbrt::Vector3f(mesh.n[v[0]] + mesh.n[v[1]] + mesh.n[v[2]])) < 0;
        }
        if (back) std::swap(t[1], t[2]);
        out.triangles.push_back(t);
    }
    return out;
}

adapter::ParametricMesh gridOfPatch(const pbrt::BilinearPatchMesh& mesh, const PatchCorners& corners) {
    adapter::ParametricMesh grid = gridOf(corners);
    grid.flipped = mesh.reverseOrientation != mesh.transformSwapsHandedness;
    return grid;
}

/// Calls `use` with the quadric in its own type; false if the shape is none.
bool withQuadric(const pbrt::Shape& shape, const auto& use) {
    if (const auto* sphere = shape.CastOrNullptr<pbrt::Sphere>()) return use(*sphere), true;
    if (const auto* disk = shape.CastOrNullptr<pbrt::Disk>()) return use(*disk), true;
    if (const auto* cylinder = shape.CastOrNullptr<pbrt::Cylinder>()) return use(*cylinder), true;
    return false;
}

/// What becomes one mesh wherever it is placed: a triangle mesh, the patches of a mesh, a quadric, or all curves of one
/// material (hair has a hundred thousand).
struct Group {
    const void* key;    ///< ShapeSources::wholeOf its first shape
    pbrt::Shape shape;  ///< that one
    pbrt::Material material;
    pbrt::Light light;  ///< its light; null if it emits nothing
    const ShapeSource* source;
    std::vector<const pbrt::CurveCommon*> curves;
    LocalMesh local;
    std::vector<std::uint32_t> firstFaces;  ///< of each patch
};

/// The primitives of the scene or of an instance definition.
struct Content {
    std::vector<std::uint32_t> groups;
    std::vector<pbrt::Primitive> placements;
};

/// A group in world space, before all are put in order.
struct Placed {
    std::uint32_t group;
    pbrt::Transform renderFromGroup;
    HitChain chain;
};

struct PlaceKey {
    const void* group;
    const void* outer;
    const void* inner;
    friend bool operator==(const PlaceKey&, const PlaceKey&) = default;
};
PlaceKey keyOf(const Group& group, const HitChain& chain) {
    return {group.key, chain.instances[0].ptr(), chain.instances[1].ptr()};
}
struct PlaceHash {
    std::size_t operator()(const PlaceKey& key) const {
        const auto mix = [](std::size_t h, const void* p) {
            return (h ^ reinterpret_cast<std::size_t>(p)) * 0x9e3779b97f4a7c15ull;
        };
        return mix(mix(mix(0, key.group), key.outer), key.inner) >> 7;
    }
};

/// Where it comes from, then where it is: the same in every run.
auto order(const Group& group, const Placed& placed) {
    static const ShapeSource kUnknown{.sceneFile = "\xff"};
    const ShapeSource& source = group.source ? *group.source : kUnknown;
    std::array<float, 16> matrix;
    for (int i = 0; i < 16; ++i) matrix[std::size_t(i)] = placed.renderFromGroup.GetMatrix()[i / 4][i % 4];
    std::array<float, 3> first{};
    if (!group.local.positions.empty())
        first = {group.local.positions[0].x, group.local.positions[0].y, group.local.positions[0].z};
    return std::tuple(std::string_view(source.sceneFile), source.line, source.column, group.shape.Tag(),
                      group.local.triangles.size(), first, matrix);
}

const char* typeName(const pbrt::Material& material) {
    if (material.Is<pbrt::CoatedDiffuseMaterial>()) return "coateddiffuse";
    if (material.Is<pbrt::CoatedConductorMaterial>()) return "coatedconductor";
    if (material.Is<pbrt::ConductorMaterial>()) return "conductor";
    if (material.Is<pbrt::DielectricMaterial>()) return "dielectric";
    if (material.Is<pbrt::DiffuseMaterial>()) return "diffuse";
    if (material.Is<pbrt::DiffuseTransmissionMaterial>()) return "diffusetransmission";
    if (material.Is<pbrt::HairMaterial>()) return "hair";
    if (material.Is<pbrt::MeasuredMaterial>()) return "measured";
    if (material.Is<pbrt::SubsurfaceMaterial>()) return "subsurface";
    if (material.Is<pbrt::ThinDielectricMaterial>()) return "thindielectric";
    return material.Is<pbrt::MixMaterial>() ? "mix" : "material";
}

const char* typeName(const pbrt::Light& light) {
    if (light.Is<pbrt::PointLight>()) return "point light";
    if (light.Is<pbrt::DistantLight>()) return "distant light";
    if (light.Is<pbrt::ProjectionLight>()) return "projection light";
    if (light.Is<pbrt::GoniometricLight>()) return "goniometric light";
    if (light.Is<pbrt::SpotLight>()) return "spot light";
    return light.Is<pbrt::DiffuseAreaLight>() ? "area light" : "infinite light";
}

constexpr int kPreviewWavelengths = 8, kPreviewSamples = 16;

/// Rough colours for display: of a point on the first shape of a group.
class Preview {
  public:
    explicit Preview(const pbrt::Camera& camera) : camera_(camera), colors_(camera.GetFilm()) {}

    Color reflectance(const Group& group) {
        const Color grey(0.5f);
        if (!group.material || group.shape.Is<pbrt::Curve>()) return grey;
        if (const auto known = reflectances_.find(group.material.ptr()); known != reflectances_.end())
            return known->second;
        const auto point = group.shape.Sample(pbrt::Point2f(0.4f, 0.3f));
        if (!point) return grey;
        const pbrt::Vector3f outside(point->intr.n);
        const float off = 1e-3f * Length(group.shape.Bounds().Diagonal()) + 1e-6f;
        const pbrt::Ray ray(point->intr.p() + off * outside, -outside);
        auto hit = group.shape.Intersect(ray, pbrt::Infinity);
        return reflectances_[group.material.ptr()] = hit ? measured(group, ray, hit->intr) : grey;
    }

    Color emission(const Group& group) const {
        if (!group.light || group.shape.Is<pbrt::Curve>()) return Color(0.f);
        const auto point = group.shape.Sample(pbrt::Point2f(0.4f, 0.3f));
        if (!point) return Color(0.f);
        const pbrt::Interaction& at = point->intr;
        Color sum(0.f);
        for (int i = 0; i < kPreviewWavelengths; ++i) {
            const auto lambda = camera_.GetFilm().SampleWavelengths((float(i) + 0.5f) / kPreviewWavelengths);
            sum += colors_.radiance(group.light.L(at.p(), at.n, at.uv, pbrt::Vector3f(at.n), lambda), lambda);
        }
        // Never black: it is an emitter, wherever its texture or its back are dark.
        return maxComponent(sum) > 0 ? sum / float(kPreviewWavelengths) : Color(1e-3f);
    }

  private:
    /// Mean reflectance for light from along the normal.
    Color measured(const Group& group, const pbrt::Ray& ray, pbrt::SurfaceInteraction at) {
        at.SetIntersectionProperties(group.material, nullptr, nullptr, nullptr);
        pbrt::IndependentSampler numbers(kPreviewSamples, 0);
        numbers.StartPixelSample({0, 0}, 0, 0);
        pbrt::Float lobes[kPreviewSamples];
        pbrt::Point2f directions[kPreviewSamples];
        Color sum(0.f);
        for (int i = 0; i < kPreviewWavelengths; ++i) {
            auto lambda = camera_.GetFilm().SampleWavelengths((float(i) + 0.5f) / kPreviewWavelengths);
            pbrt::SurfaceInteraction here = at;
            const pbrt::BSDF bsdf = here.GetBSDF(pbrt::RayDifferential(ray), lambda, camera_, scratch_, &numbers);
            for (int s = 0; s < kPreviewSamples; ++s) lobes[s] = numbers.Get1D(), directions[s] = numbers.Get2D();
            if (bsdf) sum += colors_.factor(bsdf.rho(here.wo, lobes, directions), lambda);
            scratch_.Reset();
        }
        const Color mean = sum / float(kPreviewWavelengths);
        if (!isFinite(mean)) return Color(0.5f);
        return {std::clamp(mean.r, 0.f, 1.f), std::clamp(mean.g, 0.f, 1.f), std::clamp(mean.b, 0.f, 1.f)};
    }

    pbrt::Camera camera_;
    SpectrumColors colors_;
    pbrt::ScratchBuffer scratch_;
    std::unordered_map<const void*, Color> reflectances_;
};

}  // namespace

MaterialNames::MaterialNames(const std::map<std::string, pbrt::Material>& named,
                             const std::vector<pbrt::Material>& unnamed) {
    for (const auto& [name, material] : named) names_.emplace(material.ptr(), name);
    for (std::size_t i = 0; i < unnamed.size(); ++i) {
        if (unnamed[i]) names_.emplace(unnamed[i].ptr(), typeName(unnamed[i]) + (" " + std::to_string(i)));
    }
}

std::string_view MaterialNames::of(pbrt::Material material) const {
    if (!material) return "interface";
    const auto found = names_.find(material.ptr());
    return found == names_.end() ? std::string_view(typeName(material)) : std::string_view(found->second);
}

struct SceneSurfaces::Impl {
    explicit Impl(const Scene& scene) : scene_(scene), shutterOpen_(scene.camera.SampleTime(0)) {
        expand(contentOf(scene.root), pbrt::Transform(), {});
        for (Group& group : groups_) tessellate(group);
        std::sort(placed_.begin(), placed_.end(), [&](const Placed& a, const Placed& b) {
            return order(groups_[a.group], a) < order(groups_[b.group], b);
        });
        makeMeshes();
        nameLights();
    }

    // --- before the order of meshes is known

    std::uint32_t contentOf(const pbrt::Primitive& root) {
        const auto [known, isNew] = contents_.emplace(root.ptr(), static_cast<std::uint32_t>(contentList_.size()));
        if (!isNew) return known->second;
        const std::uint32_t index = known->second;
        contentList_.emplace_back();
        Content content;
        std::vector<pbrt::Primitive> left;
        if (root) left.push_back(root);
        while (!left.empty()) {
            const pbrt::Primitive primitive = left.back();
            left.pop_back();
            if (inside::isLeaf(primitive)) {
                addLeaf(primitive, content);
            } else if (inside::isInstance(primitive)) {
                content.placements.push_back(primitive);
            } else {
                const auto parts = inside::parts(primitive);
                left.insert(left.end(), parts.begin(), parts.end());
            }
        }
        contentList_[index] = std::move(content);
        return index;
    }

    void addLeaf(const pbrt::Primitive& primitive, Content& content) {
        const inside::Leaf leaf = inside::leaf(primitive);
        const void* whole = ShapeSources::wholeOf(leaf.shape);
        const bool isCurve = leaf.shape.Is<pbrt::Curve>();
        if (leaf.areaLight) shapeOfLight_.emplace(leaf.areaLight.ptr(), leaf.shape);
        if (groupOf_.contains(whole)) return;
        std::uint32_t index = static_cast<std::uint32_t>(groups_.size());
        if (isCurve) {
            for (const std::uint32_t other : content.groups) {
                if (groups_[other].shape.Is<pbrt::Curve>() && groups_[other].material == leaf.material) index = other;
            }
        }
        if (index == groups_.size()) {
            groups_.push_back({.key = whole,
                               .shape = leaf.shape,
                               .material = leaf.material,
                               .light = leaf.areaLight,
                               .source = scene_.sources.find(leaf.shape)});
            content.groups.push_back(index);
        }
        if (isCurve) groups_[index].curves.push_back(inside::curve(*leaf.shape.Cast<pbrt::Curve>()));
        groupOf_.emplace(whole, index);
    }

    void expand(std::uint32_t content, const pbrt::Transform& renderFromContent, const HitChain& chain) {
        for (const std::uint32_t group : contentList_[content].groups)
            placed_.push_back({group, renderFromContent, chain});
        if (chain.instances[1]) return;  // pbrt has no deeper ones
        const std::vector<pbrt::Primitive> placements = contentList_[content].placements;
        for (const pbrt::Primitive& placement : placements) {
            HitChain inner = chain;
            (inner.instances[0] ? inner.instances[1] : inner.instances[0]) = placement;
            expand(contentOf(inside::placed(placement)), renderFromContent * inside::transform(placement, shutterOpen_),
                   inner);
        }
    }

    static void tessellate(Group& group) {
        if (const auto* triangle = group.shape.CastOrNullptr<pbrt::Triangle>()) {
            group.local = trianglesOf(*inside::triangle(*triangle).mesh);
        } else if (const auto* patch = group.shape.CastOrNullptr<pbrt::BilinearPatch>()) {
            const pbrt::BilinearPatchMesh& mesh = *inside::patch(*patch).mesh;
            for (int i = 0; i < mesh.nPatches; ++i) {
                const PatchCorners corners = cornersOf(mesh, i);
                group.firstFaces.push_back(
                    group.local.add(gridOfPatch(mesh, corners), [&](Vec2f uv) { return corners.at(uv); }));
            }
        } else if (group.shape.Is<pbrt::Curve>()) {
            for (const pbrt::CurveCommon* curve : group.curves) {
                group.local.add(CurveTube::grid(), [tube = CurveTube(*curve)](Vec2f uv) { return tube.at(uv); });
            }
        } else {
            withQuadric(group.shape, [&](const auto& quadric) {
                group.local.add(gridOf(quadric), [&](Vec2f uv) { return pointAt(quadric, uv); });
            });
        }
    }

    // --- meshes

    std::string nameOf(const Group& group) const {
        if (group.shape.Is<pbrt::Curve>()) return "curves";
        return group.source ? group.source->name() : "shape";
    }

    void makeMeshes() {
        const WorldSpace world(scene_.camera.GetCameraTransform());
        Preview preview(scene_.camera);
        std::size_t triangles = 0;
        for (const Placed& placed : placed_) {
            const Group& group = groups_[placed.group];
            triangles += group.local.triangles.size();
            if (triangles > scene_.largestTriangleCount) {
                triangles -= group.local.triangles.size();
                leftOut_ += group.local.triangles.size();
                continue;
            }
            Mesh mesh{.name = nameOf(group),
                      .material = std::string(scene_.materials.of(group.material)),
                      .triangles = group.local.triangles,
                      .diffuse = preview.reflectance(group),
                      .emission = preview.emission(group)};
            mesh.positions.reserve(group.local.positions.size());
            for (const pbrt::Point3f p : group.local.positions)
                mesh.positions.push_back(world.point(placed.renderFromGroup(p)));
            // A mirrored instance keeps its front where it was.
            if (placed.renderFromGroup.SwapsHandedness() != world.worldFromRender().SwapsHandedness()) {
                for (Triangle& t : mesh.triangles) std::swap(t[1], t[2]);
            }
            meshOf_.emplace(keyOf(group, placed.chain), static_cast<std::int32_t>(meshes_.size()));
            meshes_.push_back(std::move(mesh));
        }
        for (Group& group : groups_) {
            for (std::size_t i = 0; i < group.curves.size(); ++i) {
                curveFace_.emplace(group.curves[i], static_cast<std::uint32_t>(i) * CurveTube::grid().faceCount());
            }
            group.local = {};
        }
    }

    void nameLights() {
        for (std::size_t i = 0; i < scene_.lights.size(); ++i) {
            const pbrt::Light light = scene_.lights[i];
            const auto shape = shapeOfLight_.find(light.ptr());
            std::string name = typeName(light) + (" " + std::to_string(i));
            if (shape != shapeOfLight_.end()) name = nameOf(groups_[groupOf_.at(ShapeSources::wholeOf(shape->second))]);
            lightNames_.emplace(light.ptr(), std::move(name));
        }
    }

    // --- hits

    /// \param p   in the space of what contains the shape
    std::int32_t faceOf(const pbrt::Shape& shape, const Group& group, pbrt::Point3f p, pbrt::Point2f uv) const {
        if (const auto* triangle = shape.CastOrNullptr<pbrt::Triangle>()) return inside::triangle(*triangle).triangle;
        if (const auto* patch = shape.CastOrNullptr<pbrt::BilinearPatch>()) {
            const inside::PatchOf at = inside::patch(*patch);
            const PatchCorners corners = cornersOf(*at.mesh, at.patch);
            return static_cast<std::int32_t>(group.firstFaces[std::size_t(at.patch)]) +
                   gridOfPatch(*at.mesh, corners).face(corners.parameterOf(p));
        }
        if (const auto* segment = shape.CastOrNullptr<pbrt::Curve>()) {
            const pbrt::CurveCommon* curve = inside::curve(*segment);
            return static_cast<std::int32_t>(curveFace_.at(curve)) +
                   CurveTube::grid().face(CurveTube(*curve).parameterOf(uv.x, p));
        }
        std::int32_t face = -1;
        withQuadric(shape, [&](const auto& quadric) { face = gridOf(quadric).face({uv.x, uv.y}); });
        return face;
    }

    SurfacePlace place(const pbrt::Shape& shape, const HitChain& chain, pbrt::Point3f p, pbrt::Point2f uv,
                       pbrt::Float time) const {
        const auto group = groupOf_.find(ShapeSources::wholeOf(shape));
        if (group == groupOf_.end()) return {};
        const Group& of = groups_[group->second];
        const auto mesh = meshOf_.find(keyOf(of, chain));
        if (mesh == meshOf_.end()) return {};
        if (!shape.Is<pbrt::Triangle>()) {
            for (const pbrt::Primitive& instance : chain.instances) {
                if (instance) p = inside::transform(instance, time).ApplyInverse(p);
            }
        }
        return {mesh->second, faceOf(shape, of, p, uv)};
    }

    SurfacePlace at(const HitChain& chain, const pbrt::SurfaceInteraction& hit) const {
        return chain.leaf ? place(inside::leaf(chain.leaf).shape, chain, hit.p(), hit.uv, hit.time) : SurfacePlace{};
    }

    Scene scene_;
    pbrt::Float shutterOpen_;
    std::vector<Group> groups_;
    std::unordered_map<const void*, std::uint32_t> groupOf_;
    std::unordered_map<const void*, std::uint32_t> contents_;
    std::vector<Content> contentList_;
    std::unordered_map<const void*, pbrt::Shape> shapeOfLight_;
    std::vector<Placed> placed_;
    std::unordered_map<PlaceKey, std::int32_t, PlaceHash> meshOf_;
    std::unordered_map<const void*, std::uint32_t> curveFace_;
    std::unordered_map<const void*, std::string> lightNames_;
    std::vector<Mesh> meshes_;
    std::size_t leftOut_ = 0;
};

SceneSurfaces::SceneSurfaces(const Scene& scene) : impl_(std::make_unique<Impl>(scene)) {}
SceneSurfaces::~SceneSurfaces() = default;

const std::vector<Mesh>& SceneSurfaces::meshes() const { return impl_->meshes_; }
std::size_t SceneSurfaces::trianglesLeftOut() const { return impl_->leftOut_; }
bool SceneSurfaces::anyScatters() const {
    return std::any_of(impl_->groups_.begin(), impl_->groups_.end(),
                       [](const Group& group) { return bool(group.material); });
}
SurfacePlace SceneSurfaces::at(const HitChain& chain, const pbrt::SurfaceInteraction& at) const {
    return impl_->at(chain, at);
}

SurfacePlace SceneSurfaces::onLight(pbrt::Light light, const pbrt::Interaction& point) const {
    const auto shape = impl_->shapeOfLight_.find(light.ptr());
    if (shape == impl_->shapeOfLight_.end()) return {};
    return impl_->place(shape->second, {}, point.p(), point.uv, point.time);
}

std::string_view SceneSurfaces::lightName(pbrt::Light light) const {
    const auto found = impl_->lightNames_.find(light.ptr());
    return found == impl_->lightNames_.end() ? std::string_view() : std::string_view(found->second);
}

}  // namespace emca::pbrt4
