#include "mesh_layer.h"

#include <vtkCamera.h>
#include <vtkCellArray.h>
#include <vtkFloatArray.h>
#include <vtkObjectFactory.h>
#include <vtkOpenGLHelper.h>
#include <vtkOpenGLPolyDataMapper.h>
#include <vtkPointData.h>
#include <vtkProperty.h>
#include <vtkQuadricClustering.h>
#include <vtkRenderer.h>
#include <vtkShaderProgram.h>
#include <vtkTypeInt32Array.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>
#include <string>

namespace emca::explorer {
namespace {

constexpr std::size_t kStandInAbove = 200000;  ///< triangles; fewer are drawn fast enough while the camera moves

vtkSmartPointer<vtkPolyData> polyDataOf(const ShadedTriangles& t) {
    if (t.triangles.empty()) return nullptr;
    const auto n = static_cast<vtkIdType>(t.positions.size());
    const auto copy = [&](const std::vector<Vec3f>& values, const char* name) {
        auto array = vtkSmartPointer<vtkFloatArray>::New();
        array->SetName(name);
        array->SetNumberOfComponents(3);
        array->SetNumberOfTuples(n);
        float* out = array->GetPointer(0);
        for (const Vec3f& v : values) *out++ = v.x, *out++ = v.y, *out++ = v.z;
        return array;
    };
    vtkNew<vtkUnsignedCharArray> colors;
    colors->SetName("color");
    colors->SetNumberOfComponents(3);
    colors->SetNumberOfTuples(n);
    std::copy_n(t.colors.front().data(), 3 * t.colors.size(), colors->GetPointer(0));
    vtkNew<vtkTypeInt32Array> offsets, connectivity;
    offsets->SetNumberOfValues(static_cast<vtkIdType>(t.triangles.size() + 1));
    connectivity->SetNumberOfValues(static_cast<vtkIdType>(3 * t.triangles.size()));
    for (std::size_t i = 0; i <= t.triangles.size(); ++i) offsets->GetPointer(0)[i] = static_cast<vtkTypeInt32>(3 * i);
    vtkTypeInt32* corner = connectivity->GetPointer(0);
    for (const Triangle& triangle : t.triangles)
        for (const std::uint32_t v : triangle) *corner++ = static_cast<vtkTypeInt32>(v);
    vtkNew<vtkPoints> points;
    points->SetData(copy(t.positions, "position"));
    vtkNew<vtkCellArray> cells;
    cells->SetData(offsets, connectivity);
    auto data = vtkSmartPointer<vtkPolyData>::New();
    data->SetPoints(points);
    data->SetPolys(cells);
    data->GetPointData()->SetNormals(copy(t.normals, "normal"));
    data->GetPointData()->SetScalars(colors);
    return data;
}

vtkSmartPointer<vtkPolyData> standInOf(vtkPolyData* full) {
    vtkNew<vtkQuadricClustering> cluster;
    cluster->SetInputData(full);
    cluster->SetNumberOfDivisions(96, 96, 96);
    cluster->AutoAdjustNumberOfDivisionsOff();
    cluster->CopyCellDataOff();
    cluster->Update();
    auto data = vtkSmartPointer<vtkPolyData>::New();
    data->ShallowCopy(cluster->GetOutput());
    data->GetPointData()->Initialize();
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
    prepared->surfaces = polyDataOf(prepared->geometry.surfaces);
    prepared->emitters = polyDataOf(prepared->geometry.emitters);
    if (prepared->geometry.surfaces.triangles.size() > kStandInAbove && !(cancel && *cancel))
        prepared->standIn = standInOf(prepared->surfaces);
    prepared->geometry.surfaces = {};   // VTK has its own copy now
    prepared->geometry.emitters = {};
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

MeshLayer::MeshLayer(vtkRenderer& surfaces, vtkRenderer& strokes)
    : renderer_(surfaces), clay_(vtkSmartPointer<ClayMapper>::New()), glow_(vtkSmartPointer<ClayMapper>::New()),
      edges_(strokes), emitterEdges_(strokes) {
    glow_->glow = 1;
    for (auto [actor, mapper] : {std::pair(clayActor_.Get(), clay_.Get()), std::pair(glowActor_.Get(), glow_.Get())}) {
        mapper->ScalarVisibilityOn();
        mapper->SetColorModeToDirectScalars();
        actor->SetMapper(mapper);
        actor->PickableOff();
        actor->VisibilityOff();
        renderer_.AddActor(actor);
    }
}

MeshLayer::~MeshLayer() {
    renderer_.RemoveActor(clayActor_);
    renderer_.RemoveActor(glowActor_);
}

void MeshLayer::setMeshes(std::shared_ptr<PreparedMeshes> meshes) {
    meshes_ = std::move(meshes);
    updateVisibility();
    if (meshes_ && meshes_->surfaces) clay_->SetInputData(meshes_->surfaces);
    if (meshes_ && meshes_->emitters) glow_->SetInputData(meshes_->emitters);
    coarse_ = false;
    edgeColor_ = QColor();   // made anew by apply()
}

void MeshLayer::setCoarse(bool coarse) {
    coarse = coarse && hasStandIn();
    if (coarse == coarse_) return;
    coarse_ = coarse;
    clay_->SetInputData(coarse ? meshes_->standIn : meshes_->surfaces);
}

void MeshLayer::setCovered(bool covered) {
    covered_ = covered;
    updateVisibility();
}

void MeshLayer::updateVisibility() {
    clayActor_->SetVisibility(meshes_ && meshes_->surfaces && opacity_ > 0 && !covered_);
    glowActor_->SetVisibility(meshes_ && meshes_->emitters && !covered_);
}

void MeshLayer::apply(const SceneOptions& options, const ThemeColors& colors) {
    const double opacity = std::clamp(double(options.surfaceOpacity), 0.0, 1.0);
    const bool opaque = opacity >= 0.995;
    for (auto [actor, mapper] : {std::pair(clayActor_.Get(), clay_.Get()), std::pair(glowActor_.Get(), glow_.Get())}) {
        mapper->backTint = colors.meshBack;
        mapper->opaque = opaque ? 1 : 0;
        vtkProperty* property = actor->GetProperty();
        property->SetColor(colors.mesh.redF(), colors.mesh.greenF(), colors.mesh.blueF());
        property->SetBackfaceCulling(options.backFaces == BackFaces::hide);
    }
    clay_->backOpacity = options.backFaces == BackFaces::fade && !opaque ? 0.3f : 1.f;
    clayActor_->GetProperty()->SetOpacity(opaque ? 1.0 : opacity);
    opacity_ = opacity;
    updateVisibility();
    // Lights stay visible longer than what they light, yet never hide what is behind them.
    glowActor_->GetProperty()->SetOpacity(opaque ? 1.0 : std::min(0.95, 0.45 + opacity));
    glow_->backOpacity = 0.6f;
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

void MeshLayer::prepareFrame(float pixelScale, float fadeNear, float fadeFar) {
    for (StrokeLayer* layer : {&edges_, &emitterEdges_}) {
        layer->look().pixelScale = pixelScale;
        layer->look().fadeNear = fadeNear;
        layer->look().fadeFar = fadeFar;
    }
}

}  // namespace emca::explorer
