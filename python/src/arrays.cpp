#include "arrays.h"

#include <pybind11/numpy.h>

namespace emca::python {
namespace {

py::dtype dtypeOf(Number number) {
    switch (number) {
        case Number::boolean:
            return py::dtype::of<bool>();
        case Number::uint8:
            return py::dtype::of<std::uint8_t>();
        case Number::uint32:
            return py::dtype::of<std::uint32_t>();
        case Number::uint64:
            return py::dtype::of<std::uint64_t>();
        case Number::int32:
            return py::dtype::of<std::int32_t>();
        case Number::int64:
            return py::dtype::of<std::int64_t>();
        case Number::float32:
            return py::dtype::of<float>();
        case Number::float64:
            break;
    }
    return py::dtype::of<double>();
}

/// What keeps the memory of a view alive.
py::capsule baseOf(std::shared_ptr<const void> owner) {
    return py::capsule(new std::shared_ptr<const void>(std::move(owner)),
                       [](void* held) { delete static_cast<std::shared_ptr<const void>*>(held); });
}

py::object readOnly(py::array array) {
    py::detail::array_proxy(array.ptr())->flags &= ~py::detail::npy_api::NPY_ARRAY_WRITEABLE_;
    return array;
}

template <typename T>
using PlainArray = py::array_t<T, py::array::c_style | py::array::forcecast>;

/// Raises what numpy says of anything that is no array.
template <typename T>
PlainArray<T> toArray(py::handle value) {
    return PlainArray<T>(py::reinterpret_borrow<py::object>(value));
}

/// Without numpy for what is no array: this is on the way of every recorded value.
bool threeNumbers(py::handle value, double (&out)[3]) {
    if (!PyTuple_Check(value.ptr()) && !PyList_Check(value.ptr())) {
        if (!PySequence_Check(value.ptr())) return false;
        const py::object fast = py::reinterpret_steal<py::object>(PySequence_Fast(value.ptr(), "no sequence"));
        if (!fast) throw py::error_already_set();
        return threeNumbers(fast, out);
    }
    if (PySequence_Fast_GET_SIZE(value.ptr()) != 3) return false;
    for (int i = 0; i < 3; ++i) {
        out[i] = PyFloat_AsDouble(PySequence_Fast_GET_ITEM(value.ptr(), i));
        if (out[i] == -1 && PyErr_Occurred()) throw py::error_already_set();
    }
    return true;
}

}  // namespace

py::object view(const void* data, Number number, std::size_t count, std::size_t components, std::size_t stride,
                std::shared_ptr<const void> owner) {
    std::vector<py::ssize_t> shape{static_cast<py::ssize_t>(count)}, strides{static_cast<py::ssize_t>(stride)};
    if (components > 1) {
        shape.push_back(static_cast<py::ssize_t>(components));
        strides.push_back(static_cast<py::ssize_t>(byteSize(number)));
    }
    if (count == 0) return readOnly(py::array(dtypeOf(number), std::move(shape)));
    return readOnly(py::array(dtypeOf(number), std::move(shape), std::move(strides), data, baseOf(std::move(owner))));
}

py::object imageView(const float* data, std::size_t height, std::size_t width, std::size_t channels,
                     std::shared_ptr<const void> owner) {
    const std::vector<py::ssize_t> shape{static_cast<py::ssize_t>(height), static_cast<py::ssize_t>(width),
                                         static_cast<py::ssize_t>(channels)};
    if (height * width * channels == 0) return readOnly(py::array(py::dtype::of<float>(), shape));
    return readOnly(py::array(py::dtype::of<float>(), shape, data, baseOf(std::move(owner))));
}

Numbers toFloats(py::handle value) {
    const auto array = toArray<float>(value);
    Numbers out;
    out.values.assign(array.data(), array.data() + array.size());
    for (py::ssize_t i = 0; i < array.ndim(); ++i) out.shape.push_back(static_cast<std::size_t>(array.shape(i)));
    return out;
}

std::vector<double> toDoubles(py::handle value) {
    const auto array = toArray<double>(value);
    return {array.data(), array.data() + array.size()};
}

std::vector<std::uint32_t> toIndices(py::handle value) {
    const auto array = toArray<std::int64_t>(value);
    std::vector<std::uint32_t> out;
    out.reserve(static_cast<std::size_t>(array.size()));
    for (py::ssize_t i = 0; i < array.size(); ++i) {
        const std::int64_t index = array.data()[i];
        if (index < 0 || index > 0xffffffffll) throw py::value_error("an index lies outside 0 … 4294967295");
        out.push_back(static_cast<std::uint32_t>(index));
    }
    return out;
}

Vec3f toVec3(py::handle value, const char* what) {
    double v[3];
    if (!threeNumbers(value, v)) throw py::type_error(std::string(what) + " must be three numbers");
    return {static_cast<float>(v[0]), static_cast<float>(v[1]), static_cast<float>(v[2])};
}

Color toColor(py::handle value, const char* what) {
    if (PyFloat_Check(value.ptr()) || PyLong_Check(value.ptr())) return Color(value.cast<float>());
    const Vec3f v = toVec3(value, what);
    return {v.x, v.y, v.z};
}

py::tuple toTuple(Vec3f v) { return py::make_tuple(v.x, v.y, v.z); }
py::tuple toTuple(Color c) { return py::make_tuple(c.r, c.g, c.b); }

py::str toText(std::string_view text) {
    PyObject* decoded = PyUnicode_DecodeUTF8(text.data(), static_cast<py::ssize_t>(text.size()), "replace");
    if (!decoded) throw py::error_already_set();
    return py::reinterpret_steal<py::str>(decoded);
}

py::list toList(const std::vector<std::string>& texts) {
    py::list out;
    for (const std::string& text : texts) out.append(toText(text));
    return out;
}

}  // namespace emca::python
