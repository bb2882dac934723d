#include "errors.h"

#include "arrays.h"

namespace emca::python {
namespace {

py::module_ errorsModule() { return py::module_::import("emca.errors"); }

/// Characters of UTF-8 text before a byte: Python counts characters.
std::size_t characters(const std::string& text, std::size_t bytes) {
    std::size_t count = 0;
    for (std::size_t i = 0; i < bytes && i < text.size(); ++i)
        count += (static_cast<unsigned char>(text[i]) & 0xc0) != 0x80;
    return count;
}

}  // namespace

py::object Failure::toPython() const {
    const py::object make = errorsModule().attr("_make");
    const char* code = name(error_.code);
    if (!query_) return make(code, toText(error_.message));
    return make(code, toText(error_.message), toText(*query_), characters(*query_, begin_), characters(*query_, end_));
}

Error toError(py::error_already_set& exception, const char* where) {
    try {
        const py::tuple described =
            errorsModule().attr("_describe")(exception.type(), exception.value(), exception.trace(), where);
        return {static_cast<ErrorCode>(described[0].cast<int>()), described[1].cast<std::string>()};
    } catch (py::error_already_set&) {
        return {ErrorCode::rendererFailed,
                std::string("The renderer's ") + where + " raised an exception that cannot be described."};
    }
}

void bindErrors() {
    py::register_exception_translator([](std::exception_ptr thrown) {
        try {
            if (thrown) std::rethrow_exception(thrown);
        } catch (const Failure& failure) {
            try {
                const py::object exception = failure.toPython();
                PyErr_SetObject(reinterpret_cast<PyObject*>(Py_TYPE(exception.ptr())), exception.ptr());
            } catch (py::error_already_set& other) {
                other.restore();
            }
        }
    });
}

}  // namespace emca::python
