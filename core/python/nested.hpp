#pragma once
// A strategy that a strategy written in Python contains: a velocity or a curvature of any plugin.

#include <memory>

#include <pybind11/pybind11.h>

#include <dsc/hooks/context.hpp>
#include <dsc/plugin/kind.hpp>

namespace dsc::python {

namespace py = pybind11;

/// The strategy as an object of Python.
struct Nested {
    plugin::Kind kind{};
    std::unique_ptr<hooks::Strategy> strategy;
    std::size_t vertices = 0;    ///< of the prepared surface
    Workers* workers = nullptr;  ///< of the prepared step
};

void declare_nested(py::module_& module);

}  // namespace dsc::python
