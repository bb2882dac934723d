#include "emca/render/sampler.h"

namespace emca::render {

const char* name(SamplerKind kind) { return kind == SamplerKind::sobol ? "sobol" : "independent"; }

}  // namespace emca::render
