// Connections to a renderer.
#include "emca/client/connection.h"

#include <pybind11/stl.h>

#include "arrays.h"
#include "bindings.h"
#include "emca/client/dataset.h"
#include "scene.h"
#include "server_info.h"
#include "unlocked.h"
#include "waiting.h"

namespace emca::python {
namespace {

using client::RequestObserver;

/// Keeps the connection open as long as somebody uses it.
class SharedConnection {
  public:
    explicit SharedConnection(std::unique_ptr<client::Connection> connection) : connection_(std::move(connection)) {}
    ~SharedConnection() {
        const Unlocked unlocked;  // its end waits for the network
        connection_.reset();
    }
    SharedConnection(SharedConnection&&) = delete;
    client::Connection& operator*() const { return *connection_; }
    client::Connection* operator->() const { return connection_.get(); }

  private:
    std::unique_ptr<client::Connection> connection_;
};

std::unique_ptr<SharedConnection> connect(const std::string& address, std::string token, double timeout,
                                          double silence) {
    const auto milliseconds = [](double seconds) {
        return std::chrono::milliseconds(static_cast<std::int64_t>(seconds * 1000));
    };
    const client::Address where = unwrap(client::Address::parse(address));
    client::Connection::Options options;
    options.token = std::move(token);
    options.connectTimeout = milliseconds(timeout);
    options.silenceTimeout = milliseconds(silence);
    using Opened = Result<std::unique_ptr<client::Connection>>;
    const auto opened = std::make_shared<std::optional<Opened>>();
    runOrAbandon([opened, where, options] { opened->emplace(client::Connection::open(where, options)); });
    return std::make_unique<SharedConnection>(unwrap(std::move(**opened)));
}

py::tuple render(const SharedConnection& connection, std::uint32_t samplesPerPixel, std::optional<std::uint64_t> seed,
                 std::string integrator, std::string sampler, std::vector<std::string> layers,
                 std::uint64_t surfaceBudget, const py::object& progress) {
    client::RenderOptions options;
    options.samplesPerPixel = samplesPerPixel;
    options.hasSeed = seed.has_value();
    options.seed = seed.value_or(0);
    options.integrator = std::move(integrator);
    options.sampler = std::move(sampler);
    options.preview = false;
    options.layers = std::move(layers);
    options.surfaceBudget = surfaceBudget;
    client::Render done =
        await([&](const RequestObserver& observer) { return connection->render(options, observer); }, progress);
    py::list collected;
    for (const LayerDescription& layer : done.layers) collected.append(toText(layer.name));
    auto entry = std::make_shared<client::ImageEntry>();
    entry->title = "render " + std::to_string(done.id);
    entry->image = std::make_shared<const RenderedImage>(std::move(done.image));
    entry->renderId = done.id;
    entry->samplesPerPixel = done.samplesPerPixel;
    entry->seed = done.seed;
    entry->integrator = std::move(done.integrator);
    entry->sampler = std::move(done.sampler);
    return py::make_tuple(entry, done.seconds, collected);
}

/// What emca/connection.py passes as one dictionary.
client::TraceOptions traceOptions(const py::dict& given) {
    client::TraceOptions options;
    options.samplesPerPixel = given["spp"].cast<std::uint32_t>();
    options.integrator = given["integrator"].cast<std::string>();
    options.sampler = given["sampler"].cast<std::string>();
    options.hasSeed = !given["seed"].is_none();
    if (options.hasSeed) options.seed = given["seed"].cast<std::uint64_t>();
    options.columns = given["columns"].cast<std::vector<std::string>>();
    options.query = given["where"].cast<std::string>();
    options.keep = static_cast<KeepMatches>(given["keep"].cast<int>());
    options.keepCount = given["top"].cast<std::uint32_t>();
    options.budget = given["budget"].cast<std::uint64_t>();
    options.locations = given["locations"].cast<bool>();
    if (const py::object render = given["render"]; !render.is_none()) {
        options.against = client::VerdictAgainst::renderId;
        options.renderId = render.cast<std::uint64_t>();
    }
    return options;
}

using SharedTrace = std::shared_ptr<client::Trace>;
SharedTrace shared(client::Trace trace) { return std::make_shared<client::Trace>(std::move(trace)); }

SharedTrace tracePixel(const SharedConnection& connection, std::uint32_t x, std::uint32_t y, const py::dict& given,
                       const py::object& progress) {
    const client::TraceOptions options = traceOptions(given);
    return shared(await(
        [&](const RequestObserver& observer) {
            return connection->tracePixel({x, y}, options, observer);
        },
        progress));
}

SharedTrace tracePixels(const SharedConnection& connection, py::handle pixels, const py::dict& given,
                        const py::object& progress) {
    const client::TraceOptions options = traceOptions(given);
    const std::vector<std::uint32_t> numbers = toIndices(pixels);
    std::vector<Pixel> chosen(numbers.size() / 2);
    for (std::size_t i = 0; i < chosen.size(); ++i) chosen[i] = {numbers[2 * i], numbers[2 * i + 1]};
    return shared(await(
        [&](const RequestObserver& observer) { return connection->tracePixels(chosen, options, observer); }, progress));
}

SharedTrace traceRect(const SharedConnection& connection, std::array<std::uint32_t, 4> rect, const py::dict& given,
                      const py::object& progress) {
    const client::TraceOptions options = traceOptions(given);
    const PixelRect chosen{rect[0], rect[1], rect[2], rect[3]};
    return shared(await(
        [&](const RequestObserver& observer) { return connection->traceRect(chosen, options, observer); }, progress));
}

SharedField surface(const SharedConnection& connection, std::uint64_t renderId, const std::vector<std::string>& layers,
                    const py::object& progress) {
    SurfaceField field = await(
        [&](const RequestObserver& observer) { return connection->surface(renderId, layers, observer); }, progress);
    return {std::make_shared<const SurfaceField>(std::move(field))};
}

py::list meshes(const SharedConnection& connection, const py::object& progress) {
    auto all = await([&](const RequestObserver& observer) { return connection->meshes(observer); }, progress);
    return toList(std::make_shared<const std::vector<Mesh>>(std::move(all)));
}

py::bytes askTool(const SharedConnection& connection, const std::string& tool, const std::string& request,
                  const py::object& progress) {
    const std::span bytes(reinterpret_cast<const std::byte*>(request.data()), request.size());
    const auto answer =
        await([&](const RequestObserver& observer) { return connection->askTool(tool, bytes, observer); }, progress);
    return py::bytes(reinterpret_cast<const char*>(answer.data()), answer.size());
}

}  // namespace

void bindConnection(py::module_& module) {
    bindServerInfo(module);
    module.def("connect", &connect);
    py::class_<SharedConnection>(module, "Connection")
        .def("address", [](const SharedConnection& c) { return c->address().text(); })
        .def("is_open", [](const SharedConnection& c) { return c->isOpen(); })
        .def("close",
             [](const SharedConnection& c) {
                 const Unlocked unlocked;
                 c->close();
             })
        .def("info", [](const SharedConnection& c) { return await([&](const RequestObserver&) { return c->info(); }); })
        .def("camera",
             [](const SharedConnection& c) {
                 return toDict(await([&](const RequestObserver&) { return c->camera(); }));
             })
        .def("quit_server",
             [](const SharedConnection& c) { await([&](const RequestObserver&) { return c->quitServer(); }); })
        .def("meshes", &meshes)
        .def("render", &render)
        .def("surface", &surface)
        .def("trace_pixel", &tracePixel)
        .def("trace_pixels", &tracePixels)
        .def("trace_rect", &traceRect)
        .def("ask_tool", &askTool);
}

}  // namespace emca::python
