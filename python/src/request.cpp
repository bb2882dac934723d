#include "request.h"

#include <chrono>
#include <thread>

#include "arrays.h"
#include "emca/recorder/handles.h"
#include "python_renderer.h"
#include "recorded_value.h"
#include "unlocked.h"

namespace emca::python {
namespace {

[[noreturn]] void over() { throw std::runtime_error("the call of the renderer that this belonged to is over"); }

struct PyMonitor {
    std::shared_ptr<Call> call;
    RequestMonitor& get() const { return call->monitor ? *call->monitor : (over(), *call->monitor); }
};

struct PyRecording {
    std::shared_ptr<Call> call;
    Recording& get() const { return call->recording ? *call->recording : (over(), *call->recording); }
};

/// Ours waits for no lock with the interpreter's held: the network thread may want that one for a remark.
template <typename Do>
auto unlocked(const PyMonitor& monitor, const Do& act) {
    RequestMonitor& inside = monitor.get();
    const Unlocked released;
    return act(inside);
}

void preview(const PyMonitor& monitor, std::uint32_t x, std::uint32_t y, py::handle colors) {
    const Numbers numbers = toFloats(colors);
    if (numbers.shape.size() != 3 || numbers.shape[2] != 3) throw py::value_error("a preview has the shape (height, width, 3)");
    std::vector<Color> pixels(numbers.values.size() / 3);
    for (std::size_t i = 0; i < pixels.size(); ++i) pixels[i] = {numbers.values[3 * i], numbers.values[3 * i + 1], numbers.values[3 * i + 2]};
    const PixelRect rect{x, y, x + static_cast<std::uint32_t>(numbers.shape[1]), y + static_cast<std::uint32_t>(numbers.shape[0])};
    unlocked(monitor, [&](RequestMonitor& inside) { inside.preview(rect, pixels); });
}

/// A thread that Python started records while it is inside.
class PyScope {
  public:
    PyScope(std::shared_ptr<Call> call, Pixel pixel) : call_(std::move(call)), pixel_(pixel) {}

    void enter() {
        if (scope_) throw std::runtime_error("this scope was entered already");
        if (!call_->recording) over();
        scope_ = std::make_unique<RecordScope>(*call_->recording, pixel_);
        thread_ = std::this_thread::get_id();
        ++call_->openScopes;
    }
    void exit() {
        if (!scope_) return;
        if (thread_ != std::this_thread::get_id()) throw std::runtime_error("a scope ends in the thread that entered it");
        scope_.reset();
        --call_->openScopes;
    }

  private:
    std::shared_ptr<Call> call_;
    Pixel pixel_;
    std::unique_ptr<RecordScope> scope_;
    std::thread::id thread_;
};

struct PyPath {
    PyRecording recording;
    Pixel pixel;
    std::int64_t sample;
    std::int32_t part;
    PathHandle get() const { return recording.get().path(pixel, sample, part); }
};

struct PyVertex {
    PyPath path;
    std::int32_t depth;
    Subpath subpath;
    VertexHandle get() const { return path.get().vertex(depth, subpath); }
};

/// Adds a value of any type to a handle.
template <typename Handle>
void addValue(const Handle& handle, std::string_view key, py::handle value) {
    std::visit(
        [&](const auto& v) {
            if constexpr (std::is_same_v<std::decay_t<decltype(v)>, std::vector<float>>)
                handle.add(Key(key), std::span<const float>(v));
            else
                handle.add(Key(key), v);
        },
        toValue(value));
}

void bindHandles(py::module_& module) {
    using namespace py::literals;
    const float kNone = std::numeric_limits<float>::quiet_NaN();
    // Every call returns the handle, so that calls can follow each other.
    py::class_<PyVertex>(module, "VertexHandle",
             "A vertex by name. Calls return it, so that they can follow each other.")
        .def("position", [](py::object self, py::handle p) { self.cast<const PyVertex&>().get().position(toVec3(p, "a position")); return self; })
        .def("environment", [](py::object self, py::handle p) { self.cast<const PyVertex&>().get().environment(toVec3(p, "a position")); return self; })
        .def("next_event", [](py::object self, py::handle p, bool visible) { self.cast<const PyVertex&>().get().nextEvent(toVec3(p, "a position"), visible); return self; }, "position"_a, "visible"_a)
        .def("surface", [](py::object self, std::int32_t mesh, std::int32_t face) { self.cast<const PyVertex&>().get().surface(mesh, face); return self; }, "mesh"_a, "face"_a)
        .def("event", [](py::object self, py::handle event, py::handle lobe, std::string_view label) { self.cast<const PyVertex&>().get().event(toEvent(event), toLobe(lobe), label); return self; }, "event"_a, "lobe"_a = "none", "label"_a = "")
        .def("estimate", [](py::object self, py::handle c) { self.cast<const PyVertex&>().get().estimate(toColor(c, "a colour")); return self; })
        .def("emission", [](py::object self, py::handle c) { self.cast<const PyVertex&>().get().emission(toColor(c, "a colour")); return self; })
        .def("contribution", [](py::object self, py::handle c, std::string_view technique, float misWeight, py::handle end) {
                self.cast<const PyVertex&>().get().contribution(toColor(c, "a contribution"), technique, misWeight, toLightEnd(end));
                return self;
            }, "value"_a, "technique"_a, "mis_weight"_a = kNone, "end"_a = "automatic")
        .def("add", [](py::object self, std::string_view key, py::handle value) { addValue(self.cast<const PyVertex&>().get(), key, value); return self; });
    py::class_<PyPath>(module, "PathHandle",
             "A path by name. Calls return it, so that they can follow each other.")
        .def("origin", [](py::object self, py::handle p) { self.cast<const PyPath&>().get().origin(toVec3(p, "a position")); return self; })
        .def("final_estimate", [](py::object self, py::handle c) { self.cast<const PyPath&>().get().finalEstimate(toColor(c, "a colour")); return self; })
        .def("splat", [](py::object self, py::handle pixel, py::handle c) { self.cast<const PyPath&>().get().splat(toPixel(pixel), toColor(c, "a splat")); return self; })
        .def("add", [](py::object self, std::string_view key, py::handle value) { addValue(self.cast<const PyPath&>().get(), key, value); return self; })
        .def("vertex", [](const PyPath& path, std::int32_t depth, py::handle subpath) { return PyVertex{path, depth, toSubpath(subpath)}; }, "depth"_a, "subpath"_a = "camera");
}

}  // namespace

CallArguments::CallArguments(RequestMonitor& monitor, Recording* recording) : call_(std::make_shared<Call>(Call{&monitor, recording})) {}

CallArguments::~CallArguments() {
    Recording* const recording = std::exchange(call_->recording, nullptr);  // nobody begins any more
    while (recording != nullptr && call_->openScopes > 0) {
        const Unlocked unlocked;
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    call_->monitor = nullptr;
}

py::object CallArguments::monitor() const { return py::cast(PyMonitor{call_}); }
py::object CallArguments::recording() const { return py::cast(PyRecording{call_}); }

void bindRendererArguments(py::module_& module) {
    using namespace py::literals;
    py::class_<PyMonitor>(module, "RequestMonitor",
             "How a running call talks to its client. It ends with the call.")
        .def_property_readonly("cancelled", [](const PyMonitor& m) { return unlocked(m, [](RequestMonitor& i) { return i.cancelled(); }); },
             "True as soon as the client cancelled or is gone: raise emca.Cancelled().")
        .def("progress", [](const PyMonitor& m, double fraction) { unlocked(m, [&](RequestMonitor& i) { i.progress(fraction); }); }, "fraction"_a,
             "Done, in [0, 1]; may be called as often as one likes.")
        .def("preview", &preview, "x"_a, "y"_a, "colors"_a,
             "Finished pixels, an array of shape (height, width, 3), whose top-left pixel is (x, y). Optional.")
        .def("begin_pixel", [](const PyMonitor& m, py::handle p) { const Pixel pixel = toPixel(p); unlocked(m, [&](RequestMonitor& i) { i.beginPixel(pixel); }); },
             "Before the replay of a pixel, in a render_pixels of one's own: server tools are told.")
        .def("end_pixel", [](const PyMonitor& m, py::handle p) { const Pixel pixel = toPixel(p); unlocked(m, [&](RequestMonitor& i) { i.endPixel(pixel); }); },
             "After the replay of a pixel.");
    py::class_<PyScope>(module, "RecordScope",
             "A thread that the renderer started records inside it.")
        .def("__enter__", [](py::object self) { self.cast<PyScope&>().enter(); return self; })
        .def("__exit__", [](PyScope& scope, const py::args&) { scope.exit(); });
    bindHandles(module);
    py::class_<PyRecording>(module, "Recording",
             "Where the paths of one call of render_pixel go. It ends with the call.")
        .def("scope", [](const PyRecording& r, py::handle pixel) { return std::make_unique<PyScope>(r.call, toPixel(pixel)); }, "pixel"_a,
             "For threads that the renderer starts: emca.recorder() of a thread listens inside `with recording.scope(pixel):`.")
        .def("path", [](const PyRecording& r, py::handle pixel, std::int64_t sample, std::int32_t part) { r.get(); return PyPath{r, toPixel(pixel), sample, part}; },
             "pixel"_a, "sample"_a, "part"_a = 0,
             "A path by name, for renderers that advance many paths a stage at a time (wavefront).");
}

}  // namespace emca::python
