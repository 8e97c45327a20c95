#pragma once
// Runs of experiments and reconstructions.

#include <pybind11/pybind11.h>

namespace dsc::python {

namespace py = pybind11;

void declare_run(py::module_& module);

}  // namespace dsc::python
