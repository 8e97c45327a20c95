#pragma once
// The plugins of a call: those on the search path, and the strategies that the program itself
// defines.

#include <string>
#include <vector>

#include <pybind11/pybind11.h>

#include <dsc/host/host.hpp>
#include <dsc/run/experiment.hpp>

namespace dsc::python {

namespace py = pybind11;

/// Owns the host of a call.
class Session {
public:
    /// `plugins`: libraries, folders or Python files.
    explicit Session(std::vector<std::string> plugins) : plugins_(std::move(plugins)) {}

    /// Adds the strategies that the program has declared outside of a Python file that dsc loads.
    /// Their texts become known to `files`, for provenance. The GIL must be held. Throws
    /// PluginError.
    void add_own(run::InputFiles& files);

    /// In the form that run::load_experiment needs; this object must outlive it.
    run::PluginLoader loader();
    const host::Host& host() const { return host_; }

private:
    std::vector<std::string> plugins_;
    host::Host host_;
};

}  // namespace dsc::python
