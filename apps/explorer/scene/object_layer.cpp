#include "object_layer.h"

#include <vtkActor.h>
#include <vtkCellArray.h>
#include <vtkFloatArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkRenderer.h>
#include <vtkTypeInt32Array.h>
#include <vtkUnsignedCharArray.h>

#include "object_geometry.h"
#include "stroke_layer.h"

namespace emca::explorer {
namespace {

vtkSmartPointer<vtkPolyData> polyDataOf(const ColoredTriangles& t) {
    const auto corners = static_cast<vtkIdType>(t.positions.size());
    vtkNew<vtkFloatArray> places;
    places->SetNumberOfComponents(3);
    places->SetNumberOfTuples(corners);
    std::copy_n(&t.positions.front().x, 3 * t.positions.size(), places->GetPointer(0));
    vtkNew<vtkUnsignedCharArray> colors;
    colors->SetNumberOfComponents(4);
    colors->SetNumberOfTuples(corners);
    unsigned char* color = colors->GetPointer(0);
    for (const analysis::Color8& c : t.colors)
        for (int corner = 0; corner < 3; ++corner)
            for (const std::uint8_t channel : {c.r, c.g, c.b, c.a}) *color++ = channel;
    vtkNew<vtkTypeInt32Array> offsets, connectivity;
    offsets->SetNumberOfValues(corners / 3 + 1);
    connectivity->SetNumberOfValues(corners);
    for (vtkIdType i = 0; i <= corners / 3; ++i) offsets->GetPointer(0)[i] = static_cast<vtkTypeInt32>(3 * i);
    for (vtkIdType i = 0; i < corners; ++i) connectivity->GetPointer(0)[i] = static_cast<vtkTypeInt32>(i);
    vtkNew<vtkPoints> points;
    points->SetData(places);
    vtkNew<vtkCellArray> cells;
    cells->SetData(offsets, connectivity);
    auto data = vtkSmartPointer<vtkPolyData>::New();
    data->SetPoints(points);
    data->SetPolys(cells);
    data->GetPointData()->SetScalars(colors);
    return data;
}

}  // namespace

struct ObjectLayer::Drawn {
    Drawn(vtkRenderer& surfaces, vtkRenderer& strokes) : renderer(surfaces), lines(strokes) {
        mapper->ScalarVisibilityOn();
        mapper->SetColorModeToDirectScalars();
        actor->SetMapper(mapper);
        actor->PickableOff();
        actor->UseBoundsOff();
        actor->VisibilityOff();
        vtkProperty* property = actor->GetProperty();
        property->SetInterpolationToFlat();
        property->SetAmbient(0.45);
        property->SetDiffuse(0.55);
        property->SetSpecular(0);
        renderer.AddActor(actor);
    }
    ~Drawn() { renderer.RemoveActor(actor); }
    Drawn(const Drawn&) = delete;
    Drawn& operator=(const Drawn&) = delete;

    void set(const std::shared_ptr<const SceneObject>& now) {
        object = now;
        const ObjectGeometry geometry = geometryOf(*object);
        lines.setStrokes(geometry.strokes);
        lines.look().onTop = object->onTop;
        leftOut = geometry.leftOut;
        hasTriangles = !geometry.triangles.colors.empty();
        if (!hasTriangles) return;
        mapper->SetInputData(polyDataOf(geometry.triangles));
        actor->SetForceTranslucent(geometry.triangles.translucent);
        actor->SetForceOpaque(!geometry.triangles.translucent);
    }
    void setVisible(bool visible) {
        lines.setVisible(visible);
        actor->SetVisibility(visible && hasTriangles);
    }

    vtkRenderer& renderer;
    std::shared_ptr<const SceneObject> object;
    StrokeLayer lines;
    vtkNew<vtkPolyDataMapper> mapper;
    vtkNew<vtkActor> actor;
    std::size_t leftOut = 0;
    bool hasTriangles = false;
};

ObjectLayer::ObjectLayer(vtkRenderer& surfaces, vtkRenderer& strokes) : surfaces_(surfaces), strokes_(strokes) {}
ObjectLayer::~ObjectLayer() = default;

void ObjectLayer::show(std::span<const SceneObjects::Entry> entries) {
    std::erase_if(drawn_, [&](const auto& drawn) {
        return std::ranges::find(entries, drawn.first, &SceneObjects::Entry::id) == entries.end();
    });
    for (const SceneObjects::Entry& entry : entries) {
        std::unique_ptr<Drawn>& drawn = drawn_[entry.id];
        if (!drawn) drawn = std::make_unique<Drawn>(surfaces_, strokes_);
        if (drawn->object != entry.object) drawn->set(entry.object);
        drawn->setVisible(entry.visible && entry.object->opacity > 0);
    }
}

void ObjectLayer::apply(const ThemeColors& colors) { halo_ = colors.halo; }

void ObjectLayer::prepareFrame(float pixelScale, const ClipPlane& clip) {
    for (const auto& [id, drawn] : drawn_) {
        StrokeLook& look = drawn->lines.look();
        look.pixelScale = pixelScale;
        look.halo = 1;
        look.haloColor = halo_;
        look.haloColor.setAlphaF(0.5);
        look.writesDepth = true;
        look.pull = 0.0015f;   // off the surfaces that it lies on
        setClip(look, clip);
    }
}

std::size_t ObjectLayer::leftOut() const {
    std::size_t sum = 0;
    for (const auto& [id, drawn] : drawn_) sum += drawn->leftOut;
    return sum;
}

}  // namespace emca::explorer
