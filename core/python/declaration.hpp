#pragma once
// Classes of Python as strategies: what they declare becomes a plugin's records.

#include <vector>

#include <pybind11/pybind11.h>

#include <dsc/plugin/catalogue.hpp>
#include <dsc/plugin/registrar.hpp>

namespace dsc::python {

namespace py = pybind11;

/// What a Python file declares about itself: an object dsc._strategies.About. The GIL must be held.
plugin::PluginInfo info_of(const py::handle& about);

/// The records of classes that were declared with the decorators of dsc. The GIL must be held.
/// Throws PluginError "plugin.script", "plugin.schema".
std::vector<plugin::StrategyRecord> records_of(const py::handle& classes);

}  // namespace dsc::python
