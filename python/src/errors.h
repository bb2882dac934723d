#pragma once

#include <pybind11/pybind11.h>

#include <exception>
#include <optional>
#include <string>
#include <utility>

#include "emca/core/result.h"

namespace emca::python {

namespace py = pybind11;

/// An error of ours on its way to Python, where emca/errors.py makes the exception of its kind.
class Failure : public std::exception {
  public:
    explicit Failure(Error error) : error_(std::move(error)) {}
    /// About a piece of a query. \param begin, end  bytes of the text
    Failure(Error error, std::string query, std::size_t begin, std::size_t end)
        : error_(std::move(error)), query_(std::move(query)), begin_(begin), end_(end) {}
    const char* what() const noexcept override { return error_.message.c_str(); }
    const Error& error() const { return error_; }
    /// The Python exception object.
    py::object toPython() const;

  private:
    Error error_;
    std::optional<std::string> query_;
    std::size_t begin_ = 0, end_ = 0;
};

template <typename T>
T unwrap(Result<T> result) {
    if (!result.ok()) throw Failure(result.error());
    if constexpr (!std::is_void_v<T>) return std::move(result).value();
}

/// The Python exception in flight as an error value, for replies to clients: one of ours keeps its code, any other is
/// rendererFailed. \param where  what was asked, e.g. "render_pixel". The traceback goes to the logger "emca".
Error toError(py::error_already_set& exception, const char* where);

void bindErrors();

}  // namespace emca::python
