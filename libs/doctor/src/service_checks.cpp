#include <algorithm>
#include <cmath>
#include <thread>

#include "checks.h"
#include "emca/analysis/format.h"
#include "emca/core/replay.h"
#include "emca/doctor/image_checks.h"
#include "median.h"
#include "words.h"

namespace emca::doctor {
namespace {

using analysis::formatDuration;

bool isSentence(const std::string& text) { return text.size() >= 15 && text.find(' ') != std::string::npos; }

bool isPlainText(const std::string& text) {
    return std::none_of(text.begin(), text.end(), [](unsigned char c) { return c < 0x20 || c == 0x7f; });
}

}  // namespace

Finding checkHandshake(Patient& patient) {
    Finding finding{.check = "handshake"};
    if (const auto first = patient.connection().info(); !first && first.error().code != ErrorCode::rendererFailed) return broken("handshake", first.error());
    std::vector<double> times;
    for (int i = 0; i < 5; ++i) {  // the first answer may have loaded the scene
        const auto begin = Clock::now();
        const auto info = patient.connection().info();
        if (!info && info.error().code != ErrorCode::rendererFailed) return broken("handshake", info.error());
        times.push_back(secondsSince(begin));
    }
    const client::Greeting& greeting = patient.connection().greeting();
    const double median = medianOf(times);
    finding.add("software", greeting.software);
    finding.count("version", greeting.version);
    finding.add("answerSeconds", median);
    finding.sentence = fmt::format("{} speaks version {} of the protocol and answers within {}.", greeting.software.empty() ? "The server" : greeting.software, greeting.version, formatDuration(median));
    if (median > 0.5) finding.complain(Outcome::warning, "That is slow.", "Does it work for others meanwhile? An idle server answers info at once.");
    return finding;
}

Finding checkInfo(Patient& patient) {
    const auto& asked = patient.info();
    if (!asked) return broken("info", asked.error());
    const client::ServerInfo& info = *asked;
    Finding finding{.check = "info"};
    finding.sentence = fmt::format("{}, scene {}: {} x {} pixels, {} spp.", info.renderer.empty() ? "A renderer without a name" : info.renderer,
                                   info.scene.empty() ? "without a name" : info.scene, info.width, info.height, info.samplesPerPixel);
    finding.count("width", info.width);
    finding.count("height", info.height);
    finding.count("spp", info.samplesPerPixel);
    finding.count("tools", info.tools.size());
    finding.count("layers", info.layers.size());
    if (info.width == 0 || info.height == 0 || std::uint64_t(info.width) * info.height > (std::uint64_t(1) << 28))
        finding.complain(Outcome::failed, "That is no size of an image.", "Fill in RendererInfo::width and height in pixels.");
    if (info.samplesPerPixel == 0 || (info.maximumSamplesPerPixel > 0 && info.samplesPerPixel > info.maximumSamplesPerPixel))
        finding.complain(Outcome::failed, fmt::format("The scene's samples per pixel are {}, the server allows 1 to {}.", info.samplesPerPixel, info.maximumSamplesPerPixel), "Fill in RendererInfo::samplesPerPixel.");
    if (info.renderer.empty() || info.scene.empty())
        finding.complain(Outcome::warning, "A name is missing.", "Fill in RendererInfo::renderer (program and version) and scene: sessions and titles show them.");
    if (!isPlainText(info.renderer) || !isPlainText(info.scene) || !isPlainText(info.integrator) || !isPlainText(info.sampler))
        finding.complain(Outcome::warning, "A name has control characters.", "Names are shown on one line.");
    for (const LayerDescription& layer : info.layers)
        if (layer.description.empty()) finding.complain(Outcome::warning, fmt::format("The layer \"{}\" has no description.", layer.name), "Say in one sentence which events add which value.");
    if (!patient.says("deterministic"))
        finding.complain(Outcome::warning, "The renderer says that it is not deterministic: a replayed pixel is another one.", "Seed each sample by its pixel and index, then set RendererInfo::deterministic.");
    return finding;
}

Finding checkScene(Patient& patient) {
    const auto& meshes = patient.meshes();
    if (!meshes) return broken("meshes", meshes.error());
    const auto& info = patient.info();
    const std::uint64_t triangles = [&] {
        std::uint64_t sum = 0;
        for (const Mesh& mesh : *meshes) sum += mesh.triangles.size();
        return sum;
    }();
    return checkMeshes(*meshes, info ? info->meshes : meshes->size(), info ? info->triangles : triangles);
}

Finding checkView(Patient& patient) {
    const auto& camera = patient.camera();
    if (!camera) return broken("camera", camera.error());
    return checkCamera(*camera, patient.meshes() ? boundingBox(*patient.meshes()) : BoundingBox());
}

Finding checkRenderedImage(Patient& patient) {
    if (!patient.info()) return skipped("image", "The renderer's info could not be had.");
    const auto& first = patient.image();
    if (!first) return broken("image", first.error());
    Finding finding = checkImage(first->image.color);
    const auto second = patient.connection().render(patient.renderOptions(), patient.watch(0.5, 1));
    if (!second) return broken("image", second.error());
    patient.imageSeconds.push_back(second->seconds);
    const ImageDifference difference = compareImages(first->image.color, second->image.color);
    checkRepeated(finding, difference, patient.says("deterministic"));
    const std::string same = fmt::format("{} x {} pixels with {} spp, rendered twice in {} and {}{}.", first->image.color.width(), first->image.color.height(), first->samplesPerPixel,
                                         formatDuration(first->seconds), formatDuration(second->seconds), difference.equal() ? ": the same bits" : "");
    finding.sentence = finding.sentence.empty() ? same : same + " " + finding.sentence;
    if (first->samplesPerPixel != patient.samples())
        finding.complain(Outcome::warning, fmt::format("The renderer used {} samples instead of {}.", first->samplesPerPixel, patient.samples()), "Render with as many samples as RenderSettings say.");
    return finding;
}

namespace {

/// One client's part of the check "concurrent".
struct Crowd {
    std::vector<Pixel> pixels;
    std::vector<Color> replayed;
    std::vector<const PathSet*> paths;  ///< as replayed before, null where not kept
    std::string trouble;                ///< the first thing that was different
    void ask(Patient& patient, const client::TraceOptions& options) {
        const auto connection = patient.another();
        if (!connection) return void(trouble = connection.error().message);
        client::RequestObserver observer;
        observer.cancel = patient.watch().cancel;
        for (std::size_t i = 0; i < pixels.size() && trouble.empty(); ++i) {
            const auto trace = (*connection)->tracePixel(pixels[i], options, observer);
            if (!trace) trouble = trace.error().message;
            else if (compare(trace->replays.front().replayed, replayed[i]) != Verdict::exact)
                trouble = fmt::format("Pixel {} became {} instead of {}.", analysis::formatPixel(pixels[i]), analysis::formatColor(trace->replays.front().replayed), analysis::formatColor(replayed[i]));
            else if (const std::string why = paths[i] ? differenceOf(*paths[i], trace->paths) : ""; !why.empty())
                trouble = fmt::format("Pixel {} has {}.", analysis::formatPixel(pixels[i]), why);
        }
    }
};

}  // namespace

Finding checkConcurrent(Patient& patient) {
    if (!patient.says("concurrent")) return skipped("concurrent", "The renderer says that it does one thing at a time: replays wait for renders.");
    const Replays& replays = patient.replays();
    if (replays.pixels.empty() || !patient.image()) return skipped("concurrent", "No pixel could be replayed.");
    Crowd crowds[2];
    for (std::size_t i = 0; i < std::min<std::size_t>(replays.pixels.size(), 16); ++i) {
        Crowd& crowd = crowds[i % 2];
        crowd.pixels.push_back(replays.pixels[i].pixel);
        crowd.replayed.push_back(replays.pixels[i].replay.replayed);
        crowd.paths.push_back(i < replays.kept.size() ? &replays.kept[i].paths : nullptr);
    }
    const client::TraceOptions options = patient.traceOptions();
    Result<client::Render> image(Error{});
    {
        std::jthread one([&] { crowds[0].ask(patient, options); }), other([&] { crowds[1].ask(patient, options); });
        image = patient.connection().render(patient.renderOptions(), patient.watch());
    }
    Finding finding{.check = "concurrent"};
    finding.count("pixels", crowds[0].pixels.size() + crowds[1].pixels.size());
    finding.sentence = fmt::format("Two clients replayed {} while a third rendered.", counted(crowds[0].pixels.size() + crowds[1].pixels.size(), "pixel"));
    constexpr const char* kAdvice = "Share nothing that is written between calls of renderPixel and renderImage (samplers, arenas, statics), or set RendererInfo::concurrent to false.";
    for (const Crowd& crowd : crowds)
        if (!crowd.trouble.empty()) finding.complain(Outcome::failed, crowd.trouble, kAdvice);
    if (!image) {
        finding.complain(Outcome::failed, "The render failed: " + image.error().message, kAdvice);
    } else if (const ImageDifference d = compareImages(patient.image()->image.color, image->image.color); !d.equal() && patient.says("deterministic")) {
        finding.complain(Outcome::failed, fmt::format("The image that was rendered meanwhile has {} other pixels.", d.different), kAdvice);
    }
    if (finding.outcome == Outcome::ok) finding.sentence += " All are as they were alone.";
    return finding;
}

namespace {

/// A request that must be refused with a sentence.
struct BadRequest {
    const char* what;
    std::function<std::optional<Error>(client::Connection&)> ask;  ///< nothing: it was accepted
    bool mayBeAccepted = false;
};

template <typename T>
std::optional<Error> errorOf(const Result<T>& result) {
    return result ? std::nullopt : std::optional<Error>(result.error());
}

std::vector<BadRequest> badRequests(Patient& patient) {
    const client::ServerInfo& info = *patient.info();
    const client::TraceOptions base = patient.traceOptions();
    const client::RequestObserver observer = patient.watch();
    std::vector<BadRequest> all;
    all.push_back({"a pixel outside the image", [=, w = info.width](client::Connection& c) { return errorOf(c.tracePixel({w, 0}, base, observer)); }});
    all.push_back({"an integrator that it does not have", [=](client::Connection& c) {
        client::TraceOptions options = base;
        options.integrator = "no such integrator (emca doctor)";
        return errorOf(c.tracePixel({0, 0}, options, observer));
    }, info.integrator.empty()});
    if (info.maximumSamplesPerPixel < 0xffffffffu)
        all.push_back({"too many samples", [=, most = info.maximumSamplesPerPixel](client::Connection& c) {
            client::TraceOptions options = base;
            options.samplesPerPixel = most + 1;
            return errorOf(c.tracePixel({0, 0}, options, observer));
        }});
    all.push_back({"a query that is none", [=](client::Connection& c) {
        client::TraceOptions options = base;
        options.query = "luminance >";
        return errorOf(c.tracePixel({0, 0}, options, observer));
    }});
    all.push_back({"a tool that it does not have", [=](client::Connection& c) { return errorOf(c.askTool("no such tool (emca doctor)", {}, observer)); }});
    all.push_back({"a surface layer that it does not have", [=, options = patient.renderOptions()](client::Connection& c) mutable {
        options.layers = {"no such layer (emca doctor)"};
        return errorOf(c.render(options, observer));
    }});
    return all;
}

}  // namespace

Finding checkBadRequests(Patient& patient) {
    if (!patient.info()) return skipped("bad-requests", "The renderer's info could not be had.");
    Finding finding{.check = "bad-requests"};
    std::size_t refused = 0;
    const auto requests = badRequests(patient);
    for (const BadRequest& request : requests) {
        const auto error = request.ask(patient.connection());
        if (patient.interrupted()) return finding;
        if (!patient.connection().isOpen() || (error && error->code == ErrorCode::connectionLost)) {
            finding.complain(Outcome::failed, fmt::format("After a request for {} the connection was gone: {}", request.what, error ? error->message : ""),
                             "No request may end the renderer: return an Error, and turn asserts and exit() on user input into one.");
            return finding;
        }
        if (!error) {
            if (!request.mayBeAccepted) finding.complain(Outcome::warning, fmt::format("A request for {} was accepted.", request.what), "Return ErrorCode::invalidArgument with a sentence where settings cannot be met: what is shown would not be what was asked for.");
            continue;
        }
        ++refused;
        if (!isSentence(error->message)) finding.complain(Outcome::warning, fmt::format("A request for {} was refused with \"{}\".", request.what, error->message), "An error says what was asked, what was found and what to do.");
    }
    finding.count("requests", requests.size());
    finding.count("refused", refused);
    if (finding.outcome == Outcome::ok) finding.sentence = fmt::format("{} of {} refused with a sentence; the connection lives.", refused, counted(requests.size(), "bad request was", "bad requests were"));
    const Replays& replays = patient.replays();
    if (replays.pixels.empty()) return finding;
    const auto again = patient.connection().tracePixel(replays.pixels.front().pixel, patient.traceOptions(), patient.watch());
    if (!again) finding.complain(Outcome::failed, "A pixel that could be replayed before cannot be any more: " + again.error().message, "A refused request must leave nothing behind.");
    else if (compare(again->replays.front().replayed, replays.pixels.front().replay.replayed) != Verdict::exact)
        finding.complain(Outcome::failed, fmt::format("Pixel {} is another one afterwards.", analysis::formatPixel(replays.pixels.front().pixel)), "A refused request must leave nothing behind.");
    return finding;
}

Finding checkCancel(Patient& patient) {
    if (!patient.image()) return skipped("cancel", "No image could be rendered.");
    while (patient.imageSeconds.size() < 5 && patient.imageSeconds.front() < 0.2) {  // what is short is measured badly
        const auto render = patient.connection().render(patient.renderOptions(), patient.watch(0, 0.1));
        if (!render) return broken("cancel", render.error());
        patient.imageSeconds.push_back(render->seconds);
    }
    const double alone = std::max(1e-4, medianOf(patient.imageSeconds)), limit = patient.options().cancelLimitSeconds;
    // Long enough that the rest of it would be noticed.
    const double rate = alone / double(patient.samples()), wanted = 3 * limit + 1;
    const std::uint64_t most = std::min<std::uint64_t>(patient.info()->maximumSamplesPerPixel, 1u << 20);
    const auto samples = std::uint32_t(std::clamp(std::ceil(wanted / rate), double(patient.samples()), double(most)));
    if (rate * samples < limit) return skipped("cancel", fmt::format("Its image is rendered too fast to be cancelled: {} with {} spp.", formatDuration(rate * samples), samples));
    client::RenderOptions options = patient.renderOptions();
    options.samplesPerPixel = samples;
    {
        const Deadline soon(0.25, patient.watch().cancel);
        client::RequestObserver observer = patient.watch(0, 0.1);
        observer.cancel = soon.flag();
        if (patient.connection().render(options, observer)) return skipped("cancel", "Its image was finished before it could be cancelled.");
    }
    const auto cancelled = Clock::now();
    const double patience = std::max(20.0, 10 * limit) + 2 * alone;
    const Deadline deadline(patience, patient.watch().cancel);
    client::RequestObserver observer = patient.watch(0.1, 1);
    observer.cancel = deadline.flag();
    const auto next = patient.connection().render(patient.renderOptions(), observer);
    const double waited = std::max(0.0, secondsSince(cancelled) - (next ? next->seconds : 0));
    Finding finding{.check = "cancel"};
    finding.add("seconds", waited);
    finding.count("spp", samples);
    constexpr const char* kAdvice = "Ask RequestMonitor::cancelled() at least once per tile or row and sample, and return ErrorCode::cancelled at once.";
    if (!next && next.error().code == ErrorCode::cancelled) {
        finding.complain(Outcome::failed, fmt::format("{} after a render was cancelled, the renderer still did nothing else.", formatDuration(patience)), kAdvice);
    } else if (!next) {
        return broken("cancel", next.error());
    } else if (waited > limit) {
        finding.complain(Outcome::failed, fmt::format("After a render was cancelled, the renderer went on for {}.", formatDuration(waited)), kAdvice);
    } else {
        finding.sentence = fmt::format("A render that was cancelled ended within {}.", formatDuration(waited));
    }
    if (next && finding.outcome == Outcome::ok && patient.says("deterministic") && !compareImages(patient.image()->image.color, next->image.color).equal())
        finding.complain(Outcome::failed, "The next image is another one than before.", "A cancelled render must leave nothing behind.");
    return finding;
}

}  // namespace emca::doctor
