#include "stroke_layer.h"

#include <vtkCellArray.h>
#include <vtkFloatArray.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkRenderer.h>
#include <vtkSmartPointer.h>
#include <vtkTypeInt32Array.h>

namespace emca::explorer {
namespace {

vtkSmartPointer<vtkFloatArray> floats(const char* name, int components, std::size_t tuples) {
    const auto array = vtkSmartPointer<vtkFloatArray>::New();
    array->SetName(name);
    array->SetNumberOfComponents(components);
    array->SetNumberOfTuples(static_cast<vtkIdType>(tuples));
    return array;
}

}  // namespace

StrokeLayer::StrokeLayer(vtkRenderer& renderer) : renderer_(renderer) {
    actor_->SetMapper(mapper_);
    actor_->PickableOff();
    actor_->UseBoundsOff();      // the scene's camera knows its own near and far planes
    actor_->ForceOpaqueOn();     // blended in the order of the layers, not by VTK's translucent pass
    actor_->VisibilityOff();
    renderer_.AddActor(actor_);
}

StrokeLayer::~StrokeLayer() { renderer_.RemoveActor(actor_); }

void StrokeLayer::setVisible(bool visible) {
    visible_ = visible;
    actor_->SetVisibility(visible_ && count_ > 0);
}

void StrokeLayer::setStrokes(std::span<const Stroke> strokes) {
    std::size_t n = 0;
    for (const Stroke& s : strokes) n += isFinite(s.from) && isFinite(s.to);
    count_ = n;
    actor_->SetVisibility(visible_ && count_ > 0);
    if (n == 0) return;

    const auto corners = floats("corner", 3, 4 * n), starts = floats("strokeStart", 3, 4 * n),
               ends = floats("strokeEnd", 3, 4 * n), shapes = floats("strokeShape", 2, 4 * n), colors = floats("strokeColor", 4, 4 * n);
    vtkNew<vtkTypeInt32Array> offsets, connectivity;
    offsets->SetNumberOfValues(static_cast<vtkIdType>(2 * n + 1));
    connectivity->SetNumberOfValues(static_cast<vtkIdType>(6 * n));
    float *place = corners->GetPointer(0), *start = starts->GetPointer(0), *end = ends->GetPointer(0), *shape = shapes->GetPointer(0),
          *color = colors->GetPointer(0);
    vtkTypeInt32 *offset = offsets->GetPointer(0), *index = connectivity->GetPointer(0);
    vtkTypeInt32 base = 0;
    for (const Stroke& s : strokes) {
        if (!isFinite(s.from) || !isFinite(s.to)) continue;
        const bool point = s.style == StrokeStyle::dot;
        const Vec3f to = point ? s.from : s.to;
        const float rgba[4] = {float(s.color.redF()), float(s.color.greenF()), float(s.color.blueF()), float(s.color.alphaF())};
        for (int i = 0; i < 4; ++i) {
            for (const float v : {float(i), i == 1 || i == 2 ? 1.f : 0.f, 0.f}) *place++ = v;
            for (const float v : {s.from.x, s.from.y, s.from.z}) *start++ = v;
            for (const float v : {to.x, to.y, to.z}) *end++ = v;
            for (const float v : {0.5f * s.width, float(s.style)}) *shape++ = v;
            for (const float v : rgba) *color++ = v;
        }
        for (const vtkTypeInt32 i : {0, 1, 2, 0, 2, 3}) *index++ = base + i;
        base += 4;
    }
    for (std::size_t i = 0; i <= 2 * n; ++i) *offset++ = static_cast<vtkTypeInt32>(3 * i);

    vtkNew<vtkPoints> points;
    points->SetData(corners);
    vtkNew<vtkCellArray> cells;
    cells->SetData(offsets, connectivity);
    vtkNew<vtkPolyData> data;
    data->SetPoints(points);
    data->SetPolys(cells);
    data->GetPointData()->AddArray(starts);
    data->GetPointData()->AddArray(ends);
    data->GetPointData()->AddArray(shapes);
    data->GetPointData()->AddArray(colors);
    mapper_->SetInputData(data);
}

}  // namespace emca::explorer
