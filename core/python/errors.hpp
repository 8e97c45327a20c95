#pragma once
// Errors of the library become exceptions of Python, and exceptions of a strategy written in Python
// become errors.

#include <string>

#include <pybind11/pybind11.h>

namespace dsc::python {

namespace py = pybind11;

/// Makes every dsc::Error that reaches Python an exception of the class with its name in
/// dsc._errors.
void translate_errors();

/// An exception of Python as text: "ZeroDivisionError: division by zero (FILE:LINE, in FUNCTION)",
/// with the innermost place of the traceback that is not in a library. The GIL must be held.
std::string text_of(const py::error_already_set& error);

/// Rethrows an exception that a strategy's Python code raised, as std::runtime_error with that
/// text; KeyboardInterrupt as CancelledError, after which interrupted() is true. The GIL must be
/// held. To be called in a catch block.
[[noreturn]] void rethrow_from_python(py::error_already_set& error);

/// Whether the user has interrupted the work since the last call.
bool take_interrupted();
void set_interrupted();

}  // namespace dsc::python
