#pragma once
// The states that a run keeps on its way, in series/: for ParaView every so many steps, for the report a handful.

#include <dsc/hooks/curvature_estimator.hpp>
#include <dsc/io/series.hpp>
#include <dsc/mesh/complex.hpp>
#include <dsc/plugin/catalogue.hpp>
#include <dsc/run/experiment.hpp>
#include <filesystem>
#include <memory>
#include <set>
#include <vector>

namespace dsc::run {

/// Surfaces that a report shows, the result included.
inline constexpr std::size_t report_frames = 12;

/// The steps of which a report without `output.series` keeps the surface, the result left out: close together at the start,
/// where most happens.
std::set<std::uint64_t> report_steps(std::uint64_t planned);

/// Writes the states in the input's coordinates, and after each the index anew, so that a run may be watched. Reads the
/// complex, writes nothing of it.
class StateSeries {
public:
    /// Takes up the states that `run_folder` holds already: those of a run that is resumed.
    StateSeries(const Experiment& experiment, const plugin::Catalogue& catalogue, const std::filesystem::path& run_folder);

    /// Whether anything is kept at all.
    bool active() const { return every_ != 0 || !steps_.empty(); }
    /// Keeps the state if it is due. The context belongs to the state: its step is the last one. Throws IoError,
    /// GeometryError as io::write_volume, StrategyError of the curvature. [step]
    void add(const hooks::StepContext& context, const mesh::Complex& complex);

private:
    bool due(std::uint64_t step) const;
    void write_surface(const hooks::StepContext& context, const mesh::Complex& complex);
    void write_volume(const hooks::StepContext& context, const mesh::Complex& complex);
    std::vector<double> curvatures(const hooks::StepContext& context);

    std::filesystem::path folder_;
    std::uint64_t every_ = 0;          // of output.series
    std::set<std::uint64_t> steps_{};  // for the report
    std::unique_ptr<hooks::CurvatureEstimator> curvature_;  // a second one of the velocity's, null where that has none
    std::vector<io::SeriesEntry> surfaces_;
    std::vector<io::SeriesEntry> volumes_;
};

/// The states of `kind` ("surface", "volume") in a run folder, by step.
std::vector<io::SeriesEntry> kept_states(const std::filesystem::path& run_folder, const std::string& kind);

}  // namespace dsc::run
