#include "mesh_layer.h"

#include <vtkCamera.h>
#include <vtkCellArray.h>
#include <vtkFloatArray.h>
#include <vtkObjectFactory.h>
#include <vtkOpenGLHelper.h>
#include <vtkOpenGLPolyDataMapper.h>
#include <vtkPointData.h>
#include <vtkProperty.h>
#include <vtkRenderer.h>
#include <vtkShaderProgram.h>
#include <vtkTypeInt32Array.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>
#include <string>

#include "mesh_decimation.h"

namespace emca::explorer {
namespace {

// Triangles; scenes with fewer are drawn fast enough without that stand-in.
constexpr std::size_t kCoarseAbove = 200000, kCoarse = 100000;
constexpr std::size_t kMediumAbove = 2500000, kMedium = 1000000;

/// Looks at the memory of `t`, which must outlive the result.
vtkSmartPointer<vtkPolyData> polyDataOf(const ShadedTriangles& t) {
    if (t.triangles.empty()) return nullptr;
    static_assert(sizeof(Vec3f) == 3 * sizeof(float) && sizeof(Triangle) == 3 * sizeof(vtkTypeInt32));
    const auto n = static_cast<vtkIdType>(t.positions.size());
    const auto look = [n](const std::vector<Vec3f>& values, const char* name) {
        auto array = vtkSmartPointer<vtkFloatArray>::New();
        array->SetName(name);
        array->SetNumberOfComponents(3);
        array->SetArray(const_cast<float*>(&values.front().x), 3 * n, 1);
        return array;
    };
    vtkNew<vtkUnsignedCharArray> colors;
    colors->SetName("color");
    colors->SetNumberOfComponents(3);
    colors->SetArray(const_cast<unsigned char*>(t.colors.front().data()), 3 * n, 1);
    vtkNew<vtkTypeInt32Array> offsets, corners;
    offsets->SetNumberOfValues(static_cast<vtkIdType>(t.triangles.size() + 1));
    for (std::size_t i = 0; i <= t.triangles.size(); ++i) offsets->GetPointer(0)[i] = static_cast<vtkTypeInt32>(3 * i);
    corners->SetArray(reinterpret_cast<vtkTypeInt32*>(const_cast<std::uint32_t*>(t.triangles.front().data())),
                      static_cast<vtkIdType>(3 * t.triangles.size()), 1);
    vtkNew<vtkPoints> points;
    points->SetData(look(t.positions, "position"));
    vtkNew<vtkCellArray> cells;
    cells->SetData(offsets, corners);
    auto data = vtkSmartPointer<vtkPolyData>::New();
    data->SetPoints(points);
    data->SetPolys(cells);
    data->GetPointData()->SetNormals(look(t.normals, "normal"));
    data->GetPointData()->SetScalars(colors);
    return data;
}

}  // namespace

std::shared_ptr<PreparedMeshes> prepareMeshes(std::span<const Mesh> meshes, const QColor& base, bool ownColors,
                                              const std::atomic<bool>* cancel) {
    auto prepared = std::make_shared<PreparedMeshes>();
    const std::array<std::uint8_t, 3> clay{static_cast<std::uint8_t>(base.red()), static_cast<std::uint8_t>(base.green()),
                                           static_cast<std::uint8_t>(base.blue())};
    prepared->geometry = makeMeshGeometry(meshes, clay, cancel);
    if (!ownColors) std::ranges::fill(prepared->geometry.surfaces.colors, clay);
    const ShadedTriangles& full = prepared->geometry.surfaces;
    const auto needs = [&](std::size_t above) { return full.triangles.size() > above && !(cancel && *cancel); };
    if (needs(kMediumAbove)) prepared->mediumTriangles = standIn(full, kMedium, cancel);
    const bool fromMedium = !prepared->mediumTriangles.triangles.empty();
    if (needs(kCoarseAbove)) prepared->coarseTriangles = standIn(fromMedium ? prepared->mediumTriangles : full, kCoarse, cancel);
    prepared->surfaces = polyDataOf(full);
    prepared->emitters = polyDataOf(prepared->geometry.emitters);
    prepared->medium = polyDataOf(prepared->mediumTriangles);
    prepared->coarse = polyDataOf(prepared->coarseTriangles);
    return prepared;
}

/// Matte clay under a soft light at the viewer's left shoulder. Opacity grows where a surface turns away from the eye,
/// as in a thin shell, so that the form reads even through a quarter of opacity.
class MeshLayer::ClayMapper : public vtkOpenGLPolyDataMapper {
  public:
    static ClayMapper* New();
    vtkTypeMacro(ClayMapper, vtkOpenGLPolyDataMapper)
    QColor backTint;
    float backOpacity = 1;      ///< factor for faces that turn their back
    float glow = 0;             ///< 1: shines by itself
    float opaque = 0;           ///< 1: no translucency at all

  protected:
    void ReplaceShaderLight(std::map<vtkShader::Type, vtkShader*> shaders, vtkRenderer*, vtkActor*) override {
        std::string source = shaders[vtkShader::Fragment]->GetSource();
        vtkShaderProgram::Substitute(source, "//VTK::Light::Dec", R"(uniform vec4 clayBack;
uniform vec4 clayMode;   // back opacity, glow, opaque, orthographic
//VTK::Light::Dec)");
        vtkShaderProgram::Substitute(source, "//VTK::Light::Impl", R"(
  vec3 toEye = clayMode.w > 0.5 ? vec3(0.0, 0.0, 1.0) : normalize(-vertexVC.xyz);
  float facing = clamp(abs(dot(normalVCVSOutput, toEye)), 0.0, 1.0);
  float wrapped = 0.5 + 0.5 * dot(normalVCVSOutput, normalize(vec3(-0.35, 0.40, 0.95)));
  vec3 shade = diffuseColor * (0.40 + 0.68 * wrapped * wrapped);
  float shell = clayMode.z > 0.5 ? 1.0 : mix(0.72, 2.4, pow(1.0 - facing, 3.0));
  if (!gl_FrontFacing) {
    shade = mix(shade, clayBack.rgb, clayBack.a);
    shell *= clayMode.x;
  }
  shade = mix(shade, diffuseColor * (0.82 + 0.18 * facing), clayMode.y);
  gl_FragData[0] = vec4(shade, clamp(opacity * shell, 0.0, 1.0));
  //VTK::Light::Impl)", false);
        shaders[vtkShader::Fragment]->SetSource(source);
    }

    void SetMapperShaderParameters(vtkOpenGLHelper& helper, vtkRenderer* renderer, vtkActor* actor) override {
        Superclass::SetMapperShaderParameters(helper, renderer, actor);
        const float back[4] = {float(backTint.redF()), float(backTint.greenF()), float(backTint.blueF()), 0.55f};
        const float parallel = renderer->GetActiveCamera()->GetParallelProjection() ? 1.f : 0.f;
        const float mode[4] = {backOpacity, glow, opaque, parallel};
        helper.Program->SetUniform4f("clayBack", back);
        helper.Program->SetUniform4f("clayMode", mode);
    }
};

vtkStandardNewMacro(MeshLayer::ClayMapper)

MeshLayer::MeshLayer(vtkRenderer& surfaces, vtkRenderer& strokes) : renderer_(surfaces), edges_(strokes), emitterEdges_(strokes) {
    for (Part& part : parts_) {
        part.mapper = vtkSmartPointer<ClayMapper>::New();
        part.mapper->ScalarVisibilityOn();
        part.mapper->SetColorModeToDirectScalars();
        part.actor->SetMapper(part.mapper);
        part.actor->PickableOff();
        part.actor->VisibilityOff();
        renderer_.AddActor(part.actor);
    }
    parts_.back().mapper->glow = 1;
}

MeshLayer::~MeshLayer() {
    for (Part& part : parts_) renderer_.RemoveActor(part.actor);
}

void MeshLayer::setMeshes(std::shared_ptr<PreparedMeshes> meshes) {
    // The poly data look at the memory of the meshes: they go first.
    for (Part& part : parts_) part.mapper->SetInputData(nullptr);
    meshes_ = std::move(meshes);
    if (meshes_) {
        const std::array<vtkPolyData*, 4> data{meshes_->coarse, meshes_->medium, meshes_->surfaces, meshes_->emitters};
        for (std::size_t i = 0; i < parts_.size(); ++i)
            if (data[i]) parts_[i].mapper->SetInputData(data[i]);
    }
    updateVisibility();
    edgeColor_ = QColor();   // made anew by apply()
}

MeshDetail MeshLayer::shownDetail() const {
    if (detail_ == MeshDetail::coarse && meshes_ && meshes_->coarse) return MeshDetail::coarse;
    if (detail_ != MeshDetail::full && meshes_ && meshes_->medium) return MeshDetail::medium;
    return MeshDetail::full;
}

std::size_t MeshLayer::triangleCount(MeshDetail detail) const {
    if (!meshes_) return 0;
    if (detail == MeshDetail::coarse && meshes_->coarse) return meshes_->coarseTriangles.triangles.size();
    if (detail != MeshDetail::full && meshes_->medium) return meshes_->mediumTriangles.triangles.size();
    return meshes_->geometry.surfaces.triangles.size();
}

void MeshLayer::setDetail(MeshDetail detail) {
    detail_ = detail;
    updateVisibility();
}

void MeshLayer::setCovered(bool covered) {
    covered_ = covered;
    updateVisibility();
}

void MeshLayer::updateVisibility() {
    const bool surfaces = meshes_ && meshes_->surfaces && opacity_ > 0 && !covered_;
    for (const MeshDetail detail : {MeshDetail::coarse, MeshDetail::medium, MeshDetail::full})
        surfacePart(detail).actor->SetVisibility(surfaces && detail == shownDetail());
    parts_.back().actor->SetVisibility(meshes_ && meshes_->emitters && !covered_);
}

void MeshLayer::apply(const SceneOptions& options, const ThemeColors& colors) {
    const double opacity = std::clamp(double(options.surfaceOpacity), 0.0, 1.0);
    const bool opaque = opacity >= 0.995;
    for (Part& part : parts_) {
        const bool shines = &part == &parts_.back();
        part.mapper->backTint = colors.meshBack;
        part.mapper->opaque = opaque ? 1 : 0;
        part.mapper->backOpacity = shines ? 0.6f : options.backFaces == BackFaces::fade && !opaque ? 0.3f : 1.f;
        vtkProperty* property = part.actor->GetProperty();
        property->SetColor(colors.mesh.redF(), colors.mesh.greenF(), colors.mesh.blueF());
        property->SetBackfaceCulling(options.backFaces == BackFaces::hide);
        // Lights stay visible longer than what they light, yet never hide what is behind them.
        property->SetOpacity(opaque ? 1.0 : shines ? std::min(0.95, 0.45 + opacity) : opacity);
    }
    opacity_ = opacity;
    updateVisibility();
    edges_.setVisible(options.edges);
    rebuildEdges(colors);
}

void MeshLayer::rebuildEdges(const ThemeColors& colors) {
    const auto strokesOf = [](const std::vector<Edge>& edges, float width, const QColor& color) {
        std::vector<Stroke> strokes;
        strokes.reserve(edges.size());
        for (const Edge& e : edges) strokes.push_back({e.from, e.to, width, StrokeStyle::line, color});
        return strokes;
    };
    if (edgeColor_ != colors.mesh || emitterColor_ != colors.emitter) {
        edgeColor_ = colors.mesh;
        emitterColor_ = colors.emitter;
        QColor edge = colors.mesh, emitter = colors.emitter;
        edge.setAlphaF(0.5);
        emitter.setAlphaF(0.6);
        edges_.setStrokes(meshes_ ? strokesOf(meshes_->geometry.edges, 1.1f, edge) : std::vector<Stroke>());
        emitterEdges_.setStrokes(meshes_ ? strokesOf(meshes_->geometry.emitterEdges, 1.4f, emitter) : std::vector<Stroke>());
    }
    for (StrokeLayer* layer : {&edges_, &emitterEdges_}) {
        layer->look().fade = 0.75f;
        layer->look().fadeColor = colors.sceneBottom;
        layer->look().pull = 0.0005f;
    }
}

void MeshLayer::prepareFrame(float pixelScale, float fadeNear, float fadeFar, const ClipPlane& clip) {
    for (StrokeLayer* layer : {&edges_, &emitterEdges_}) {
        layer->look().pixelScale = pixelScale;
        layer->look().fadeNear = fadeNear;
        layer->look().fadeFar = fadeFar;
        setClip(layer->look(), clip);
    }
    if (clip.isOn()) {
        plane_->SetNormal(clip.normal.x, clip.normal.y, clip.normal.z);
        plane_->SetOrigin(clip.normal.x * clip.offset, clip.normal.y * clip.offset, clip.normal.z * clip.offset);
    }
    if (clip.isOn() == clipped_) return;
    clipped_ = clip.isOn();
    for (Part& part : parts_) {
        if (clipped_) part.mapper->AddClippingPlane(plane_);
        else part.mapper->RemoveAllClippingPlanes();
    }
}

}  // namespace emca::explorer
