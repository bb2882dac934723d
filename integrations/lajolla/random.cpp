#include "random.h"

// pcg.h defines two functions that are not inline, and render.cpp has them already: here they get another name.
#define next_pcg32_real emca_lajolla_next_pcg32_real
#include "pcg.h"

namespace emca::lajolla {

Random::Random() : state_(std::make_unique<pcg32_state>()) { seed(0); }
Random::~Random() = default;

void Random::seed(std::uint64_t seed) { *state_ = init_pcg32(1, seed); }

Real Random::next() { return emca_lajolla_next_pcg32_real<Real>(*state_); }

}  // namespace emca::lajolla
