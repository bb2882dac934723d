// Row "transfer" of docs/performance.md: a traced pixel of 1024 paths with 8 vertices each, every vertex with a string,
// 2 floats, 3 colours, a 2D and a 3D value, a shadow test and an estimate, from the recorded paths at the server to the
// decoded paths at the client.
#include <benchmark/benchmark.h>

#include <array>
#include <asio.hpp>
#include <cstdlib>
#include <iostream>
#include <thread>

#include "emca/client/connection.h"
#include "emca/protocol/codec.h"
#include "emca/recorder/recorder.h"
#include "emca/server/server.h"

namespace {

using namespace emca;
using asio::ip::tcp;

constexpr int kPaths = 1024, kVertices = 8;

Color recordPixel() {
    PathRecorder& emca = recorder();
    Color sum;
    for (int path = 0; path < kPaths; ++path) {
        emca.setPathIndex(path);
        emca.setPathOrigin(Vec3f{0, 0, 0});
        for (int depth = 1; depth <= kVertices; ++depth) {
            const float f = static_cast<float>(path * kVertices + depth);
            emca.setDepthIndex(depth);
            emca.setIntersectionPos(Vec3f{f, f, f});
            emca.setNextEventEstimationPos(Vec3f{f, f, 0}, depth % 2 == 0);
            emca.setIntersectionEstimate(Color(f));
            emca.addIntersectionData("material", std::string_view(depth % 2 == 0 ? "glass" : "wall"));
            emca.addIntersectionData("bsdf pdf", f);
            emca.addIntersectionData("light pdf", 2 * f);
            emca.addIntersectionData("throughput", Color(f));
            emca.addIntersectionData("bsdf weight", Color(f));
            emca.addIntersectionData("light value", Color(f));
            emca.addIntersectionData("random numbers", Vec2f{f, f});
            emca.addIntersectionData("normal", Vec3f{0, 0, 1});
        }
        const Color value(static_cast<float>(path));
        emca.setFinalEstimate(value);
        sum += value;
    }
    return sum / static_cast<float>(kPaths);
}

/// Fails loudly: a benchmark of an error would look fast.
template <typename T>
T must(Result<T> result) {
    if (!result) {
        std::cerr << result.error().message << '\n';
        std::abort();
    }
    return std::move(result).value();
}

protocol::Message tracedPixel() {
    Recording recording;
    protocol::TraceResult result;
    {
        const RecordScope scope(recording, Pixel{1, 1});
        result.replays = {{Verdict::exact, SumCheck::matches, {}, recordPixel()}};
    }
    result.pixels = {{1, 1}};
    result.paths = must(recording.finish());
    return {1, std::move(result)};
}

void send(tcp::socket& socket, const protocol::Frame& frame) {
    const auto header = protocol::header(frame);
    asio::write(socket, std::array<asio::const_buffer, 2>{asio::buffer(header), asio::buffer(frame.data(), frame.size())});
}

protocol::Message receive(tcp::socket& socket) {
    std::array<std::byte, protocol::kHeaderBytes> header{};
    asio::read(socket, asio::buffer(header));
    const std::size_t size = must(protocol::payloadBytes(header, protocol::kMaximumReplyBytes));
    const auto payload = must(protocol::allocatePayload(size));
    asio::read(socket, asio::buffer(payload.get(), size));
    return must(protocol::decode(protocol::Frame(payload, payload.get(), size)));
}

/// Encoding, one message through a socket of this machine, decoding.
void transferOverLoopback(benchmark::State& state) {
    const protocol::Message message = tracedPixel();
    asio::io_context context;
    tcp::acceptor acceptor(context, {asio::ip::address_v4::loopback(), 0});
    tcp::socket near(context), far(context);
    near.connect(acceptor.local_endpoint());
    acceptor.accept(far);
    near.set_option(tcp::no_delay(true));
    std::thread server([&] {
        std::array<char, 1> click{};
        std::error_code error;
        for (;;) {
            asio::read(far, asio::buffer(click), error);
            if (error) return;
            send(far, must(protocol::encode(message)));
        }
    });
    std::size_t vertices = 0;
    for (auto _ : state) {
        asio::write(near, asio::buffer("x", 1));
        const protocol::Message received = receive(near);
        vertices = std::get<protocol::TraceResult>(received.body).paths.vertexCount();
        benchmark::DoNotOptimize(vertices);
    }
    near.close();
    server.join();
    if (vertices != std::size_t(kPaths) * kVertices) state.SkipWithError("the paths did not arrive");
    state.SetBytesProcessed(static_cast<std::int64_t>(state.iterations() * must(protocol::encode(message)).size()));
}
BENCHMARK(transferOverLoopback)->Unit(benchmark::kMillisecond)->UseRealTime();

void encodeOnly(benchmark::State& state) {
    const protocol::Message message = tracedPixel();
    for (auto _ : state) benchmark::DoNotOptimize(must(protocol::encode(message)).data());
}
BENCHMARK(encodeOnly)->Unit(benchmark::kMillisecond);

void decodeOnly(benchmark::State& state) {
    const protocol::Frame frame = must(protocol::encode(tracedPixel()));
    for (auto _ : state) benchmark::DoNotOptimize(must(protocol::decode(frame)).request);
}
BENCHMARK(decodeOnly)->Unit(benchmark::kMillisecond);

class RecordingRenderer final : public Renderer {
  public:
    RendererInfo info() const override {
        RendererInfo info;
        info.width = info.height = 4;
        info.samplesPerPixel = kPaths;
        info.concurrent = true;
        return info;
    }
    Camera camera() const override { return {}; }
    std::vector<Mesh> meshes() const override { return {}; }
    Result<RenderedImage> renderImage(const RenderSettings&, RequestMonitor&) override { return RenderedImage(); }
    Result<Color> renderPixel(Pixel, const RenderSettings&, Recording&, RequestMonitor&) override { return recordPixel(); }
};

/// The whole way of a click through server and client, less the renderer's own time: putting the recording in order,
/// the sum check, and the transfer.
void traceThroughServerAndClient(benchmark::State& state) {
    RecordingRenderer renderer;
    const auto server = must(Server::start(renderer));
    const auto connection = must(client::Connection::open({"127.0.0.1", server->port()}));
    for (auto _ : state) {
        const client::Trace trace = must(connection->tracePixel({1, 1}));
        if (trace.replays[0].sums != SumCheck::matches) state.SkipWithError("the paths do not add up");
        state.SetIterationTime(trace.totalSeconds - trace.renderSeconds);
    }
}
BENCHMARK(traceThroughServerAndClient)->Unit(benchmark::kMillisecond)->UseManualTime();

}  // namespace

BENCHMARK_MAIN();
