#pragma once

#include <pybind11/pybind11.h>

#include <functional>
#include <memory>
#include <optional>
#include <type_traits>
#include <utility>

#include "emca/client/connection.h"
#include "errors.h"

namespace emca::python {

using Work = std::function<void(const client::RequestObserver&)>;

/// Runs `work` in a thread of its own. The calling thread waits without the interpreter's lock, so that other Python
/// threads go on; signals and progress are seen to in the calling thread, a few times a second. Thus no thread of the
/// client ever waits for the interpreter. If Ctrl-C or `progress` raises, the work is cancelled and waited for, and the
/// exception goes on.
/// \param progress  called with the fraction done in [0, 1], or None
void runInterruptibly(const Work& work, const py::object& progress = py::none());

/// The same for work that nothing can cancel: on Ctrl-C it is left alone and ends by itself, so it must own what it
/// uses.
void runOrAbandon(std::function<void()> work);

/// \param call  (const client::RequestObserver&) -> Result<T>
template <typename Call>
auto await(const Call& call, const py::object& progress = py::none()) {
    std::optional<std::invoke_result_t<Call, const client::RequestObserver&>> result;
    runInterruptibly([&](const client::RequestObserver& observer) { result.emplace(call(observer)); }, progress);
    return unwrap(std::move(*result));
}

}  // namespace emca::python
