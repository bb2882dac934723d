#include <fmt/format.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <memory>
#include <mutex>

#include "commands.h"
#include "emca/doctor/examination.h"
#include "interrupt.h"
#include "json.h"
#include "progress_bar.h"
#include "settings_options.h"
#include "table.h"

namespace emca::cli {
namespace {

struct DoctorArguments {
    std::string address, pixels, pixelSeed, only;
    SettingsArguments settings;
    bool quick = false, json = false;
};

Result<doctor::ExaminationOptions> parse(const DoctorArguments& arguments) {
    const Result<Settings> settings = parseSettings(arguments.settings);
    if (!settings) return settings.error();
    doctor::ExaminationOptions options;
    apply(*settings, options);
    if (!arguments.pixels.empty()) {
        const auto pixels = parseWhole("--pixels", arguments.pixels, 1, 1u << 20);
        if (!pixels) return pixels.error();
        options.pixels = static_cast<std::uint32_t>(*pixels);
    }
    if (!arguments.pixelSeed.empty()) {
        const auto seed = parseWhole("--pixel-seed", arguments.pixelSeed, 0, ~std::uint64_t(0));
        if (!seed) return seed.error();
        options.pixelSeed = *seed;
    }
    options.quick = arguments.quick;
    options.only = splitList(arguments.only);
    return options;
}

/// The command that shows a pixel as the examination saw it.
std::string pixelCommand(const client::Address& address, Pixel pixel, const doctor::ExaminationOptions& options, std::uint32_t samples) {
    std::string command = fmt::format("emca pixel {} {} {}", address.text(), pixel.x, pixel.y);
    if (samples > 0) command += fmt::format(" --spp {}", samples);
    if (options.hasSeed) command += fmt::format(" --seed {}", options.seed);
    if (!options.integrator.empty()) command += fmt::format(" --integrator '{}'", options.integrator);
    if (!options.sampler.empty()) command += fmt::format(" --sampler '{}'", options.sampler);
    return command;
}

/// One line for the finding; below it what to do, and where to look.
std::string textOf(const doctor::Finding& finding) {
    std::string text = fmt::format("{:<12}  {:<7}  {}\n", finding.check, name(finding.outcome), printable(finding.sentence));
    if (finding.outcome < doctor::Outcome::warning) return text;
    const std::string indentation(23, ' ');
    if (!finding.advice.empty()) text += fmt::format("{}{}\n", indentation, printable(finding.advice));
    for (const doctor::SuspectPixel& suspect : finding.pixels)
        text += fmt::format("{}pixel ({}, {}): {}\n", indentation, suspect.pixel.x, suspect.pixel.y, printable(suspect.why));
    return text;
}

Json jsonOf(const doctor::Finding& finding, const client::Address& address, const doctor::ExaminationOptions& options, std::uint32_t samples) {
    Json out;
    out["check"] = finding.check;
    out["outcome"] = name(finding.outcome);
    out["sentence"] = finding.sentence;
    out["advice"] = finding.advice;
    out["figures"] = Json::object();
    for (const doctor::Figure& figure : finding.figures) out["figures"][figure.name] = toJson(figure.value);
    out["pixels"] = Json::array();
    for (const doctor::SuspectPixel& suspect : finding.pixels) {
        Json entry;
        entry["pixel"] = toJson(suspect.pixel);
        entry["why"] = suspect.why;
        entry["command"] = pixelCommand(address, suspect.pixel, options, samples);
        out["pixels"].push_back(std::move(entry));
    }
    return out;
}

std::size_t counted(const doctor::Examination& examination, doctor::Outcome outcome) { return examination.count(outcome); }

Json jsonOf(const client::Address& address, const doctor::ExaminationOptions& options, const doctor::Examination& examination) {
    Json out;
    out["address"] = address.text();
    out["renderer"] = examination.info ? Json(examination.info->renderer) : Json(nullptr);
    out["scene"] = examination.info ? Json(examination.info->scene) : Json(nullptr);
    out["protocol"] = examination.greeting.version;
    out["spp"] = examination.samplesPerPixel;
    out["complete"] = !examination.lost && !examination.interrupted;
    for (const auto outcome : {doctor::Outcome::ok, doctor::Outcome::skipped, doctor::Outcome::warning, doctor::Outcome::failed})
        out["counts"][name(outcome)] = counted(examination, outcome);
    out["checks"] = Json::array();
    for (const doctor::Finding& finding : examination.findings) out["checks"].push_back(jsonOf(finding, address, options, examination.samplesPerPixel));
    return out;
}

/// Findings as they come, with the running check on a terminal below them.
class Report {
  public:
    explicit Report(bool json) : json_(json) {}
    doctor::ExaminationObserver observer(const InterruptGuard& interrupt) {
        doctor::ExaminationObserver observer;
        observer.began = [this](std::string_view check) {
            const std::lock_guard lock(mutex_);
            bar_ = std::make_unique<ProgressBar>(std::string(check));
        };
        observer.progress = [this](double fraction) {
            const std::lock_guard lock(mutex_);
            if (bar_) bar_->update(fraction);
        };
        observer.finished = [this](const doctor::Finding& finding) {
            {
                const std::lock_guard lock(mutex_);
                bar_.reset();
            }
            if (json_) return;
            fmt::print("{}", textOf(finding));
            std::fflush(stdout);
        };
        observer.cancel = interrupt.flag();
        return observer;
    }

  private:
    const bool json_;
    std::mutex mutex_;
    std::unique_ptr<ProgressBar> bar_;
};

void printEnd(const client::Address& address, const doctor::ExaminationOptions& options, const doctor::Examination& examination) {
    fmt::print("\n{} ok, {} skipped, {} {}, {} failed\n", counted(examination, doctor::Outcome::ok), counted(examination, doctor::Outcome::skipped),
               counted(examination, doctor::Outcome::warning), counted(examination, doctor::Outcome::warning) == 1 ? "warning" : "warnings",
               counted(examination, doctor::Outcome::failed));
    for (const doctor::Finding& finding : examination.findings) {
        if (finding.outcome < doctor::Outcome::warning || finding.pixels.empty()) continue;
        fmt::print("{}: {}\n", finding.check, pixelCommand(address, finding.pixels.front().pixel, options, examination.samplesPerPixel));
    }
}

int runDoctor(const DoctorArguments& arguments) {
    const Result<doctor::ExaminationOptions> options = parse(arguments);
    if (!options) return failUsage(options.error().message);
    const Result<client::Address> address = client::Address::parse(arguments.address);
    if (!address) return fail(address.error());
    const InterruptGuard interrupt;
    Report report(arguments.json);
    const Result<doctor::Examination> examination = doctor::examine(*address, *options, report.observer(interrupt));
    if (!examination) return failUsage(examination.error().message);
    if (examination->interrupted) {
        fmt::print(stderr, "interrupted: the examination was given up\n");
        return Exit::interrupted;
    }
    if (arguments.json) fmt::print("{}", dump(jsonOf(*address, *options, *examination)));
    else printEnd(*address, *options, *examination);
    if (examination->lost) return fail(*examination->lost);
    return counted(*examination, doctor::Outcome::failed) > 0 ? Exit::assertionFalse : Exit::ok;
}

}  // namespace

void addDoctorCommand(CLI::App& app, Run& run) {
    const auto arguments = std::make_shared<DoctorArguments>();
    CLI::App* command = app.add_subcommand("doctor", "Examines a renderer's server: is its scene sane, is what is replayed what was rendered?");
    addAddressOption(*command, arguments->address);
    command->add_option("--pixels", arguments->pixels, "random pixels to replay (default 100, with --quick 20)")->type_name("N");
    command->add_option("--pixel-seed", arguments->pixelSeed, "another seed chooses other pixels (default 1)")->type_name("N");
    addSettingsOptions(*command, arguments->settings);
    command->get_option("--spp")->description("samples per pixel (default: the scene's, at most 16)");
    command->add_flag("--quick", arguments->quick, "without what takes long: concurrent, overhead, layers, cancel");
    command->add_option("--only", arguments->only, "only these checks: " + fmt::format("{}", fmt::join(doctor::checkNames(), ", ")))->type_name("CHECK,CHECK,…");
    command->add_flag("--json", arguments->json, "for scripts");
    command->footer("Examples:\n  emca doctor localhost:50013\n  emca doctor localhost:50013 --quick --spp 4\n"
                    "  emca doctor localhost:50013 --only replay,sums --pixels 300 --json | jq '.checks[0].figures'\n\n"
                    "Ends with 0 if nothing failed, 1 if a check failed, 4 if the renderer could not be reached or was lost.\n"
                    "docs/integrations/doctor.md says what each check means and what to do.");
    command->callback([arguments, &run] { run = [arguments] { return runDoctor(*arguments); }; });
}

}  // namespace emca::cli
