#include "patient.h"

#include <algorithm>
#include <set>
#include <utility>

#include "emca/core/seed_map.h"
#include "words.h"

namespace emca::doctor {

std::string adviceFor(ErrorCode code) {
    switch (code) {
        case ErrorCode::connectionLost:
            return "The renderer's process ended, or closed the connection: look at what it printed, run it in a debugger, and ask for this check alone (--only).";
        case ErrorCode::timedOut: return "Look where the renderer hangs: a debugger shows it.";
        case ErrorCode::rendererFailed: return "The sentence is the renderer's own, or what it threw: catch it there.";
        case ErrorCode::protocolViolation: return "The server did not follow docs/protocol.md.";
        case ErrorCode::connectionFailed: return "Start the renderer's server there, or give another address.";
        case ErrorCode::versionMismatch: return "Build renderer and command line from the same version of EMCA.";
        case ErrorCode::outOfMemory: return "Ask for less: --spp, --pixels.";
        default: return "";
    }
}

Deadline::Deadline(double seconds, std::shared_ptr<std::atomic<bool>> person) {
    const auto end = Clock::now() + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(seconds));
    thread_ = std::thread([this, end, person = std::move(person)] {
        std::unique_lock lock(mutex_);
        while (!over_ && Clock::now() < end && !(person && *person)) changed_.wait_for(lock, std::chrono::milliseconds(10));
        *flag_ = true;
    });
}

Deadline::~Deadline() {
    {
        const std::lock_guard lock(mutex_);
        over_ = true;
    }
    changed_.notify_all();
    thread_.join();
}

Patient::Patient(client::Address address, const ExaminationOptions& options, const ExaminationObserver& observer)
    : address_(std::move(address)), options_(options), observer_(observer) {}

Result<void> Patient::connect() {
    if (connection_ && connection_->isOpen()) return {};
    auto opened = another();
    if (!opened) return opened.error();
    connection_ = std::move(opened).value();
    return {};
}

const Result<client::ServerInfo>& Patient::info() {
    if (!info_ || !*info_) info_.emplace(connection_->info());  // asked again where it failed: nothing goes without
    return *info_;
}

const Result<Camera>& Patient::camera() {
    if (!camera_) camera_.emplace(connection_->camera());
    return *camera_;
}

const Result<std::vector<Mesh>>& Patient::meshes() {
    if (!meshes_) meshes_.emplace(connection_->meshes(watch()));
    return *meshes_;
}

const Result<client::Render>& Patient::image() {
    if (!image_) {
        image_.emplace(info() ? connection_->render(renderOptions(), watch(0, 0.5)) : Result<client::Render>(info().error()));
        if (*image_) imageSeconds.push_back((*image_)->seconds);
    }
    return *image_;
}

const Replays& Patient::replays() {
    if (!replays_) {
        replays_ = std::make_unique<Replays>();
        replayAll(*replays_);
    }
    return *replays_;
}

bool Patient::says(std::string_view capability) {
    if (!info()) return false;
    const auto& words = info()->capabilities;
    return std::find(words.begin(), words.end(), capability) != words.end();
}

std::uint32_t Patient::samples() {
    if (options_.samplesPerPixel > 0) return options_.samplesPerPixel;
    return info() ? std::clamp<std::uint32_t>(info()->samplesPerPixel, 1, 16) : 0;
}

/// What the person chose, for renders and replays alike: a replay repeats its render by the same settings.
template <typename Options>
Options Patient::withSettings() {
    Options options;
    options.samplesPerPixel = samples();
    options.integrator = options_.integrator;
    options.sampler = options_.sampler;
    options.seed = options_.seed;
    options.hasSeed = options_.hasSeed;
    return options;
}

client::RenderOptions Patient::renderOptions() {
    auto options = withSettings<client::RenderOptions>();
    options.preview = false;
    return options;
}

client::TraceOptions Patient::traceOptions() {
    auto options = withSettings<client::TraceOptions>();
    options.against = client::VerdictAgainst::nothing;
    return options;
}

client::RequestObserver Patient::watch(double first, double last) const {
    client::RequestObserver observer;
    observer.cancel = observer_.cancel;
    if (observer_.progress)
        observer.progress = [tell = observer_.progress, first, last](double fraction) { tell(first + fraction * (last - first)); };
    return observer;
}

/// Every pixel as likely as any other, none twice, in random order.
std::vector<Pixel> Patient::choosePixels(const client::ServerInfo& info) const {
    const std::uint64_t count = std::uint64_t(info.width) * info.height;
    const std::uint64_t asked = options_.pixels > 0 ? options_.pixels : options_.quick ? 20 : 100;
    std::vector<Pixel> pixels;
    std::set<std::uint64_t> taken;
    // Floyd's algorithm for a sample without replacement (Bentley and Floyd, "Programming pearls", CACM 1987).
    const std::uint64_t wanted = std::min(asked, count);
    for (std::uint64_t i = count - wanted; i < count; ++i) {
        std::uint64_t chosen = mix64(mix64(options_.pixelSeed) + i) % (i + 1);
        if (!taken.insert(chosen).second) taken.insert(chosen = i);
        pixels.push_back({static_cast<std::uint32_t>(chosen % info.width), static_cast<std::uint32_t>(chosen / info.width)});
    }
    for (std::size_t i = pixels.size(); i > 1; --i) std::swap(pixels[i - 1], pixels[mix64(options_.pixelSeed * 31 + i) % i]);
    return pixels;
}

void Patient::replayAll(Replays& replays) {
    const auto fail = [&](const Error& error) {
        if (replays.failures++ == 0) replays.error = error;
    };
    if (!info()) return fail(info().error());
    if (meshes()) replays.surfaces = std::make_unique<SurfaceCheck>(*meshes());
    if (camera()) replays.rays = std::make_unique<CameraRays>(*camera(), info()->width, info()->height);
    const std::vector<Pixel> pixels = choosePixels(*info());
    replays.asked = pixels.size();
    client::TraceOptions options = traceOptions();
    if (image()) {
        options.against = client::VerdictAgainst::renderId;
        options.renderId = image()->id;
    }
    for (const Pixel pixel : pixels) {
        const double done = double(replays.pixels.size()) / double(pixels.size());
        if (observer_.progress) observer_.progress(done);
        client::RequestObserver observer;
        observer.cancel = observer_.cancel;
        auto trace = connection_->tracePixel(pixel, options, observer);
        if (!trace) {
            if (replays.failures == 0) replays.failedPixel = pixel;
            fail(trace.error());
            // One pixel's fault may be its own; a renderer that fails again and again does so for all.
            if (interrupted() || !connection_->isOpen() || replays.failures >= 5) return;
            continue;
        }
        replays.pixels.push_back({pixel, trace->replays.front(), trace->renderSeconds});
        std::uint64_t expected = trace->samplesPerPixel;
        if (image() && image()->image.samples.contains(pixel)) expected = static_cast<std::uint64_t>(std::max(0.f, *image()->image.samples.at(pixel)));
        replays.values.add(trace->paths);
        replays.paths.add(trace->paths, pixel, expected, trace->stats);
        if (replays.surfaces) replays.surfaces->add(trace->paths);
        if (replays.rays) replays.rays->add(trace->paths);
        if (replays.kept.size() < Replays::kKept) replays.kept.push_back(std::move(trace).value());
    }
}

Finding broken(std::string check, const Error& error) {
    Finding finding{.check = std::move(check)};
    finding.add("error", std::string(name(error.code)));
    finding.complain(Outcome::failed, error.message, adviceFor(error.code));
    return finding;
}

Finding skipped(std::string check, std::string why) {
    return {.check = std::move(check), .outcome = Outcome::skipped, .sentence = std::move(why)};
}

}  // namespace emca::doctor
