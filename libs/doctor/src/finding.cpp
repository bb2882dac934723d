#include "emca/doctor/finding.h"

#include <algorithm>

namespace emca::doctor {

const char* name(Outcome outcome) {
    switch (outcome) {
        case Outcome::ok: return "ok";
        case Outcome::skipped: return "skipped";
        case Outcome::warning: return "warning";
        case Outcome::failed: return "failed";
    }
    return "unknown";
}

void Finding::complain(Outcome worse, const std::string& what, const std::string& whatToDo) {
    outcome = std::max(outcome, worse);
    if (!sentence.empty()) sentence += ' ';
    sentence += what;
    if (whatToDo.empty() || advice.find(whatToDo) != std::string::npos) return;
    if (!advice.empty()) advice += ' ';
    advice += whatToDo;
}

const Value* Finding::find(std::string_view figure) const {
    const auto it = std::find_if(figures.begin(), figures.end(), [&](const Figure& f) { return f.name == figure; });
    return it == figures.end() ? nullptr : &it->value;
}

}  // namespace emca::doctor
