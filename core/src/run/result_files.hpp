#pragma once
// The surfaces and volumes of a run: written into the staging folder, then measured from the
// written files.

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include <dsc/base/workers.hpp>
#include <dsc/cloud/target.hpp>
#include <dsc/hooks/attributes.hpp>
#include <dsc/mesh/tet_mesh.hpp>
#include <dsc/run/experiment.hpp>
#include <dsc/run/run_experiment.hpp>
#include <dsc/run/run_folder.hpp>
#include <dsc/surface/triangle_mesh.hpp>

namespace dsc::run {

class ResultFiles {
public:
    ResultFiles(const RunFolder& folder, const Output& output, Workers& workers)
        : folder_(folder), output_(output), workers_(workers) {}

    /// `mesh` is in the units of the input. `gaps` are the distances of the interface's vertices to
    /// the points, in spacings; empty without a cloud. If no label above 0 is left and there is no
    /// cloud, the motion has ended and the result is a volume without a surface; with a cloud it is
    /// GeometryError "run.vanished". GeometryError "run.trimmed" if trimming removes everything.
    void write(const mesh::TetMesh& mesh, const hooks::Attributes& attributes,
               const cloud::TargetCloud* target, std::span<const double> gaps, RunOutcome& outcome);

    void measure_files(RunOutcome& outcome) const;

    /// The surface in the files surface.*, after write().
    const surface::TriangleMesh& surface() const { return surface_; }
    /// The point of the volume of each of its points.
    const std::vector<std::uint32_t>& vertex_of() const { return vertex_of_; }

private:
    SurfaceMeasure measure_surface(const std::string& stem, const surface::TriangleMesh& expected,
                                   bool& conforms) const;
    std::filesystem::path staged(const std::string& stem, const std::string& extension) const;
    void trim_surface(const hooks::Attributes& attributes, std::span<const double> gaps,
                      std::vector<std::uint32_t>& vertex_of, RunOutcome& outcome);

    const RunFolder& folder_;
    const Output& output_;
    Workers& workers_;
    surface::TriangleMesh surface_;
    std::vector<std::uint32_t> vertex_of_;
    std::vector<double> gaps_, support_;  // for trimming
};

}  // namespace dsc::run
