#include "seeded_sampler.h"

#include "observer.h"

namespace emca::nori_adapter {

float SeededSampler::next1D() {
    const float u = random_.nextFloat();
    if (Observer* observer = currentObserver()) observer->randomNumber(u);
    return u;
}

nori::Point2f SeededSampler::next2D() {
    const float x = random_.nextFloat(), y = random_.nextFloat();
    const nori::Point2f u(x, y);
    if (Observer* observer = currentObserver()) observer->randomNumbers(u);
    return u;
}

}  // namespace emca::nori_adapter
