#pragma once
// Measures surfaces, and reads them from files.

#include <pybind11/pybind11.h>

namespace dsc::python {

namespace py = pybind11;

void declare_evaluate(py::module_& module);

}  // namespace dsc::python
