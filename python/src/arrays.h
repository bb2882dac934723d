#pragma once

#include <pybind11/pybind11.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "emca/core/color.h"
#include "emca/core/shared_array.h"
#include "emca/core/vector.h"

/// numpy arrays that look into our memory. numpy's own headers stay in arrays.cpp, since they are slow to compile.
namespace emca::python {

namespace py = pybind11;

/// What an array holds.
enum class Number : std::uint8_t { boolean, uint8, uint32, uint64, int32, int64, float32, float64 };
constexpr std::size_t byteSize(Number number) {
    constexpr std::size_t kSizes[] = {1, 1, 4, 8, 4, 8, 4, 8};
    return kSizes[static_cast<std::size_t>(number)];
}

/// `count` entries of `components` numbers each, `stride` bytes from entry to entry, as a read-only array of shape
/// (count,), or (count, components) if there are several. No copy: the array's base keeps `owner` alive.
py::object view(const void* data, Number number, std::size_t count, std::size_t components, std::size_t stride,
                std::shared_ptr<const void> owner);
/// A read-only image of shape (height, width, channels). No copy.
py::object imageView(const float* data, std::size_t height, std::size_t width, std::size_t channels,
                     std::shared_ptr<const void> owner);

/// A part of every entry of a shared array: `components` numbers at byte `offset` of it.
template <typename T>
py::object view(const SharedArray<T>& from, Number number, std::size_t components = 1, std::size_t offset = 0) {
    return view(reinterpret_cast<const std::byte*>(from.data()) + offset, number, from.size(), components, sizeof(T),
                from.owner());
}

/// The vector's own memory as an array of shape (n,), or (n, components).
template <typename T>
py::object moved(std::vector<T> values, Number number, std::size_t components = 1) {
    auto owner = std::make_shared<const std::vector<T>>(std::move(values));
    const std::size_t stride = components * byteSize(number), count = owner->size() * sizeof(T) / stride;
    const T* data = owner->data();
    return view(data, number, count, components, stride, std::move(owner));
}

/// Any array-like of numbers.
struct Numbers {
    std::vector<float> values;  ///< row by row
    std::vector<std::size_t> shape;
};
/// Errors (as Python exceptions): whatever numpy says about what is no array of numbers.
Numbers toFloats(py::handle array);
std::vector<double> toDoubles(py::handle array);
std::vector<std::uint32_t> toIndices(py::handle array);  ///< flattened; negative ones raise ValueError

/// Three numbers, from any sequence or array of three. Raises TypeError or ValueError that names `what`.
Vec3f toVec3(py::handle value, const char* what);
Color toColor(py::handle value, const char* what);

py::tuple toTuple(Vec3f v);
py::tuple toTuple(Color c);

/// Text out of the network: bytes that are no UTF-8 become U+FFFD.
py::str toText(std::string_view text);
py::list toList(const std::vector<std::string>& texts);

}  // namespace emca::python
