#pragma once
// The labelled volume for strategies written in Python.

#include <pybind11/pybind11.h>

#include <dsc/mesh/volume_view.hpp>

namespace dsc::python {

namespace py = pybind11;

/// The volume of one call; null after the call.
struct VolumeArrays {
    const mesh::VolumeView* volume = nullptr;
};

void declare_volume(py::module_& module);

}  // namespace dsc::python
