#pragma once

#include <type_traits>
#include <utility>

namespace emca::adapter {

/// While it lives, a variable has another value; then it has the one that it had before. For what a thread's calls are to
/// find without being told, such as the observer of the current path:
///
///     const Exchanged observed(currentObserver(), &observer);
template <typename T>
class Exchanged {
  public:
    /// \param variable  outlives it
    [[nodiscard]] Exchanged(T& variable, std::type_identity_t<T> value)
        : variable_(variable), before_(std::exchange(variable, std::move(value))) {}
    ~Exchanged() { variable_ = std::move(before_); }
    Exchanged(const Exchanged&) = delete;
    Exchanged& operator=(const Exchanged&) = delete;

  private:
    T& variable_;
    T before_;
};

}  // namespace emca::adapter
