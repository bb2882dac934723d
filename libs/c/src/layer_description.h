#pragma once

#include "emca/core/surface_field.h"
#include "guard.h"

namespace emca::c {
/// Checked. Errors: invalidArgument, versionMismatch.
Result<LayerDescription> description(const emca_layer_description* given);
}  // namespace emca::c
