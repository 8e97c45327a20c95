#pragma once
// Values of a configuration as values of Python, and back.

#include <string>

#include <pybind11/pybind11.h>

#include <dsc/config/node.hpp>

namespace dsc::python {

namespace py = pybind11;

/// None, bool, int, float, str, list or dict. The GIL must be held.
py::object object_from(const config::ConfigNode& node);

/// The same back; also accepts tuples, paths and the numbers and arrays of NumPy. Throws UsageError
/// "value.type" that names the value by `path`. The GIL must be held.
config::ConfigNode node_from(const py::handle& value, const std::string& path);

}  // namespace dsc::python
