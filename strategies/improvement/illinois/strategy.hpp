#pragma once
// Improvement `illinois`: the repairs of the Illinois DSC, in a form that terminates.

#include <dsc/hooks/improvement.hpp>
#include <dsc/plugin/plugin.hpp>

#include "repairs.hpp"

namespace dsc::strategies {

/// Examines only tets that are flat or stop a vertex, and repairs each by its class [Saul2015, ch. 3]; then falls back on
/// flips, smoothing and collapses. No topology changes.
class IllinoisImprovement final : public hooks::Improvement {
public:
    struct Params {
        double wedge = improvement::ShapeLimits{}.wedge;
        double tee = improvement::ShapeLimits{}.tee;
        double flat = improvement::RepairLimits{}.flat;
        double flip_below = improvement::RepairLimits{}.flip_below;
        double smooth_below = improvement::RepairLimits{}.smooth_below;
        double degenerate_tet_quality = improvement::RepairLimits{}.degenerate;
        double least_edge = improvement::RepairLimits{}.least_edge;
        double insertions = improvement::RepairLimits{}.insertions;
        double longest_spoke = improvement::RepairLimits{}.longest_spoke;
        double flatness = 0.995;
        bool fallbacks = true;
    };
    static void declare(config::ParamSchema<Params>& schema);

    IllinoisImprovement(const Params& params, const plugin::Setup& setup);

    void propose(const hooks::StepContext& context, const repair::RepairRound& round, std::vector<repair::Request>& out) override;
    double flatness() const override { return flatness_; }
    repair::TopologyLimits topology_limits() const override;
    std::vector<std::string> repair_classes() const override { return improvement::repair_class_names(); }

private:
    double flatness_;
    improvement::Repairs repairs_;
};

}  // namespace dsc::strategies
