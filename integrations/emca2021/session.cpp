#include "session.h"

#include <array>
#include <utility>

namespace emca::bridge {

namespace {

std::string name(std::int16_t id) {
    switch (id) {
    case MessageId::requestImage: return "the image";
    case MessageId::requestPixel: return "a pixel";
    case MessageId::requestCamera: return "the camera";
    case MessageId::requestScene: return "the scene";
    default: return "its names";
    }
}

}  // namespace

std::shared_ptr<PublishedServer::Session::Open> PublishedServer::Session::current() const {
    const std::lock_guard lock(mutex_);
    return open_;
}

void PublishedServer::Session::replace(std::shared_ptr<Open> open) {
    const std::lock_guard lock(mutex_);
    open_ = std::move(open);
    if (open_ && interrupted_) open_->link.interrupt();
}

void PublishedServer::Session::interrupt() {
    const std::lock_guard lock(mutex_);
    interrupted_ = true;
    if (open_) open_->link.interrupt();
}

Result<void> PublishedServer::Session::connect() {
    auto open = std::make_shared<Open>(options_.limits);
    replace(open);
    if (auto connected = open->link.connect(options_.host, options_.port, options_.connectLimit); !connected) {
        replace(nullptr);
        return connected;
    }
    open->in.setSilence(options_.connectLimit);
    if (auto greeted = greet(*open); !greeted) {
        leave();
        return greeted;
    }
    return {};
}

Result<void> PublishedServer::Session::greet(Open& open) {
    WireReader& in = open.in;
    const auto other = [&](const std::string& what) {
        return Error{ErrorCode::protocolViolation, "What listens at " + options_.host + ":" + std::to_string(options_.port) +
                                                       " is no published EMCA server (2021): " + what};
    };
    const auto hello = in.integer<std::int16_t>();
    if (!in.ok()) {
        return in.error().code == ErrorCode::cancelled ? in.error()
                                                       : other("it should speak first, but " + std::string(in.error().code == ErrorCode::timedOut ? "was silent." : "closed the connection."));
    }
    constexpr std::int16_t kSwappedHello = MessageId::hello << 8;
    if (hello != MessageId::hello && hello != kSwappedHello) return other("it greets with " + std::to_string(hello) + " instead of 1.");
    open.swapped = hello == kSwappedHello;
    in.setSwapped(open.swapped);
    if (auto sent = open.link.write(WireWriter(open.swapped).add<std::int16_t>(MessageId::hello).bytes(), options_.connectLimit); !sent) return sent;

    std::vector<std::int16_t> plugins;
    const auto id = in.integer<std::int16_t>();
    if (in.ok() && id != MessageId::plugins) return other("after the greeting it sends " + std::to_string(id) + " instead of 2, the list of its plugins.");
    const std::uint32_t count = in.count(in.limits().plugins, "plugins");
    for (std::uint32_t i = 0; i < count && in.ok(); ++i) plugins.push_back(in.integer<std::int16_t>());
    if (!in.ok()) return in.error();

    if (auto sent = open.link.write(WireWriter(open.swapped).add<std::int16_t>(MessageId::requestInfo).bytes(), options_.connectLimit); !sent) return sent;
    const auto answer = in.integer<std::int16_t>();
    if (in.ok() && answer != MessageId::info) return other("it answers " + std::to_string(answer) + " where it is asked for its names.");
    PublishedInfo info = readInfo(in);
    if (!in.ok()) return in.error();
    if (known_ && (info.renderer != info_.renderer || info.scene != info_.scene)) {
        return Error{ErrorCode::rendererFailed, "The published server now has the scene \"" + info.scene + "\" in \"" + info.renderer + "\", before it had \"" +
                                                    info_.scene + "\" in \"" + info_.renderer + "\": start the bridge again."};
    }
    if (!known_ && open.swapped) log("The server's machine stores numbers the other way round; the bridge turns them.");
    names_ = WireWriter(open.swapped).add<std::int16_t>(MessageId::info).text(info.renderer).text(info.scene).bytes();
    if (!known_) info_ = std::move(info);
    plugins_ = std::move(plugins);
    known_ = true;
    return {};
}

void PublishedServer::Session::leave(bool quit) {
    const auto open = current();
    if (!open) return;
    // A server whose client goes without a word ends itself.
    open->link.resume();
    const auto word = WireWriter(open->swapped).add<std::int16_t>(quit ? MessageId::quit : MessageId::disconnect).bytes();
    if (open->link.write(word, options_.goodbyeLimit)) {
        std::array<std::byte, 4096> rest{};
        const auto deadline = std::chrono::steady_clock::now() + options_.goodbyeLimit;
        for (auto left = options_.goodbyeLimit; left.count() > 0;) {
            if (!open->link.readSome(rest, left)) break;
            left = std::chrono::duration_cast<std::chrono::milliseconds>(deadline - std::chrono::steady_clock::now());
        }
    }
    replace(nullptr);
}

Error PublishedServer::Session::failed(Error error) {
    leave();
    return error;
}

Error PublishedServer::Session::broken() { return failed(current()->in.error()); }

Result<void> PublishedServer::Session::send(std::int16_t id, const std::vector<std::uint32_t>& numbers) {
    const auto open = current();
    WireWriter request(open->swapped);
    request.add(id);
    for (const std::uint32_t number : numbers) request.add(number);
    request.add<std::int16_t>(MessageId::requestInfo);
    open->in.beginReply();
    return open->link.write(request.bytes(), options_.answerLimit);
}

Result<void> PublishedServer::Session::awaitReply(std::int16_t reply, std::chrono::milliseconds limit, const std::string& what) {
    const auto open = current();
    open->in.setSilence(limit);
    const auto id = open->in.integer<std::int16_t>();
    if (!open->in.ok()) return open->in.error();
    open->in.setSilence(options_.silenceLimit);
    if (id == reply) return {};
    if (id == MessageId::disconnect) {
        return Error{ErrorCode::connectionLost, "The published server took its leave when it was asked for " + what + "."};
    }
    if (id != MessageId::info) {
        return Error{ErrorCode::protocolViolation, "The published server was asked for " + what + " and answered with the message " + std::to_string(id) +
                                                       " instead of " + std::to_string(reply) + "."};
    }
    (void)readInfo(open->in);
    if (!open->in.ok()) return open->in.error();
    return Error{ErrorCode::rendererFailed, "The published server gave no answer when it was asked for " + what + ", but goes on: its renderer failed, and its own output says why."};
}

Result<void> PublishedServer::Session::begin(std::int16_t id, const std::vector<std::uint32_t>& numbers, std::int16_t reply, std::chrono::milliseconds limit) {
    for (;;) {
        bool rested = false;
        if (const auto open = current()) {
            rested = open->used;
        } else if (auto connected = connect(); !connected) {
            return connected;
        }
        auto answered = send(id, numbers);
        if (answered) answered = awaitReply(reply, limit, name(id));
        if (answered) {
            current()->used = true;
            return answered;
        }
        if (answered.error().code == ErrorCode::rendererFailed) return answered;  // and the connection is in order
        leave();
        if (!rested || answered.error().code != ErrorCode::connectionLost) return answered;
        log("The published server had dropped the connection; connecting again.");
    }
}

void PublishedServer::Session::end() {
    WireReader& in = current()->in;
    const bool answered = in.nextIs(names_);
    if (answered) {
        (void)in.integer<std::int16_t>();
        (void)readInfo(in);
    }
    if (!answered || !in.ok()) leave();
}

Result<PublishedCamera> PublishedServer::Session::camera() {
    if (auto begun = begin(MessageId::requestCamera, {}, MessageId::camera, options_.answerLimit); !begun) return begun.error();
    const PublishedCamera camera = readCamera(current()->in);
    if (!current()->in.ok()) return broken();
    end();
    return camera;
}

Result<PublishedScene> PublishedServer::Session::scene() {
    if (auto begun = begin(MessageId::requestScene, {}, MessageId::scene, options_.answerLimit); !begun) return begun.error();
    PublishedScene scene = readScene(current()->in);
    if (!current()->in.ok()) return broken();
    end();
    return scene;
}

Result<PublishedImage> PublishedServer::Session::image(std::uint32_t samplesPerPixel) {
    constexpr std::chrono::milliseconds kAsLongAsItTakes{0};
    if (auto begun = begin(MessageId::requestImage, {samplesPerPixel}, MessageId::image, kAsLongAsItTakes); !begun) return begun.error();
    WireReader& in = current()->in;
    PublishedImage image;
    image.path = in.text(in.limits().nameBytes, "the image's path");
    // A scene follows if there is a heat map, which may take the server a while to fill; else, the names.
    in.setSilence(options_.answerLimit);
    if (in.ok() && !in.nextIs(names_) && in.ok()) {
        if (const auto id = in.integer<std::int16_t>(); in.ok() && id != MessageId::scene) {
            in.fail(ErrorCode::protocolViolation, "Behind an image the published server sends the message " + std::to_string(id) + " instead of a scene.");
        }
        in.setSilence(options_.silenceLimit);
        image.scene = readScene(in);
    }
    if (!in.ok()) return broken();
    in.setSilence(options_.silenceLimit);
    end();
    return image;
}

Result<PublishedPixel> PublishedServer::Session::pixel(Pixel pixel, std::uint32_t samplesPerPixel) {
    if (auto begun = begin(MessageId::requestPixel, {pixel.x, pixel.y, samplesPerPixel}, MessageId::pixel, options_.answerLimit); !begun) return begun.error();
    PublishedPixel reply = readPixel(current()->in, names_);
    if (!current()->in.ok()) return broken();
    if (reply.endedBySilence) {
        leave();
    } else {
        end();
    }
    return reply;
}

}  // namespace emca::bridge
