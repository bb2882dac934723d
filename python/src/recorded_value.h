#pragma once

#include <pybind11/pybind11.h>

#include "emca/core/event.h"
#include "emca/core/pixel.h"
#include "emca/core/value.h"

/// What a renderer in Python hands to the recorder, as our types.
namespace emca::python {

namespace py = pybind11;

/// A value to record, of any type that Value has: bool, int, float (stored as double), str, emca.Color, emca.ColorA,
/// numpy scalars and arrays of their own precision, sequences of two or three numbers; longer ones are spectra.
/// Raises TypeError or ValueError for anything else.
Value toValue(py::handle value);
/// The value itself, or what it returns if it can be called.
py::object resolved(py::handle valueOrCallable);

/// By number (emca.Event) or name ("reflect").
Event toEvent(py::handle event);
Lobe toLobe(py::handle lobe);
Subpath toSubpath(py::handle subpath);
LightEnd toLightEnd(py::handle end);
/// From (x, y). Raises ValueError for negative ones.
Pixel toPixel(py::handle pixel);

}  // namespace emca::python
