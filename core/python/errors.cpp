// Translation of errors between C++ and Python.
#include "errors.hpp"

#include <atomic>
#include <stdexcept>

#include <dsc/base/error.hpp>

namespace dsc::python {
namespace {

std::atomic<bool> interrupted{false};

const char* class_of(const Error& error) {
    switch (error.exit_code()) {
        case ExitCode::usage: return "UsageError";
        case ExitCode::config: return "ConfigError";
        case ExitCode::plugin:
            return dynamic_cast<const StrategyError*>(&error) != nullptr ? "StrategyError"
                                                                         : "PluginError";
        case ExitCode::geometry: return "GeometryError";
        case ExitCode::io: return "IoError";
        case ExitCode::stopped: return "CancelledError";
        case ExitCode::ok:
        case ExitCode::internal: break;
    }
    return "Error";
}

/// A text of the library as a str; bytes that are not UTF-8, such as those of a file's name, are
/// kept as the file system's functions of Python keep them.
py::object str_of(const std::string& text) {
    return py::reinterpret_steal<py::object>(
        PyUnicode_DecodeUTF8(text.data(), static_cast<Py_ssize_t>(text.size()), "surrogateescape"));
}

void raise(const Error& error) {
    const py::object type = py::module_::import("dsc._errors").attr(class_of(error));
    const py::object value =
        type(str_of(error.what()), error.code(), str_of(error.place()), str_of(error.cause()),
             str_of(error.remedy()), static_cast<int>(error.exit_code()));
    PyErr_SetObject(type.ptr(), value.ptr());
}

/// Whether a file of code belongs to the user: not to Python, and not to an installed package.
bool is_users(const std::string& file) {
    if (file.rfind("<frozen ", 0) == 0 || file == "<__array_function__ internals>") return false;
    for (const char* folder : {"/site-packages/", "/dist-packages/"}) {
        if (file.find(folder) != std::string::npos) return false;
    }
    const auto library =
        py::module_::import("sysconfig").attr("get_path")("stdlib").cast<std::string>();
    return file.rfind(library + "/", 0) != 0;
}

/// The innermost line of the user's code; empty if there is none.
std::string place_of(const py::error_already_set& error) {
    if (!error.trace()) return {};
    py::object trace;
    for (py::object next = error.trace(); !next.is_none(); next = next.attr("tb_next")) {
        if (is_users(next.attr("tb_frame").attr("f_code").attr("co_filename").cast<std::string>()))
            trace = next;
    }
    if (!trace) return {};
    const py::object code = trace.attr("tb_frame").attr("f_code");
    return py::str("{}:{}, in {}")
        .format(code.attr("co_filename"), trace.attr("tb_lineno"), code.attr("co_name"))
        .cast<std::string>();
}

}  // namespace

void translate_errors() {
    py::register_exception_translator([](std::exception_ptr pointer) {
        try {
            if (pointer) std::rethrow_exception(pointer);
        } catch (const Error& error) {
            raise(error);
        }
    });
}

std::string text_of(const py::error_already_set& error) {
    std::string text = py::str(error.type().attr("__name__")).cast<std::string>();
    try {
        const auto message = py::str(error.value()).cast<std::string>();
        if (!message.empty()) text += ": " + message;
        const std::string place = place_of(error);
        if (!place.empty()) text += " (" + place + ")";
    } catch (const py::error_already_set&) {
        text += ", whose text cannot be read";
    }
    return text;
}

void rethrow_from_python(py::error_already_set& error) {
    if (error.matches(PyExc_KeyboardInterrupt)) {
        set_interrupted();
        throw CancelledError("the run was interrupted");
    }
    throw std::runtime_error(text_of(error));
}

bool take_interrupted() { return interrupted.exchange(false); }
void set_interrupted() { interrupted = true; }

}  // namespace dsc::python
