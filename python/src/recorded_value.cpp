#include "recorded_value.h"

#include <pybind11/numpy.h>

#include <string_view>

#include "arrays.h"

namespace emca::python {
namespace {

constexpr auto kPlain = py::array::c_style | py::array::forcecast;

template <typename T>
Value fromNumbers(const T* v, py::ssize_t size) {
    if (size == 1) return v[0];
    if (size == 2) return Vec2<T>{v[0], v[1]};
    return Vec3<T>{v[0], v[1], v[2]};
}

template <typename T>
Value fromArray(const py::array& array) {
    const py::array_t<T, kPlain> typed(array);
    return fromNumbers(typed.data(), typed.size());
}

Value fromArray(const py::array& array) {
    const char kind = array.dtype().kind();
    if (array.ndim() > 1 || array.size() == 0)
        throw py::value_error("EMCA records numbers, or one-dimensional arrays of at least one number");
    if (kind == 'U' && array.size() == 1) return py::str(array.attr("item")()).cast<std::string>();
    if (kind == 'b' && array.size() == 1) return array.attr("item")().cast<bool>();
    if (kind != 'f' && kind != 'i' && kind != 'u')
        throw py::type_error("EMCA cannot record values of the numpy type " +
                             py::str(array.dtype()).cast<std::string>());
    if (array.size() > 3) {
        const py::array_t<float, kPlain> typed(array);
        return std::vector<float>(typed.data(), typed.data() + typed.size());
    }
    if (kind != 'f') return fromArray<std::int64_t>(array);
    return array.itemsize() <= 4 ? fromArray<float>(array) : fromArray<double>(array);
}

/// Tuples and lists of two or three floats, which are common, without the detour through numpy.
bool floats(PyObject* value, double (&out)[3], py::ssize_t& size) {
    if (!PyTuple_CheckExact(value) && !PyList_CheckExact(value)) return false;
    size = PySequence_Fast_GET_SIZE(value);
    if (size < 2 || size > 3) return false;
    for (py::ssize_t i = 0; i < size; ++i) {
        PyObject* item = PySequence_Fast_GET_ITEM(value, i);
        if (!PyFloat_CheckExact(item)) return false;
        out[i] = PyFloat_AS_DOUBLE(item);
    }
    return true;
}

/// emca.Color and emca.ColorA: never let go, as the recorder may run until the interpreter ends.
py::handle colorClass(const char* name) {
    return py::module_::import("emca.scene").attr(name).cast<py::object>().release();
}

bool isColor(py::handle value) {
    static const py::handle color = colorClass("Color");
    return py::isinstance(value, color);
}
bool isColorA(py::handle value) {
    static const py::handle color = colorClass("ColorA");
    return py::isinstance(value, color);
}

template <typename Enum>
Enum byName(py::handle value, int count, const char* what) {
    if (PyUnicode_Check(value.ptr())) {
        const auto text = value.cast<std::string>();
        for (int i = 0; i < count; ++i)
            if (text == name(static_cast<Enum>(i))) return static_cast<Enum>(i);
    } else if (const auto number = value.cast<int>(); number >= 0 && number < count) {
        return static_cast<Enum>(number);
    }
    throw py::value_error(std::string("there is no ") + what + " " + py::repr(value).cast<std::string>());
}

}  // namespace

Value toValue(py::handle value) {
    PyObject* raw = value.ptr();
    if (PyFloat_Check(raw)) return PyFloat_AS_DOUBLE(raw);
    if (PyBool_Check(raw)) return raw == Py_True;
    if (PyLong_Check(raw)) return value.cast<std::int64_t>();
    if (PyUnicode_Check(raw)) return value.cast<std::string>();
    double v[3];
    if (py::ssize_t size = 0; floats(raw, v, size)) return fromNumbers(v, size);
    if (isColor(value)) return toColor(value, "a colour");
    if (isColorA(value)) {
        const auto rgba = toDoubles(value);
        return ColorA{static_cast<float>(rgba[0]), static_cast<float>(rgba[1]), static_cast<float>(rgba[2]),
                      static_cast<float>(rgba[3])};
    }
    const py::array array = py::array::ensure(value);
    if (!array) throw py::type_error("EMCA cannot record " + py::repr(value).cast<std::string>());
    return fromArray(array);
}

py::object resolved(py::handle value) {
    if (PyCallable_Check(value.ptr())) return value();
    return py::reinterpret_borrow<py::object>(value);
}

Event toEvent(py::handle event) { return byName<Event>(event, kEventCount, "event"); }
Lobe toLobe(py::handle lobe) { return byName<Lobe>(lobe, kLobeCount, "lobe"); }
Subpath toSubpath(py::handle subpath) { return byName<Subpath>(subpath, 2, "subpath"); }

LightEnd toLightEnd(py::handle end) {
    if (PyUnicode_Check(end.ptr())) {
        const auto text = end.cast<std::string>();
        if (text == "automatic") return LightEnd::automatic;
        if (text == "hit") return LightEnd::hit;
        if (text == "connected") return LightEnd::connected;
    }
    throw py::value_error("a contribution ends \"automatic\", \"hit\" or \"connected\"");
}

Pixel toPixel(py::handle pixel) {
    const std::vector<std::uint32_t> xy = toIndices(pixel);
    if (xy.size() != 2) throw py::value_error("a pixel is (x, y)");
    return {xy[0], xy[1]};
}

}  // namespace emca::python
