#pragma once
// Intermediate states of a run, in series/: for ParaView at regular steps, for the report a few.

#include <filesystem>
#include <memory>
#include <set>
#include <vector>

#include <dsc/hooks/curvature_estimator.hpp>
#include <dsc/io/series.hpp>
#include <dsc/mesh/complex.hpp>
#include <dsc/plugin/catalogue.hpp>
#include <dsc/run/experiment.hpp>
#include <dsc/run/kept_states.hpp>

namespace dsc::run {

/// Writes the states in the input's coordinates, and updates the index after each, so that a run
/// can be watched. Does not change the complex.
class StateSeries {
public:
    /// Continues with the states that `run_folder` already contains, for a resumed run.
    StateSeries(const Experiment& experiment, const plugin::Catalogue& catalogue,
                const std::filesystem::path& run_folder);

    /// Whether any state is kept.
    bool active() const { return every_ != 0 || !steps_.empty(); }
    /// Keeps the state if its step is selected. The context belongs to the state; its step is the
    /// last one. Throws IoError, GeometryError as io::write_volume, StrategyError of the curvature.
    /// [step]
    void add(const hooks::StepContext& context, const mesh::Complex& complex);

private:
    bool due(std::uint64_t step) const;
    void write_surface(const hooks::StepContext& context, const mesh::Complex& complex);
    void write_volume(const hooks::StepContext& context, const mesh::Complex& complex);
    std::vector<double> curvatures(const hooks::StepContext& context);

    std::filesystem::path folder_;
    bool compressed_ = false;
    std::uint64_t every_ = 0;          // of output.series
    std::set<std::uint64_t> steps_{};  // for the report
    // a copy of the velocity's; null if it has none
    std::unique_ptr<hooks::CurvatureEstimator> curvature_;
    std::vector<io::SeriesEntry> surfaces_;
    std::vector<io::SeriesEntry> volumes_;
};

}  // namespace dsc::run
