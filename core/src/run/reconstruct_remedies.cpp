// Runs a reconstruction; its errors name remedies that its user can follow.
#include <algorithm>
#include <array>
#include <string_view>

#include <dsc/base/error.hpp>

#include "dsc/run/reconstruct.hpp"

namespace dsc::run {
namespace {

constexpr std::string_view check_cloud =
    "check with dsc info that the points cover the surface of one solid on all sides and densely "
    "enough, and remove points far away from it";
constexpr std::string_view check_file =
    "save the cloud again with finite coordinates, closer to the origin";

struct Remedy {
    std::string_view code;
    std::string_view text;
};
constexpr std::array<Remedy, 12> remedies = {{{"run.vanished", check_cloud},
                                              {"indicator.no_samples", check_cloud},
                                              {"lattice.size", check_cloud},
                                              {"stuff.box", check_cloud},
                                              {"stuff.values", check_cloud},
                                              {"mesh.pinched", check_cloud},
                                              {"cloud.filtered_out", check_cloud},
                                              {"cloud.option", check_cloud},
                                              {"cloud.normals", check_file},
                                              {"filter.normals", check_file},
                                              {"cloud.scale", check_file},
                                              {"cloud.outside_box", check_file}}};

/// Errors of a run may suggest another value in its experiment, for which a reconstruction has no
/// option. Throws such an error with the same cause and a remedy that its user can follow.
void throw_with_own_remedy(const Error& error) {
    const auto found = std::find_if(remedies.begin(), remedies.end(),
                                    [&](const Remedy& r) { return r.code == error.code(); });
    if (found == remedies.end()) return;
    // The cause of an error without parts ends with its remedy.
    const std::string& cause = error.cause();
    throw Error(error.exit_code(), error.code(), error.place(),
                error.remedy().empty() ? cause.substr(0, cause.find("; ")) : cause, found->text);
}

}  // namespace

RunOutcome reconstruct(const LoadedExperiment& loaded, const plugin::Catalogue& catalogue,
                       const RunOptions& options) {
    try {
        return run_experiment(loaded, catalogue, options);
    } catch (const Error& error) {
        throw_with_own_remedy(error);
        throw;
    }
}

}  // namespace dsc::run
