#include "heat_layer.h"

#include <vtkCamera.h>
#include <vtkCellArray.h>
#include <vtkFloatArray.h>
#include <vtkObjectFactory.h>
#include <vtkOpenGLBufferObject.h>
#include <vtkOpenGLHelper.h>
#include <vtkOpenGLPolyDataMapper.h>
#include <vtkOpenGLRenderWindow.h>
#include <vtkProperty.h>
#include <vtkRenderer.h>
#include <vtkShaderProgram.h>
#include <vtkTextureObject.h>
#include <vtkTypeInt32Array.h>

#include <algorithm>
#include <string>

namespace emca::explorer {
namespace {

constexpr float kBackOpacity = 0.3f;   ///< of faded back faces, as MeshLayer

/// Shares the memory of `triangles` and `positions`, which must outlive the result.
vtkSmartPointer<vtkPolyData> polyDataOf(const std::vector<Vec3f>& positions, const std::vector<Triangle>& triangles) {
    static_assert(sizeof(Vec3f) == 3 * sizeof(float) && sizeof(Triangle) == 3 * sizeof(vtkTypeInt32));
    vtkNew<vtkFloatArray> places;
    places->SetNumberOfComponents(3);
    places->SetArray(const_cast<float*>(&positions.front().x), static_cast<vtkIdType>(3 * positions.size()), 1);
    vtkNew<vtkPoints> points;
    points->SetData(places);
    vtkNew<vtkTypeInt32Array> offsets, corners;
    offsets->SetNumberOfValues(static_cast<vtkIdType>(triangles.size() + 1));
    for (std::size_t i = 0; i <= triangles.size(); ++i) offsets->GetPointer(0)[i] = static_cast<vtkTypeInt32>(3 * i);
    corners->SetArray(reinterpret_cast<vtkTypeInt32*>(const_cast<std::uint32_t*>(triangles.front().data())),
                      static_cast<vtkIdType>(3 * triangles.size()), 1);
    vtkNew<vtkCellArray> cells;
    cells->SetData(offsets, corners);
    auto data = vtkSmartPointer<vtkPolyData>::New();
    data->SetPoints(points);
    data->SetPolys(cells);
    return data;
}

}  // namespace

/// One colour per triangle in the graphics memory, shared by the mappers that draw the same triangles. Alpha 0 marks
/// faces that have no data and are shaded.
struct HeatLayer::FaceColors {
    std::vector<analysis::Color8> values;
    bool stale = true;
    vtkNew<vtkOpenGLBufferObject> buffer;
    vtkNew<vtkTextureObject> texture;

    void set(std::span<const analysis::Color8> colors, std::size_t count) {
        values.assign(colors.begin(), colors.end());
        analysis::Color8 grey = analysis::kNoDataColor;
        grey.a = 0;
        values.resize(count, grey);
        stale = true;
    }
    void bind(vtkOpenGLRenderWindow* window) {
        texture->SetContext(window);
        if (stale) {
            buffer->SetType(vtkOpenGLBufferObject::TextureBuffer);
            buffer->Upload(values, vtkOpenGLBufferObject::TextureBuffer);
            texture->CreateTextureBuffer(static_cast<unsigned>(values.size()), 4, VTK_UNSIGNED_CHAR, buffer);
            stale = false;
        }
        texture->Activate();
    }
    void release(vtkWindow* window) {
        texture->ReleaseGraphicsResources(window);
        buffer->ReleaseGraphicsResources();
        stale = true;
    }
};

class HeatLayer::FaceMapper : public vtkOpenGLPolyDataMapper {
  public:
    static FaceMapper* New();
    vtkTypeMacro(FaceMapper, vtkOpenGLPolyDataMapper)
    std::shared_ptr<FaceColors> colors;
    float backOpacity = 1;   ///< factor for faces that turn their back

    void ReleaseGraphicsResources(vtkWindow* window) override {
        if (colors) colors->release(window);
        Superclass::ReleaseGraphicsResources(window);
    }

  protected:
    void ReplaceShaderLight(std::map<vtkShader::Type, vtkShader*> shaders, vtkRenderer*, vtkActor*) override {
        std::string source = shaders[vtkShader::Fragment]->GetSource();
        vtkShaderProgram::Substitute(source, "//VTK::Light::Dec", R"(uniform samplerBuffer faceColors;
uniform vec2 faceMode;   // back opacity, orthographic
//VTK::Light::Dec)");
        vtkShaderProgram::Substitute(source, "//VTK::Light::Impl", R"(
  vec4 faceColor = texelFetch(faceColors, gl_PrimitiveID);
  vec3 toEye = faceMode.y > 0.5 ? vec3(0.0, 0.0, 1.0) : normalize(-vertexVC.xyz);
  float facing = clamp(abs(dot(normalVCVSOutput, toEye)), 0.0, 1.0);
  vec3 shown = faceColor.a > 0.5 ? faceColor.rgb : faceColor.rgb * (0.55 + 0.45 * facing);
  gl_FragData[0] = vec4(shown, gl_FrontFacing ? opacity : opacity * faceMode.x);
  //VTK::Light::Impl)", false);
        shaders[vtkShader::Fragment]->SetSource(source);
    }

    void SetMapperShaderParameters(vtkOpenGLHelper& helper, vtkRenderer* renderer, vtkActor* actor) override {
        Superclass::SetMapperShaderParameters(helper, renderer, actor);
        if (!colors) return;
        colors->bind(static_cast<vtkOpenGLRenderWindow*>(renderer->GetRenderWindow()));
        const float mode[2] = {backOpacity, renderer->GetActiveCamera()->GetParallelProjection() ? 1.f : 0.f};
        helper.Program->SetUniform2f("faceMode", mode);
        helper.Program->SetUniformi("faceColors", colors->texture->GetTextureUnit());
    }

    void RenderPieceFinish(vtkRenderer* renderer, vtkActor* actor) override {
        if (colors) colors->texture->Deactivate();
        Superclass::RenderPieceFinish(renderer, actor);
    }
};

vtkStandardNewMacro(HeatLayer::FaceMapper)

HeatLayer::HeatLayer(vtkRenderer& surfaces)
    : renderer_(surfaces), fullColors_(std::make_shared<FaceColors>()), coarseColors_(std::make_shared<FaceColors>()),
      mapper_(vtkSmartPointer<FaceMapper>::New()), backMapper_(vtkSmartPointer<FaceMapper>::New()) {
    for (auto [actor, mapper] : {std::pair(actor_.Get(), mapper_.Get()), std::pair(backActor_.Get(), backMapper_.Get())}) {
        mapper->ScalarVisibilityOff();
        actor->SetMapper(mapper);
        actor->PickableOff();
        actor->VisibilityOff();
        renderer_.AddActor(actor);
    }
    backActor_->GetProperty()->FrontfaceCullingOn();
}

HeatLayer::~HeatLayer() {
    renderer_.RemoveActor(actor_);
    renderer_.RemoveActor(backActor_);
}

void HeatLayer::setSurface(std::shared_ptr<const PreparedSurface> surface) {
    if (surface == surface_) return;
    // The poly data look at the memory of the surface: they go first.
    full_ = standIn_ = nullptr;
    mapper_->SetInputData(nullptr);
    backMapper_->SetInputData(nullptr);
    surface_ = std::move(surface);
    if (surface_ && !surface_->triangles.empty() && !surface_->positions.empty())
        full_ = polyDataOf(surface_->positions, surface_->triangles);
    if (full_ && hasStandIn()) standIn_ = polyDataOf(surface_->coarsePositions, surface_->coarseTriangles);
    shown_ = coarse_ = false;
    show();
}

void HeatLayer::setColors(std::span<const analysis::Color8> colors) {
    shown_ = full_ && !colors.empty() && colors.size() == surface_->dataFaces;
    if (shown_) fullColors_->set(colors, surface_->triangles.size());
    if (shown_ && standIn_) coarseColors_->set(coarseColors(*surface_, colors), surface_->coarseTriangles.size());
    show();
}

void HeatLayer::setCoarse(bool coarse) {
    coarse = coarse && standIn_;
    if (coarse == coarse_) return;
    coarse_ = coarse;
    show();
}

void HeatLayer::setClip(const ClipPlane& clip) {
    if (clip.isOn()) {
        plane_->SetNormal(clip.normal.x, clip.normal.y, clip.normal.z);
        plane_->SetOrigin(clip.normal.x * clip.offset, clip.normal.y * clip.offset, clip.normal.z * clip.offset);
    }
    if (clip.isOn() == clipped_) return;
    clipped_ = clip.isOn();
    for (FaceMapper* mapper : {mapper_.Get(), backMapper_.Get()}) {
        if (clipped_) mapper->AddClippingPlane(plane_);
        else mapper->RemoveAllClippingPlanes();
    }
}

void HeatLayer::apply(const SceneOptions& options, float opacity, const ThemeColors&) {
    opacity_ = std::clamp(opacity, 0.f, 1.f);
    const bool opaque = opacity_ >= 0.995f, fade = options.backFaces == BackFaces::fade;
    separateBack_ = opaque && fade;
    actor_->GetProperty()->SetOpacity(opaque ? 1.0 : double(opacity_));
    actor_->GetProperty()->SetBackfaceCulling(separateBack_ || options.backFaces == BackFaces::hide);
    mapper_->backOpacity = fade ? kBackOpacity : 1.f;
    backActor_->GetProperty()->SetOpacity(double(kBackOpacity));
    show();
}

void HeatLayer::show() {
    const bool visible = shown_ && opacity_ > 0;
    vtkPolyData* data = coarse_ ? standIn_ : full_;
    actor_->SetVisibility(visible);
    backActor_->SetVisibility(visible && separateBack_);
    if (!visible) return;
    for (FaceMapper* mapper : {mapper_.Get(), backMapper_.Get()}) {
        if (mapper->GetInput() != data) mapper->SetInputData(data);
        mapper->colors = coarse_ ? coarseColors_ : fullColors_;
    }
}

}  // namespace emca::explorer
