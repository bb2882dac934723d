#pragma once

#include <mutex>
#include <optional>
#include <string>

#include "emca/adapter/serving.h"
#include "mitsuba_headers.h"
#include "traced_integrator.h"

namespace emca::mitsuba06 {

/// What an integrator of ours does when its image is done: serves the scene to explorers, if the scene file or the
/// environment says where.
///
/// Properties of the integrator: "serve" ("PORT" or "HOST:PORT"), or "port" (integer) and "host"; "token". Where none
/// of them is given, the environment variables EMCA_SERVE and EMCA_TOKEN count, so that a scene file need not be
/// touched.
class Serving {
  public:
    /// Throws, as Mitsuba's constructors do, if the address cannot be read.
    explicit Serving(const mts::Properties& properties);

    bool isAsked() const { return address_.has_value(); }
    /// Writes the film's image, then blocks until a client's quit request or stop(). Returns at once if not asked to
    /// serve, and with a line on the error stream if nobody can be served.
    /// \param traced  the integrator
    void run(mts::Scene& scene, const TracedIntegrator& traced);
    void stop();

    /// The properties that are read here: not for nested integrators.
    static const std::vector<std::string>& propertyNames();

  private:
    std::optional<adapter::ServeAddress> address_;
    std::string token_;
    std::mutex mutex_;
    Server* running_ = nullptr;
};

}  // namespace emca::mitsuba06
