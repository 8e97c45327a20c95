// Starts Python in a process that is not Python: the host loads this library for the first Python
// file that an experiment or the command line names.
#include <cstdlib>
#include <string>

#include <pybind11/pybind11.h>

#include <dsc/base/error.hpp>
#include <dsc/plugin/entry.hpp>

namespace dsc::python {
namespace {

namespace py = pybind11;

[[noreturn]] void refuse(const std::string& cause) {
    throw PluginError("plugin.no_python", "Python", "cannot be started: " + cause,
                      "check that python3 and python3-numpy of the build are installed");
}

void require_ok(const PyStatus& status) {
    if (PyStatus_Exception(status) == 0) return;
    refuse(status.err_msg == nullptr ? "no reason given" : status.err_msg);
}

/// Signals and the standard streams stay those of the program. What Python prints is not kept back,
/// because the interpreter is never ended.
void start_interpreter() {
    PyConfig config;
    PyConfig_InitPythonConfig(&config);
    config.install_signal_handlers = 0;
    config.buffered_stdio = 0;
    config.parse_argv = 0;
    // The interpreter of the build; otherwise it would be looked for on the PATH.
    const PyStatus named =
        PyConfig_SetBytesString(&config, &config.program_name, DSC_PYTHON_EXECUTABLE);
    const PyStatus started =
        PyStatus_Exception(named) != 0 ? named : Py_InitializeFromConfig(&config);
    PyConfig_Clear(&config);
    require_ok(started);
}

void import_package(const char* folder) {
    const py::module_ sys = py::module_::import("sys");
    sys.attr("path").attr("insert")(0, folder);
    sys.attr("_dsc_host") = true;  // the log belongs to the program
    py::module_::import("dsc");
}

}  // namespace
}  // namespace dsc::python

/// `modules`: the folder that contains the package `dsc`. Throws PluginError "plugin.no_python".
extern "C" DSC_PLUGIN_EXPORT void dsc_start_python(const char* modules) {
    // The threads of a library for linear algebra would be of no use and cost time.
    setenv("OPENBLAS_NUM_THREADS", "1", 0);
    if (Py_IsInitialized() != 0) return;
    dsc::python::start_interpreter();
    try {
        dsc::python::import_package(modules);
    } catch (const pybind11::error_already_set& error) {
        dsc::python::refuse(error.what());
    }
    PyEval_SaveThread();  // strategies take the lock when they need it
}
