// What a renderer in Python calls in its loop: the recorder of the calling thread.
#include "emca/recorder/recorder.h"

#include <pybind11/pybind11.h>

#include "arrays.h"
#include "bindings.h"
#include "recorded_value.h"

namespace emca::python {
namespace {

/// Stands for the recorder of whichever thread calls.
struct Recorder {};

template <typename Add>
void visit(py::handle value, const Add& add) {
    std::visit(
        [&](const auto& v) {
            if constexpr (std::is_same_v<std::decay_t<decltype(v)>, std::vector<float>>)
                add(std::span<const float>(v));
            else
                add(v);
        },
        toValue(resolved(value)));
}

void addPathData(const Recorder&, std::string_view key, py::handle value) {
    PathRecorder& emca = recorder();
    if (emca.isRecording()) visit(value, [&](const auto& v) { emca.addPathData(Key(key), v); });
}

void addIntersectionData(const Recorder&, std::string_view key, py::handle value) {
    PathRecorder& emca = recorder();
    if (emca.isRecording()) visit(value, [&](const auto& v) { emca.addIntersectionData(Key(key), v); });
}

void setIntersectionEvent(const Recorder&, py::handle event, py::handle lobe, py::handle label) {
    PathRecorder& emca = recorder();
    if (!emca.isRecording()) return;
    const auto text = resolved(label).cast<std::string>();
    emca.setIntersectionEvent(toEvent(event), toLobe(lobe), text);
}

void addContribution(const Recorder&, py::handle value, std::string_view technique, float misWeight, py::handle end) {
    PathRecorder& emca = recorder();
    if (emca.isRecording())
        emca.addContribution(toColor(resolved(value), "a contribution"), technique, misWeight, toLightEnd(end));
}

/// A call with one position.
template <auto Set>
void withPosition(const Recorder&, py::handle position) {
    PathRecorder& emca = recorder();
    if (emca.isRecording()) (emca.*Set)(toVec3(resolved(position), "a position"));
}

/// A call with one colour.
template <auto Set>
void withColor(const Recorder&, py::handle color) {
    PathRecorder& emca = recorder();
    if (emca.isRecording()) (emca.*Set)(emca::python::toColor(resolved(color), "a colour"));
}

}  // namespace

void bindRecorder(py::module_& module) {
    using P = PathRecorder;
    using namespace py::literals;
    const float kNone = std::numeric_limits<float>::quiet_NaN();
    py::class_<Recorder>(
        module, "PathRecorder",
        "The recorder of the calling thread: what a renderer calls in its loop. Outside a replay its calls do nothing.")
        .def(py::init<>())
        .def_property_readonly(
            "is_recording", [](const Recorder&) { return recorder().isRecording(); },
            "Whether the calling thread is inside a replay.")
        .def(
            "set_pixel", [](const Recorder&, py::handle pixel) { recorder().setPixel(toPixel(pixel)); }, "pixel"_a,
            "The pixel that the next paths belong to; during a replay it is set already.")
        .def(
            "clear_pixel", [](const Recorder&) { recorder().clearPixel(); },
            "The next paths belong to no pixel: light paths, kept if they splat on a pixel that was asked for.")
        .def(
            "set_path_index",
            [](const Recorder&, std::int64_t sample, std::int32_t part) { recorder().setPathIndex(sample, part); },
            "sample"_a, "part"_a = 0, "Begins a path; part: 0 unless a sample splits into several.")
        .def("set_path_origin", &withPosition<&P::setPathOrigin<Vec3f>>, "origin"_a,
             "Where the path begins: three numbers, world space.")
        .def(
            "end_path", [](const Recorder&) { recorder().endPath(); },
            "Ends the path; so does the next set_path_index, and the end of the pixel.")
        .def("set_final_estimate", &withColor<&P::setFinalEstimate<Color>>, "estimate"_a,
             "The path's value before division by samples per pixel.")
        .def(
            "add_splat",
            [](const Recorder&, py::handle pixel, py::handle value) {
                if (recorder().isRecording()) recorder().addSplat(toPixel(pixel), toColor(resolved(value), "a splat"));
            },
            "pixel"_a, "value"_a, "Light that this path adds to any pixel of the film, in the film's units.")
        .def(
            "set_depth_index",
            [](const Recorder&, std::int32_t depth, py::handle subpath) {
                if (recorder().isRecording()) recorder().setDepthIndex(depth, toSubpath(subpath));
            },
            "depth"_a, "subpath"_a = "camera",
            "Begins a vertex or continues the one of that depth: 0 is the camera (or the light), 1 the first hit.")
        .def("set_intersection_pos", &withPosition<&P::setIntersectionPos<Vec3f>>, "position"_a,
             "The vertex's position: three numbers, world space.")
        .def("set_intersection_pos_envmap", &withPosition<&P::setIntersectionPosEnvmap<Vec3f>>, "position"_a,
             "The path left the scene towards a position; a vertex of its own.")
        .def(
            "set_next_event_estimation_pos",
            [](const Recorder&, py::handle position, bool visible) {
                if (recorder().isRecording())
                    recorder().setNextEventEstimationPos(toVec3(resolved(position), "a position"), visible);
            },
            "position"_a, "visible"_a, "One shadow test; several at one vertex are kept in call order.")
        .def(
            "set_intersection_surface",
            [](const Recorder&, std::int64_t mesh, std::int64_t face) {
                recorder().setIntersectionSurface(mesh, face);
            },
            "mesh"_a, "face"_a, "Place in the renderer's list of meshes, and triangle of that mesh.")
        .def("set_intersection_event", &setIntersectionEvent, "event"_a, "lobe"_a = "none", "label"_a = "",
             "What happened here: emca.Event and emca.Lobe or their names; label, e.g. the material's name.")
        .def("set_intersection_estimate", &withColor<&P::setIntersectionEstimate<Color>>, "estimate"_a,
             "Camera-weighted sum of the path up to here.")
        .def("set_intersection_emission", &withColor<&P::setIntersectionEmission<Color>>, "emission"_a,
             "Unweighted emitted radiance towards the path.")
        .def("add_contribution", &addContribution, "value"_a, "technique"_a, "mis_weight"_a = kNone,
             "end"_a = "automatic",
             "Light that a technique added here, weighted by the camera path and mis_weight (NaN: not said). end: "
             "automatic, hit or connected.")
        .def("add_intersection_data", &addIntersectionData, "key"_a, "value"_a,
             "Any value under any name: bool, int, float (64 bits), str, emca.Color, numpy values, two or three "
             "numbers; more are a spectrum.")
        .def("add_path_data", &addPathData, "key"_a, "value"_a, "As add_intersection_data, for the whole path.");
}

}  // namespace emca::python
