// A renderer in Python, served.
#include "emca/server/server.h"

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <mutex>
#include <thread>

#include "arrays.h"
#include "bindings.h"
#include "emca/core/seed_map.h"
#include "errors.h"
#include "python_renderer.h"
#include "recorded_value.h"
#include "unlocked.h"

namespace emca::python {
namespace {

using Clock = std::chrono::steady_clock;

/// A server, the renderer behind it, and a thread that knows when it has ended.
class Serving {
  public:
    /// With the interpreter's lock, which is let go while the server starts.
    Serving(const py::object& adapter, ServerOptions options) : renderer_(adapter) {
        const Unlocked unlocked;
        server_ = unwrap(Server::start(renderer_, std::move(options)));
        watcher_ = std::thread([this] {
            server_->wait();
            const std::lock_guard lock(mutex_);
            ended_ = true;
            changed_.notify_all();
        });
    }
    /// Without the interpreter's lock: the server's threads may need it to come to their end.
    ~Serving() {
        if (server_) server_->stop();
        if (watcher_.joinable()) watcher_.join();
    }
    Serving(const Serving&) = delete;
    Serving& operator=(const Serving&) = delete;

    Server& server() { return *server_; }
    /// \return whether the server has ended
    bool waitUntil(Clock::time_point end) {
        std::unique_lock lock(mutex_);
        return changed_.wait_until(lock, end, [this] { return ended_; });
    }

  private:
    PythonRenderer renderer_;
    std::unique_ptr<Server> server_;
    std::mutex mutex_;
    std::condition_variable changed_;
    bool ended_ = false;
    std::thread watcher_;
};

/// As Python holds it.
class PythonServer {
  public:
    PythonServer(const py::object& adapter, ServerOptions options)
        : serving_(std::make_unique<Serving>(adapter, std::move(options))) {}
    ~PythonServer() {
        if (PythonRenderer::insideCall()) {
            // Whoever drops the last reference inside the renderer's own call cannot wait for that call.
            std::thread([serving = std::move(serving_)]() mutable { serving.reset(); }).detach();
            return;
        }
        const Unlocked unlocked;
        serving_.reset();
    }
    PythonServer(const PythonServer&) = delete;
    PythonServer& operator=(const PythonServer&) = delete;

    std::uint16_t port() const { return serving_->server().port(); }
    std::string address() const { return serving_->server().address(); }

    void stop() {
        if (PythonRenderer::insideCall()) {
            throw Failure(
                Error{ErrorCode::invalidArgument,
                      "A renderer asked its server to stop inside one of its own calls, and the server waits for "
                      "those: call stop() from another thread."});
        }
        const Unlocked unlocked;
        serving_->server().stop();
    }

    /// \param seconds  negative: no limit
    bool wait(double seconds) {
        constexpr double kForever = 1e8;
        const std::chrono::duration<double> limit(seconds < 0 ? kForever : std::min(seconds, kForever));
        const auto end = Clock::now() + std::chrono::duration_cast<Clock::duration>(limit);
        for (;;) {
            const bool ended = waitALittle(end);
            if (PyErr_CheckSignals() != 0) throw py::error_already_set();
            if (ended || Clock::now() >= end) return ended;
        }
    }

  private:
    bool waitALittle(Clock::time_point end) {
        const Unlocked unlocked;
        return serving_->waitUntil(std::min(end, Clock::now() + std::chrono::milliseconds(50)));
    }

    std::unique_ptr<Serving> serving_;
};

/// What emca/renderer.py passes as one dictionary.
ServerOptions serverOptions(const py::dict& given) {
    ServerOptions options;
    options.host = given["host"].cast<std::string>();
    options.port = given["port"].cast<std::uint16_t>();
    options.token = given["token"].cast<std::string>();
    options.allowQuit = given["allow_quit"].cast<bool>();
    // The function lives as long as the process: the server's threads may let go of their copies without the lock.
    const py::handle log = given["log"].cast<py::object>().release();
    if (!log.is_none()) {
        options.log = [log](const std::string& remark) {
            const py::gil_scoped_acquire lock;
            try {
                log(toText(remark));
            } catch (py::error_already_set& exception) {
                exception.discard_as_unraisable("a log function of emca.serve");
            }
        };
    }
    return options;
}

}  // namespace

void bindServer(py::module_& module) {
    using namespace py::literals;
    bindRendererArguments(module);
    py::class_<PythonServer>(module, "Server")
        .def(py::init([](const py::object& adapter, const py::dict& options) {
            return std::make_unique<PythonServer>(adapter, serverOptions(options));
        }))
        .def("port", &PythonServer::port)
        .def("address", &PythonServer::address)
        .def("stop", &PythonServer::stop)
        .def("wait", &PythonServer::wait);
    py::class_<SeedMap>(module, "SeedMap",
                        "Gives each (pixel, sample) its seed, by hash at no storage: more samples per pixel extend the "
                        "paths and change none.")
        .def(py::init<std::uint64_t>(), "master_seed"_a = 0)
        .def(
            "seed",
            [](const SeedMap& map, py::handle pixel, std::uint64_t sample) { return map.seed(toPixel(pixel), sample); },
            "pixel"_a, "sample"_a, "64 bits.");
}

}  // namespace emca::python
