#pragma once
// A complete run: from a loaded experiment to a run folder.

#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <dsc/base/error.hpp>
#include <dsc/run/coverage.hpp>
#include <dsc/run/experiment.hpp>
#include <dsc/run/input.hpp>
#include <dsc/run/measure.hpp>
#include <dsc/run/simulation.hpp>
#include <dsc/surface/trim.hpp>

namespace dsc::run {

/// The result of a run as its files contain it, in the units of the input.
struct ResultData {
    const mesh::TetMesh& volume;
    const surface::TriangleMesh& surface;  ///< with the colours of the points, trimmed if requested
    std::span<const std::uint32_t> vertex_of;  ///< point of `volume` of each point of `surface`
    const hooks::Attributes& attributes;       ///< per point of `volume`; NaN off the interface
    std::span<const double> gaps;  ///< per vertex of the interface: distance to the nearest point,
                                   ///< in spacings of that point; empty without a cloud
};

struct RunOptions {
    std::filesystem::path folder;  ///< empty: runs/NAME/HASH, with 12 digits of the hash
    unsigned threads = 1;
    std::optional<double> time_budget{};  ///< seconds, after which the run stops as if it was
                                          ///< cancelled
    const CancelToken* cancel = nullptr;
    bool last_good = true;  ///< keep the last state before a strategy failed in the folder
    bool picture = true;    ///< draw preview.png; not useful for a temporary folder
    bool resume = false;    ///< continue from the last checkpoint in the folder; in a new folder,
                            ///< start at the beginning
    std::vector<std::string> command{};  ///< as typed, for provenance.json
    std::function<void(const StepMetrics&, std::uint64_t planned)> on_step{};
    /// Receives the result when its files are complete. The references are valid during the call.
    std::function<void(const ResultData&)> on_result{};
    /// Makes the text of report.html from the folder of the run, if the experiment requests a
    /// report: report::report_html. Empty: no report is written. `input` is the input that the run
    /// has loaded, null if it has none.
    std::function<std::string(const std::filesystem::path& folder,
                              const plugin::Catalogue& catalogue, Workers* workers,
                              const LoadedInput* input)>
        make_report{};
};

/// Figures of the result as the folder contains it.
struct RunOutcome {
    std::filesystem::path folder;
    std::vector<std::filesystem::path> surfaces;  ///< in result/
    std::vector<std::filesystem::path> volumes;
    std::filesystem::path picture;  ///< empty if no picture was requested
    std::filesystem::path report;   ///< empty if none was requested or written
    RunTotals totals;
    SurfaceMeasure surface;
    std::map<mesh::Label, SurfaceMeasure> label_surfaces;  ///< of surface_LABEL.*, if there are two
                                                           ///< labels above 0 or more
    VolumeMeasure volume;
    std::optional<Coverage> coverage;  ///< of the whole surface, in normalised units; empty without
                                       ///< a cloud
    std::optional<surface::TrimReport> trimmed;  ///< if the surface was written without the parts
                                                 ///< that no points support
    bool conforms = false;  ///< the surface is, bit for bit, the label interface of the volume, or
                            ///< the part that trimming keeps
};

/// Runs the experiment. On an error the folder says "failed" and contains no result, and the error
/// is rethrown. A result that is not valid as written (inverted tets, self-intersections, a surface
/// that is not the volume's interface) is a GeometryError "run.invalid_result". Throws UsageError
/// "run.busy" for a folder in which another run is active, and "run.resume" for a folder that
/// contains something other than the run to resume; neither changes the folder. [setup]
RunOutcome run_experiment(const LoadedExperiment& loaded, const plugin::Catalogue& catalogue,
                          const RunOptions& options);

/// To be called when the process ends during its runs: their folders then say "failed", and why.
/// `unchanged`: the thread of the run is inside a call of a strategy, so that the complex is valid
/// and does not change. The state after the last complete step is then kept in last_good/. [setup]
void abandon_runs(const Error& error, bool unchanged);

/// Whether the folder contains the finished run of this experiment, so that there is nothing to
/// resume. [setup]
bool is_finished(const std::filesystem::path& folder, const LoadedExperiment& loaded,
                 const plugin::Catalogue& catalogue);

/// The folder of a run without `-o`. [setup]
std::filesystem::path default_folder(const LoadedExperiment& loaded,
                                     const config::StrategyLookup& lookup);

/// The mesh in the input's coordinates. [setup]
mesh::TetMesh to_input(const mesh::TetMesh& mesh, const cloud::Transform& to_normalised);

}  // namespace dsc::run
