#pragma once

namespace emca::analysis {

/// The value that Student's t with this many degrees of freedom (positive) exceeds with probability `tail` in (0, 1).
/// In a file of its own: the library behind it takes seconds to compile.
double studentTUpperQuantile(double degreesOfFreedom, double tail);

}  // namespace emca::analysis
