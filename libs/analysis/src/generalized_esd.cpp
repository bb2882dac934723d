#include "generalized_esd.h"

#include <algorithm>
#include <cmath>

#include "student_t.h"

namespace emca::analysis {
namespace {

struct Candidate {
    double value;
    Index index;
    friend bool operator<(const Candidate& a, const Candidate& b) {
        return a.value != b.value ? a.value < b.value : a.index < b.index;
    }
};

/// Number, mean and sum of squared deviations of some values.
struct Moments {
    double count = 0, mean = 0, squares = 0;

    void add(double value) {  // Welford
        const double delta = value - mean;
        mean += delta / ++count;
        squares += delta * (value - mean);
    }
    double deviation() const { return count < 2 ? 0 : std::sqrt(squares / (count - 1)); }
};

/// Chan, Golub and LeVeque, "Updating Formulae and a Pairwise Algorithm for Computing Sample Variances", 1979.
Moments merged(const Moments& a, const Moments& b) {
    const double count = a.count + b.count;
    if (count == 0) return {};
    const double delta = b.mean - a.mean;
    return {count, a.mean + delta * b.count / count, a.squares + b.squares + delta * delta * a.count * b.count / count};
}

/// What is left of the values while extremes are taken away. The farthest value from a mean is the smallest or the
/// largest, so only the r smallest and the r largest can ever go. Taking a value out of a sum of squares that it
/// dominates (a firefly is a million times the rest) would leave rounding errors only. Therefore nothing is subtracted:
/// the core that always stays is summed once, the r values at each end are added from the inside outwards, and every
/// intermediate sum is kept. What is left after any step is the core and one such sum from each end.
class Remaining {
  public:
    /// \param r  how many can be taken away; 2 r < size
    Remaining(std::vector<Candidate> values, std::size_t r, bool upperOnly) : values_(std::move(values)) {
        low_ = upperOnly ? 0 : r;
        const std::size_t high = values_.size() - r;
        const auto at = [this](std::size_t i) { return values_.begin() + static_cast<std::ptrdiff_t>(i); };
        std::nth_element(at(0), at(low_), values_.end());
        std::nth_element(at(low_), at(high), values_.end());
        std::sort(at(0), at(low_));
        std::sort(at(high), values_.end());
        for (std::size_t i = low_; i < high; ++i) core_.add(values_[i].value);
        smallestOfCore_ = std::min_element(at(low_), at(high))->value;
        lows_.resize(low_ + 1);
        for (std::size_t i = low_; i-- > 0;) {
            lows_[low_ - i] = lows_[low_ - i - 1];
            lows_[low_ - i].add(values_[i].value);
        }
        highs_.resize(r + 1);
        for (std::size_t i = high; i < values_.size(); ++i) {
            highs_[i - high + 1] = highs_[i - high];
            highs_[i - high + 1].add(values_[i].value);
        }
        high_ = high;
        end_ = values_.size();
        largestOfCore_ = std::max_element(at(low_), at(high))->value;
    }

    Moments moments() const { return merged(merged(core_, lows_[low_ - begin_]), highs_[end_ - high_]); }
    double smallest() const { return begin_ < low_ ? values_[begin_].value : smallestOfCore_; }
    double largest() const { return end_ > high_ ? values_[end_ - 1].value : largestOfCore_; }

    /// The value that is farthest from the mean (of two, the larger one; one-sided: the largest), which is taken away.
    Candidate takeFarthest(double mean) {
        const bool fromLow = begin_ < low_ && mean - values_[begin_].value > values_[end_ - 1].value - mean;
        return fromLow ? values_[begin_++] : values_[--end_];
    }

  private:
    std::vector<Candidate> values_;  // sorted before low_ and from high_ on
    std::size_t begin_ = 0, low_ = 0, high_ = 0, end_ = 0;
    Moments core_;
    std::vector<Moments> lows_, highs_;  // of the k values at either end that are nearest to the core
    double smallestOfCore_ = 0, largestOfCore_ = 0;
};

}  // namespace

double esdCritical(std::size_t n, std::size_t i, double alpha, bool oneSided) {
    const double left = static_cast<double>(n - i + 1);  // values at step i
    const double t = studentTUpperQuantile(left - 2, alpha / ((oneSided ? 1 : 2) * left));
    return (left - 1) * t / std::sqrt((left - 2 + t * t) * left);
}

OutlierReport generalizedEsd(std::span<const double> values, const OutlierOptions& options) {
    OutlierReport report;
    std::vector<Candidate> finite;
    finite.reserve(values.size());
    for (std::size_t i = 0; i < values.size(); ++i) {
        if (std::isfinite(values[i]))
            finite.push_back({values[i], static_cast<Index>(i)});
        else
            report.outliers.push_back(static_cast<Index>(i));
    }
    const std::size_t n = finite.size();
    report.considered = n;
    report.notFinite = report.outliers.size();
    if (n == 0) return report;

    const std::size_t r = std::min(options.maximum, (n - 1) / 2);
    Remaining remaining(std::move(finite), r, options.upperOnly);
    std::size_t found = 0;
    const auto describe = [&] {
        const Moments moments = remaining.moments();
        report.mean = moments.mean;
        report.deviation = moments.deviation();
        report.lower = remaining.smallest();
        report.upper = remaining.largest();
    };
    describe();
    // Values that are all equal are no outliers of each other, though rounding may give them a deviation.
    for (std::size_t i = 1; i <= r && remaining.smallest() < remaining.largest(); ++i) {
        const Moments moments = remaining.moments();
        const Candidate farthest = remaining.takeFarthest(moments.mean);
        const double deviation = moments.deviation();
        report.steps.push_back({farthest.index, farthest.value, moments.mean, deviation,
                                std::abs(farthest.value - moments.mean) / deviation,
                                esdCritical(n, i, options.significance, options.upperOnly)});
        if (!report.steps.back().significant()) continue;
        found = i;
        describe();
    }
    for (std::size_t i = 0; i < found; ++i) report.outliers.push_back(report.steps[i].index);
    std::sort(report.outliers.begin(), report.outliers.end());
    return report;
}

}  // namespace emca::analysis
