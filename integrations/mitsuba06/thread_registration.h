#pragma once

#include "mitsuba_headers.h"

#include <mitsuba/core/fresolver.h>
#include <mitsuba/core/logger.h>

namespace emca::mitsuba06 {

/// What a thread of EMCA's needs so that it may call Mitsuba: taken from a thread of Mitsuba's own.
class ThreadRegistration {
  public:
    /// Takes logger and search paths of the calling thread, which is one of Mitsuba's.
    ThreadRegistration();
    /// Makes the calling thread known to Mitsuba, until it ends; nothing if it is already.
    void registerThisThread() const;

  private:
    // Mitsuba's references give no pointer that one may set from a constant one.
    mutable mts::ref<mts::Logger> logger_;
    mutable mts::ref<mts::FileResolver> files_;
};

}  // namespace emca::mitsuba06
