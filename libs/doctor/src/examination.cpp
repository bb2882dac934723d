#include "emca/doctor/examination.h"

#include <algorithm>
#include <array>
#include <exception>

#include "checks.h"
#include "words.h"

namespace emca::doctor {
namespace {

struct Check {
    std::string_view name;
    Finding (*run)(Patient& patient);
    bool slow = false;  ///< left out of a quick examination
};

constexpr std::array kChecks{
    Check{"handshake", checkHandshake},     Check{"info", checkInfo},
    Check{"meshes", checkScene},            Check{"camera", checkView},
    Check{"image", checkRenderedImage},     Check{"replay", checkReplay},
    Check{"sums", checkSums},               Check{"paths", checkPaths},
    Check{"values", checkValues},           Check{"surfaces", checkSurfaces},
    Check{"camera-rays", checkCameraRays},  Check{"pixel-list", checkPixelList},
    Check{"samples", checkSamples},         Check{"concurrent", checkConcurrent, true},
    Check{"overhead", checkOverhead, true}, Check{"layers", checkLayers, true},
    Check{"light-probe", checkLightProbe},  Check{"bad-requests", checkBadRequests},
    Check{"cancel", checkCancel, true},
};

constexpr auto kNames = [] {
    std::array<std::string_view, kChecks.size()> names;
    for (std::size_t i = 0; i < names.size(); ++i) names[i] = kChecks[i].name;
    return names;
}();

/// Nothing of ours throws on purpose; what libraries throw (memory) becomes a finding.
Finding run(const Check& check, Patient& patient) {
    try {
        return check.run(patient);
    } catch (const std::exception& e) {
        return broken(std::string(check.name), {ErrorCode::internal, fmt::format("The check itself gave up: {}.", e.what())});
    }
}

bool wanted(const Check& check, const ExaminationOptions& options) {
    if (options.only.empty()) return !(check.slow && options.quick);
    return std::find(options.only.begin(), options.only.end(), check.name) != options.only.end();
}

}  // namespace

std::size_t Examination::count(Outcome outcome) const {
    return static_cast<std::size_t>(std::count_if(findings.begin(), findings.end(), [&](const Finding& f) { return f.outcome == outcome; }));
}

const Finding* Examination::find(std::string_view check) const {
    const auto it = std::find_if(findings.begin(), findings.end(), [&](const Finding& f) { return f.check == check; });
    return it == findings.end() ? nullptr : &*it;
}

std::span<const std::string_view> checkNames() { return kNames; }

Result<Examination> examine(const client::Address& address, const ExaminationOptions& options, const ExaminationObserver& observer) {
    for (const std::string& only : options.only)
        if (std::find(kNames.begin(), kNames.end(), only) == kNames.end())
            return Error{ErrorCode::invalidArgument, fmt::format("There is no check \"{}\"; the checks are {}.", only, fmt::join(kNames, ", "))};
    Patient patient(address, options, observer);
    Examination result;
    const auto finish = [&](Finding finding) {
        result.findings.push_back(std::move(finding));
        if (observer.finished) observer.finished(result.findings.back());
    };
    if (const auto connected = patient.connect(); !connected) {
        result.lost = connected.error();
        finish(broken("handshake", connected.error()));
        return result;
    }
    result.greeting = patient.connection().greeting();
    for (const Check& check : kChecks) {
        if (!wanted(check, options)) continue;
        if (observer.began) observer.began(check.name);
        Finding finding = run(check, patient);
        if (patient.interrupted()) {
            result.interrupted = true;
            break;
        }
        finish(std::move(finding));
        if (patient.connection().isOpen()) continue;
        if (const auto again = patient.connect(); !again) {
            result.lost = again.error();
            break;
        }
    }
    result.info = patient.knownInfo();
    if (result.info) result.samplesPerPixel = patient.samples();
    result.renderId = patient.renderId();
    return result;
}

}  // namespace emca::doctor
