#include "published_for_tests.h"

#include <sys/socket.h>

#include <algorithm>

namespace emca::bridge::test {

namespace {

void write(Writer& out, const PublishedData& data) {
    out.u32(static_cast<std::uint32_t>(data.size()));
    for (const auto& [key, value] : data) {
        out.text(key);
        struct Visitor {
            Writer& out;
            void operator()(bool v) { out.letters("?").boolean(v); }
            void operator()(std::int64_t v) { out.letters("i").add(std::int32_t(v)); }
            void operator()(const Vec2i& v) { out.letters("2i").add(std::int32_t(v.x)).add(std::int32_t(v.y)); }
            void operator()(const Vec3i& v) { out.letters("3i").add(std::int32_t(v.x)).add(std::int32_t(v.y)).add(std::int32_t(v.z)); }
            void operator()(float v) { out.letters("f").add(v); }
            void operator()(const Vec2f& v) { out.letters("2f").add(v.x).add(v.y); }
            void operator()(const Vec3f& v) { out.letters("3f").vector(v); }
            void operator()(double v) { out.letters("d").add(v); }
            void operator()(const ColorA& v) { out.letters("4f").color(v); }
            void operator()(const std::string& v) { out.letters("s").text(v); }
            void operator()(const Vec2d&) { std::abort(); }  // published servers have no others
            void operator()(const Vec3d&) { std::abort(); }
            void operator()(const Color&) { std::abort(); }
            void operator()(const std::vector<float>&) { std::abort(); }
        };
        std::visit(Visitor{out}, value);
    }
}

void write(Writer& out, const std::optional<ColorA>& color) {
    out.boolean(color.has_value());
    if (color) out.color(*color);
}

void write(Writer& out, const PublishedShape& shape) {
    if (shape.sphere) {
        out.id(1).add(shape.sphere->radius).vector(shape.sphere->centre);
    } else {
        out.id(0).u32(static_cast<std::uint32_t>(shape.positions.size()));
        for (const Vec3f& p : shape.positions) out.vector(p);
        out.u32(static_cast<std::uint32_t>(shape.triangles.size()));
        for (const Triangle& t : shape.triangles) out.u32(t[0]).u32(t[1]).u32(t[2]);
        out.u32(static_cast<std::uint32_t>(shape.faceColors.size()));
        for (const Color& c : shape.faceColors) out.add(c.r).add(c.g).add(c.b);
    }
    out.color(shape.diffuse).color(shape.specular);
}

}  // namespace

void write(Writer& out, const PublishedInfo& info) { out.text(info.renderer).text(info.scene).u32(info.samplesPerPixel); }

void write(Writer& out, const PublishedCamera& c) {
    out.vector(c.origin).vector(c.direction).vector(c.up).add(c.nearClip).add(c.farClip).add(c.fieldOfView);
}

void write(Writer& out, const PublishedScene& scene) {
    out.boolean(scene.heatMap.has_value());
    if (scene.heatMap) out.text(scene.heatMap->colorMap).boolean(scene.heatMap->colorBar).text(scene.heatMap->label);
    out.u32(static_cast<std::uint32_t>(scene.shapes.size()));
    for (const PublishedShape& shape : scene.shapes) write(out, shape);
}

void write(Writer& out, const PublishedPath& path) {
    write(out, path.data);
    out.u32(path.sample).u32(path.depth).vector(path.origin);
    write(out, path.estimate);
    out.u32(static_cast<std::uint32_t>(path.intersections.size()));
    for (const PublishedIntersection& at : path.intersections) {
        write(out, at.data);
        out.u32(at.depth).boolean(at.position.has_value());
        if (at.position) out.vector(*at.position);
        out.boolean(at.nextEvent.has_value());
        if (at.nextEvent) out.vector(at.nextEvent->position).boolean(at.nextEvent->visible);
        write(out, at.estimate);
        write(out, at.emission);
    }
}

void write(Writer& out, std::uint32_t announced, const std::vector<PublishedPath>& paths) {
    out.u32(announced);
    for (const PublishedPath& path : paths) write(out, path);
}

std::vector<PublishedPath> examplePaths(Pixel pixel, std::uint32_t samples) {
    std::vector<PublishedPath> paths;
    for (std::uint32_t sample = 0; sample < samples; ++sample) {
        if (sample == 2) continue;  // a gap
        const float f = float(sample) + 0.25f;
        PublishedPath path;
        path.sample = sample;
        path.origin = {float(pixel.x), float(pixel.y), f};
        if (sample == 3) {  // a path with nothing
            path.depth = kNoDepth;
            paths.push_back(path);
            continue;
        }
        path.depth = 5;
        path.data = {{"left scene", true}, {"time", 0.5 + sample}, {"name", std::string("sample ") + std::to_string(sample)}};
        path.estimate = ColorA{f, 2 * f, 0.5f, 1};
        PublishedIntersection first;
        first.depth = 1;
        first.position = Vec3f{f, -f, 0};
        first.nextEvent = {{0, 1, f}, sample % 2 == 0};
        first.estimate = ColorA{0.5f * f, f, 0.25f, 1};
        first.data = {{"bsdf", 0.5f * f}, {"depth left", std::int64_t(-7)}, {"random", Vec2f{0.1f, 0.2f}}, {"cell", Vec2i{3, -4}},
                      {"voxel", Vec3i{1, 2, -3}}, {"normal", Vec3f{0, 1, 0}}, {"weight", ColorA{1, 0.5f, 0.25f, 0.75f}},
                      {"material", std::string("glass")}, {"pdf", 0.125}, {"hit", false}};
        PublishedIntersection second;  // depths have gaps too
        second.depth = 5;
        second.position = Vec3f{1, f, 2};
        second.emission = ColorA{3, 2, 1, 0.5f};
        path.intersections = {first, second};
        paths.push_back(path);
    }
    return paths;
}

Show exampleShow() {
    Show show;
    show.info.samplesPerPixel = 6;
    show.paths = examplePaths;
    PublishedShape square;
    square.positions = {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}};
    square.triangles = {{0, 1, 2}, {0, 2, 3}};
    square.diffuse = {0.8f, 0.4f, 0.2f, 1};
    square.specular = {0, 0, 0, 1};
    PublishedShape ball;
    ball.sphere = PublishedSphere{{0, 0, 2}, 0.5f};
    ball.diffuse = {0, 0, 0, 1};
    ball.specular = {0.9f, 0.9f, 0.5f, 1};
    show.scene.shapes = {square, ball};

    // The first triangle divided, and the one in its middle again: the order in which published servers send faces.
    PublishedShape map = square;
    map.positions.insert(map.positions.end(), {{1, 0, 0}, {0, 0, 0}, {0, -1, 0}, {0.5f, 0, 0}, {0, -0.5f, 0}, {0.5f, -0.5f, 0}});
    map.triangles = {{0, 2, 3}, {0, 6, 5}, {1, 4, 6}, {2, 5, 4}, {4, 7, 9}, {5, 8, 7}, {6, 9, 8}, {7, 8, 9}};
    for (std::size_t i = 0; i < map.triangles.size(); ++i) map.faceColors.emplace_back(float(i + 1));
    map.faceColors[3] = {1, 2, 3};
    PublishedScene heatMap;
    heatMap.heatMap = PublishedScene::HeatMap{"plasma", "samples", true};
    heatMap.shapes = {map, ball};
    show.heatMap = heatMap;
    return show;
}

PublishedServerForTests::PublishedServerForTests(Show show) : show_(std::move(show)) {
    acceptor_.open(asio::ip::tcp::v4());
    acceptor_.bind({asio::ip::address_v4::loopback(), 0});
    acceptor_.listen();
    port_ = acceptor_.local_endpoint().port();
    thread_ = std::thread([this] { serve(); });
}

PublishedServerForTests::~PublishedServerForTests() {
    ending_ = true;
    {
        const std::lock_guard lock(mutex_);
        if (acceptor_.is_open()) ::shutdown(acceptor_.native_handle(), SHUT_RDWR);  // wakes who waits there
        if (socket_.is_open()) ::shutdown(socket_.native_handle(), SHUT_RDWR);
    }
    thread_.join();
}

std::vector<std::int16_t> PublishedServerForTests::requests() const {
    const std::lock_guard lock(mutex_);
    return requests_;
}

std::vector<std::array<std::uint32_t, 3>> PublishedServerForTests::pixels() const {
    const std::lock_guard lock(mutex_);
    return pixels_;
}

void PublishedServerForTests::serve() {
    while (!ending_ && !quit_) {
        std::error_code error;
        asio::ip::tcp::socket accepted(context_);
        acceptor_.accept(accepted, error);
        if (error) return;
        {
            const std::lock_guard lock(mutex_);
            socket_ = std::move(accepted);
        }
        ++connections_;
        sent_ = 0;
        namesAnswered_ = 0;
        if (!ending_) talk();
        const std::lock_guard lock(mutex_);
        socket_.close(error);
    }
    const std::lock_guard lock(mutex_);
    acceptor_.close();
}

template <typename T>
bool PublishedServerForTests::receive(T& value) {
    std::array<std::byte, sizeof(T)> raw{};
    std::error_code error;
    asio::read(socket_, asio::buffer(raw), error);
    if (show_.swapped) std::reverse(raw.begin(), raw.end());
    value = std::bit_cast<T>(raw);
    return !error;
}

bool PublishedServerForTests::send(std::int16_t id, std::vector<std::byte> message) {
    if (show_.alter) show_.alter(id, message);
    const std::size_t limit = std::min(show_.silentAfter, show_.closedAfter);
    const std::size_t bytes = std::min(message.size(), limit - std::min<std::size_t>(limit, sent_));
    std::error_code error;
    asio::write(socket_, asio::buffer(message.data(), bytes), error);
    sent_ += bytes;
    return !error && (bytes == message.size() || show_.silentAfter != SIZE_MAX);
}

void PublishedServerForTests::talk() {
    std::int16_t id = 0;
    if (!send(MessageId::hello, Writer(show_.swapped).id(show_.hello).bytes()) || !receive(id) || id != MessageId::hello) return;
    Writer plugins(show_.swapped);
    plugins.id(MessageId::plugins).u32(static_cast<std::uint32_t>(show_.plugins.size()));
    for (const std::int16_t plugin : show_.plugins) plugins.id(plugin);
    if (!send(MessageId::plugins, plugins.bytes())) return;
    for (int answered = 0; answered < show_.restsAfter && receive(id);) {
        if (id == MessageId::disconnect || id == MessageId::quit) {
            ++goodbyes_;
            quit_ = quit_ || id == MessageId::quit;
            (void)send(MessageId::disconnect, Writer(show_.swapped).id(MessageId::disconnect).bytes());
            return;
        }
        if (!answer(id)) return;
        // A request and that for the names behind it are one.
        if (id == MessageId::requestInfo && ++namesAnswered_ > 1) ++answered;
    }
}

bool PublishedServerForTests::answer(std::int16_t id) {
    std::array<std::uint32_t, 3> numbers{};
    const int count = id == MessageId::requestPixel ? 3 : id == MessageId::requestImage ? 1 : 0;
    for (int i = 0; i < count; ++i)
        if (!receive(numbers[std::size_t(i)])) return false;
    if (id != MessageId::requestInfo) {
        const std::lock_guard lock(mutex_);
        requests_.push_back(id);
        if (id == MessageId::requestPixel) pixels_.push_back(numbers);
    }
    if (show_.unanswered[id]) return true;
    if (id == MessageId::requestInfo && show_.namesOnce && namesAnswered_ > 0) return true;
    Writer out(show_.swapped);
    const auto reply = static_cast<std::int16_t>(id + 0x10);
    out.id(reply);
    switch (id) {
    case MessageId::requestInfo: write(out, show_.info); break;
    case MessageId::requestCamera: write(out, show_.camera); break;
    case MessageId::requestScene: write(out, heatMapReady_ ? *show_.heatMap : show_.scene); break;
    case MessageId::requestImage:
        if (show_.rendering) show_.rendering();
        out.text(show_.imagePath);
        break;
    case MessageId::requestPixel: {
        const auto paths = show_.paths({numbers[0], numbers[1]}, numbers[2]);
        write(out, static_cast<std::uint32_t>(paths.size()) + show_.tooMany, paths);
        break;
    }
    default: return true;
    }
    if (!send(reply, out.bytes())) return false;
    if (id != MessageId::requestImage || !show_.heatMap) return true;
    heatMapReady_ = true;
    Writer map(show_.swapped);
    map.id(MessageId::scene);
    write(map, *show_.heatMap);
    return send(MessageId::scene, map.bytes());
}

}  // namespace emca::bridge::test
