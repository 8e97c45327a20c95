#pragma once
// The result of a run in memory.

#include <filesystem>
#include <string>
#include <vector>

#include <pybind11/pybind11.h>

#include <dsc/hooks/attributes.hpp>
#include <dsc/run/run_experiment.hpp>

namespace dsc::python {

namespace py = pybind11;

/// What the files of a run contain, in the units of the input.
struct Outcome {
    mesh::TetMesh volume;
    std::vector<double> quality;  ///< per tet
    surface::TriangleMesh surface;
    std::vector<std::uint32_t> vertex_of;  ///< point of the volume of each point of the surface
    hooks::Attributes point_attributes;    ///< per point of the volume
    hooks::Attributes attributes;          ///< per point of the surface
    run::RunOutcome run;

    /// Copies the result. `run` stays empty.
    void take(const run::ResultData& data);

    /// Writes the surface or the volume in the format of the extension, as `dsc reconstruct` does.
    /// Throws UsageError "usage.format", and as io::write_surface and io::write_volume.
    void save(const std::filesystem::path& file) const;
};

void declare_outcome(py::module_& module);

}  // namespace dsc::python
