#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdlib>

#include "emca/analysis/statistics.h"

namespace emca::analysis {
namespace {

/// The mantissas 1, 2, 5 of round steps; those of whole numbers are powers of ten from 1 on.
struct Step {
    int mantissa = 1;
    int exponent = 0;
    double value() const { return mantissa * std::pow(10.0, exponent); }
    Step next() const {
        if (mantissa == 1) return {2, exponent};
        return mantissa == 2 ? Step{5, exponent} : Step{1, exponent + 1};
    }
    /// k * step without the rounding of k * 0.1: divides where the step is below 1.
    double multiple(double k) const {
        return exponent < 0 ? k * mantissa / std::pow(10.0, -exponent) : k * mantissa * std::pow(10.0, exponent);
    }
};

std::string toText(double value, std::chars_format format, int precision) {
    char buffer[400];
    const auto end = std::to_chars(buffer, buffer + sizeof buffer, value, format, precision);
    return {buffer, end.ptr};
}

/// One notation for all labels of an axis: fixed with the digits that the step needs, scientific for large and small.
std::string linearLabel(double value, const Step& step, double largest) {
    if (value == 0) return "0";
    const int exponent = static_cast<int>(std::floor(std::log10(largest) + 1e-9));
    if (exponent >= -4 && exponent <= 4) return toText(value, std::chars_format::fixed, std::max(-step.exponent, 0));
    return toText(value, std::chars_format::scientific, std::clamp(exponent - step.exponent, 0, 16));
}

std::vector<Tick> linearTicks(const ValueRange& range, int majorCount, int smallestExponent) {
    const double length = range.max - range.min;
    // A length so small that its share is 0 has no logarithm.
    const double magnitude = std::max(std::log10(length / majorCount), -330.0);
    Step step{1, std::max(static_cast<int>(std::floor(magnitude)) - 1, smallestExponent)};
    // Ranges far from 0 and nearly empty: steps below the resolution of doubles would repeat values.
    const double resolution = 4 * std::max(std::abs(range.min), std::abs(range.max)) * 2.3e-16;
    // A billionth of a step of slack: ends that are round numbers get their tick in spite of rounding.
    const auto firstMultiple = [&] { return std::ceil(range.min / step.value() - 1e-9); };
    const auto lastMultiple = [&] { return std::floor(range.max / step.value() + 1e-9); };
    while (step.value() < resolution || !(lastMultiple() - firstMultiple() + 1 <= majorCount)) step = step.next();
    const double first = firstMultiple(), last = lastMultiple();
    const double largest = std::max(std::abs(step.multiple(first)), std::abs(step.multiple(last)));
    std::vector<Tick> result;
    for (double k = first; k <= last; ++k) {
        const double value = std::clamp(step.multiple(k), range.min, range.max) + 0.0;  // + 0.0: no "-0"
        result.push_back({value, linearLabel(step.multiple(k) + 0.0, step, largest), true});
    }
    return result;
}

/// mantissa * 10^exponent, correctly rounded.
double decade(int mantissa, int exponent) {
    return std::strtod((std::to_string(mantissa) + "e" + std::to_string(exponent)).c_str(), nullptr);
}

std::string decadeLabel(int mantissa, int exponent, bool scientific) {
    const double value = decade(mantissa, exponent);
    if (scientific) return toText(value, std::chars_format::scientific, 0);
    return toText(value, std::chars_format::fixed, std::max(-exponent, 0));
}

struct Decades {
    int first = 0, last = 0;  ///< exponents of the powers of ten inside the range
    bool scientific = false;
    explicit Decades(const ValueRange& range)
        : first(static_cast<int>(std::ceil(std::log10(range.min) - 1e-9))),
          last(static_cast<int>(std::floor(std::log10(range.max) + 1e-9))),
          scientific(first < -3 || last > 4) {}
    int count() const { return last - first + 1; }
};

/// Every multiple 1 to 9 of the decades around; those for which `labelled` holds are major.
template <typename Labelled>
std::vector<Tick> decadeTicks(const ValueRange& range, const Decades& decades, bool minor, const Labelled& labelled) {
    std::vector<Tick> result;
    for (int e = decades.first - 1; e <= decades.last; ++e)
        for (int m = 1; m <= (minor ? 9 : 1); ++m) {
            const double value = decade(m, e);
            if (value < range.min * (1 - 1e-9) || value > range.max * (1 + 1e-9)) continue;
            const bool major = labelled(m, e);
            result.push_back({std::clamp(value, range.min, range.max),
                              major ? decadeLabel(m, e, decades.scientific) : std::string(), major});
        }
    return result;
}

std::vector<Tick> logTicks(const ValueRange& range, int majorCount) {
    const Decades decades(range);
    if (decades.count() >= 2) {
        int stride = 1;
        while ((decades.count() + stride - 1) / stride > majorCount) ++stride;
        return decadeTicks(range, decades, stride == 1, [&](int m, int e) { return m == 1 && e % stride == 0; });
    }
    // Less than two powers of ten: label 2 and 5 as well; a short piece of a logarithmic axis is nearly linear.
    auto result = decadeTicks(range, decades, true, [](int m, int) { return m == 1 || m == 2 || m == 5; });
    const auto majors = std::count_if(result.begin(), result.end(), [](const Tick& t) { return t.major; });
    return majors >= 2 && majors <= majorCount ? result : linearTicks(range, majorCount, -400);
}

}  // namespace

std::vector<Tick> ticks(const ValueRange& range, int majorCount) {
    const ValueRange valid = range.repaired();
    majorCount = std::clamp(majorCount, 2, 100);
    return valid.log ? logTicks(valid, majorCount) : linearTicks(valid, majorCount, -400);
}

std::vector<Tick> integerTicks(const ValueRange& range, int majorCount) {
    ValueRange valid = range.repaired();
    valid.log = false;
    return linearTicks(valid, std::clamp(majorCount, 2, 100), 0);
}

}  // namespace emca::analysis
