#include "student_t.h"

#include <boost/math/distributions/students_t.hpp>

namespace emca::analysis {
namespace {

namespace policies = boost::math::policies;
/// Nothing is thrown: what cannot be computed is NaN or infinite.
using Policy =
    policies::policy<policies::promote_double<false>, policies::domain_error<policies::errno_on_error>,
                     policies::pole_error<policies::errno_on_error>, policies::overflow_error<policies::errno_on_error>,
                     policies::rounding_error<policies::errno_on_error>,
                     policies::evaluation_error<policies::errno_on_error>>;

}  // namespace

double studentTUpperQuantile(double degreesOfFreedom, double tail) {
    const boost::math::students_t_distribution<double, Policy> t(degreesOfFreedom);
    return boost::math::quantile(boost::math::complement(t, tail));
}

}  // namespace emca::analysis
