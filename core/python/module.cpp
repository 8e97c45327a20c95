// The extension module dsc._dsc: what the package `dsc` needs from the library.
#include <string>

#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <dsc/base/log.hpp>
#include <dsc/base/version.hpp>

#include "contexts.hpp"
#include "errors.hpp"
#include "evaluate.hpp"
#include "loader.hpp"
#include "nested.hpp"
#include "nodes.hpp"
#include "outcome.hpp"
#include "run.hpp"

namespace {

namespace py = pybind11;

/// Sends the messages of the library to `sink(level, text)`. The sink stays until the process ends.
void set_log(const py::object& sink) {
    py::handle kept = sink.inc_ref();
    dsc::set_log_sink([kept](dsc::LogLevel level, std::string_view text) {
        const py::gil_scoped_acquire held;
        try {
            kept(static_cast<int>(level), std::string(text));
        } catch (py::error_already_set& error) {
            error.discard_as_unraisable("the log of dsc");
        }
    });
}

py::object read_yaml(const std::string& file) {
    return dsc::python::object_from(dsc::config::load_yaml(file));
}

}  // namespace

PYBIND11_MODULE(_dsc, module) {
    module.attr("version") = DSC_VERSION;
    dsc::python::translate_errors();
    dsc::python::declare_contexts(module);
    dsc::python::declare_nested(module);
    dsc::python::declare_outcome(module);
    dsc::python::declare_run(module);
    dsc::python::declare_evaluate(module);
    module.def("set_log", &set_log);
    module.def("read_yaml", &read_yaml);
    dsc::python::register_loader();
}
