#pragma once
// The main task: the experiment that turns a cloud into a surface and a volume, with few options.

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <dsc/cloud/statistics.hpp>
#include <dsc/config/node.hpp>
#include <dsc/run/run_experiment.hpp>

namespace dsc::run {

using cloud::Detail;
/// Empty for any other word. [parallel]
std::optional<Detail> detail_from_name(std::string_view name);
/// "low", "medium", "high". [parallel]
std::string_view detail_name(Detail detail);

struct ReconstructOptions {
    Detail detail = Detail::medium;
    std::vector<std::string> columns{};       ///< of a text cloud (cloud::ReadOptions)
    std::optional<double> edge_length{};      ///< in the units of the input; replaces `detail`
    std::optional<std::uint64_t> vertices{};  ///< wanted number of vertices of the surface;
                                              ///< replaces `detail`
    std::optional<double> noise{};  ///< standard deviation of the points across the surface, in
                                    ///< spacings; empty: it is measured
    bool trim = false;              ///< write the surface without the parts that no points support
};

/// The experiment in configs/reconstruct (low.yaml, medium.yaml or high.yaml) with the cloud
/// `file`, an absolute name. [setup]
config::ConfigNode reconstruction_of(const std::string& file,
                                     const ReconstructOptions& options = {});

/// The files of a reconstruction's result.
struct ReconstructOutput {
    std::vector<std::string> surface = {"obj"};  ///< formats, each once
    std::vector<std::string> volume = {"dsc"};
    bool report = false;
};

/// The experiment with this output; vertices of surfaces get normals. [setup]
config::ConfigNode with_output(const config::ConfigNode& reconstruction,
                               const ReconstructOutput& output);

/// run_experiment() for such an experiment: the remedies of its errors name no key of an
/// experiment, because the user has none. [setup]
RunOutcome reconstruct(const LoadedExperiment& loaded, const plugin::Catalogue& catalogue,
                       const RunOptions& options);

}  // namespace dsc::run
