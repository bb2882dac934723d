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
    if (numbers.shape.size() != 3 || numbers.shape[2] != 3)
        throw py::value_error("a preview has the shape (height, width, 3)");
    std::vector<Color> pixels(numbers.values.size() / 3);
    for (std::size_t i = 0; i < pixels.size(); ++i)
        pixels[i] = {numbers.values[3 * i], numbers.values[3 * i + 1], numbers.values[3 * i + 2]};
    const PixelRect rect{x, y, x + static_cast<std::uint32_t>(numbers.shape[1]),
                         y + static_cast<std::uint32_t>(numbers.shape[0])};
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
        if (thread_ != std::this_thread::get_id())
            throw std::runtime_error("a scope ends in the thread that entered it");
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

/// A call on what a handle names, which returns the handle, so that calls can follow each other.
template <typename Handle, typename... Arguments, typename Act>
auto chained(Act act) {
    return [act](const py::object& self, Arguments... arguments) {
        act(self.cast<const Handle&>().get(), arguments...);
        return self;
    };
}

void bindVertexHandle(py::module_& module) {
    using namespace py::literals;
    using V = const VertexHandle&;
    const auto withPosition = [](auto set) {
        return chained<PyVertex, py::handle>([set](V v, py::handle p) { set(v, toVec3(p, "a position")); });
    };
    const auto withColor = [](auto set) {
        return chained<PyVertex, py::handle>([set](V v, py::handle c) { set(v, toColor(c, "a colour")); });
    };
    const float kNone = std::numeric_limits<float>::quiet_NaN();
    py::class_<PyVertex>(module, "VertexHandle",
                         "A vertex by name. Calls return it, so that they can follow each other.")
        .def("position", withPosition([](V v, Vec3f p) { v.position(p); }), "position"_a)
        .def("environment", withPosition([](V v, Vec3f p) { v.environment(p); }), "position"_a)
        .def("estimate", withColor([](V v, Color c) { v.estimate(c); }), "estimate"_a)
        .def("emission", withColor([](V v, Color c) { v.emission(c); }), "emission"_a)
        .def("next_event", chained<PyVertex, py::handle, bool>([](V v, py::handle p, bool visible) {
                 v.nextEvent(toVec3(p, "a position"), visible);
             }),
             "position"_a, "visible"_a)
        .def("surface", chained<PyVertex, std::int32_t, std::int32_t>([](V v, std::int32_t mesh, std::int32_t face) {
                 v.surface(mesh, face);
             }),
             "mesh"_a, "face"_a)
        .def("event",
             chained<PyVertex, py::handle, py::handle, std::string_view>(
                 [](V v, py::handle event, py::handle lobe, std::string_view label) {
                     v.event(toEvent(event), toLobe(lobe), label);
                 }),
             "event"_a, "lobe"_a = "none", "label"_a = "")
        .def("contribution",
             chained<PyVertex, py::handle, std::string_view, float, py::handle>(
                 [](V v, py::handle c, std::string_view technique, float misWeight, py::handle end) {
                     v.contribution(toColor(c, "a contribution"), technique, misWeight, toLightEnd(end));
                 }),
             "value"_a, "technique"_a, "mis_weight"_a = kNone, "end"_a = "automatic")
        .def("add", chained<PyVertex, std::string_view, py::handle>([](V v, std::string_view key, py::handle value) {
                 addValue(v, key, value);
             }),
             "key"_a, "value"_a);
}

void bindPathHandle(py::module_& module) {
    using namespace py::literals;
    using P = const PathHandle&;
    py::class_<PyPath>(module, "PathHandle", "A path by name. Calls return it, so that they can follow each other.")
        .def("origin", chained<PyPath, py::handle>([](P path, py::handle p) { path.origin(toVec3(p, "a position")); }),
             "position"_a)
        .def("final_estimate",
             chained<PyPath, py::handle>([](P path, py::handle c) { path.finalEstimate(toColor(c, "a colour")); }),
             "estimate"_a)
        .def("splat", chained<PyPath, py::handle, py::handle>([](P path, py::handle pixel, py::handle c) {
                 path.splat(toPixel(pixel), toColor(c, "a splat"));
             }),
             "pixel"_a, "value"_a)
        .def("add", chained<PyPath, std::string_view, py::handle>([](P path, std::string_view key, py::handle value) {
                 addValue(path, key, value);
             }),
             "key"_a, "value"_a)
        .def(
            "vertex",
            [](const PyPath& path, std::int32_t depth, py::handle subpath) {
                return PyVertex{path, depth, toSubpath(subpath)};
            },
            "depth"_a, "subpath"_a = "camera");
}

}  // namespace

CallArguments::CallArguments(RequestMonitor& monitor, Recording* recording)
    : call_(std::make_shared<Call>(Call{&monitor, recording})) {}

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
    py::class_<PyMonitor>(module, "RequestMonitor", "How a running call talks to its client. It ends with the call.")
        .def_property_readonly(
            "cancelled",
            [](const PyMonitor& m) { return unlocked(m, [](RequestMonitor& i) { return i.cancelled(); }); },
            "True as soon as the client cancelled or is gone: raise emca.Cancelled().")
        .def(
            "progress",
            [](const PyMonitor& m, double fraction) { unlocked(m, [&](RequestMonitor& i) { i.progress(fraction); }); },
            "fraction"_a, "Done, in [0, 1]; may be called as often as one likes.")
        .def("preview", &preview, "x"_a, "y"_a, "colors"_a,
             "Finished pixels, an array of shape (height, width, 3), whose top-left pixel is (x, y). Optional.")
        .def(
            "begin_pixel",
            [](const PyMonitor& m, py::handle p) {
                const Pixel pixel = toPixel(p);
                unlocked(m, [&](RequestMonitor& i) { i.beginPixel(pixel); });
            },
            "Before the replay of a pixel, in a render_pixels of one's own: server tools are told.")
        .def(
            "end_pixel",
            [](const PyMonitor& m, py::handle p) {
                const Pixel pixel = toPixel(p);
                unlocked(m, [&](RequestMonitor& i) { i.endPixel(pixel); });
            },
            "After the replay of a pixel.");
    py::class_<PyScope>(module, "RecordScope", "A thread that the renderer started records inside it.")
        .def("__enter__",
             [](py::object self) {
                 self.cast<PyScope&>().enter();
                 return self;
             })
        .def("__exit__", [](PyScope& scope, const py::args&) { scope.exit(); });
    bindVertexHandle(module);
    bindPathHandle(module);
    py::class_<PyRecording>(module, "Recording",
                            "Where the paths of one call of render_pixel go. It ends with the call.")
        .def(
            "scope",
            [](const PyRecording& r, py::handle pixel) { return std::make_unique<PyScope>(r.call, toPixel(pixel)); },
            "pixel"_a,
            "For threads that the renderer starts: emca.recorder() of a thread listens inside `with "
            "recording.scope(pixel):`.")
        .def(
            "path",
            [](const PyRecording& r, py::handle pixel, std::int64_t sample, std::int32_t part) {
                r.get();
                return PyPath{r, toPixel(pixel), sample, part};
            },
            "pixel"_a, "sample"_a, "part"_a = 0,
            "A path by name, for renderers that advance many paths a stage at a time (wavefront).");
}

}  // namespace emca::python
