#pragma once
// Improvement `dsc`: the quality-driven repairs of the deformable simplicial complex, with the topology policy.

#include <dsc/hooks/improvement.hpp>
#include <dsc/plugin/plugin.hpp>

#include "proposals.hpp"

namespace dsc::strategies {

/// Smooths, flips, collapses and splits by quality and size [Misztal2012]; lets the topology change where a sheet, gap
/// or neck is thin and no cloud point supports it.
class DscImprovement final : public hooks::Improvement {
public:
    struct Topology {
        bool open = true;
        bool merge = true;
        bool cut = true;
        double thickness = 1.0;
        double support = 0.5;
        double spacing = 0.8;
        double min_component = 2.0;

        static void declare(config::ParamSchema<Topology>& schema);
    };
    struct Params : improvement::ShapeLimits {
        double flatness = 0.995;
        Topology topology;

        double min_tet_quality = improvement::Thresholds{}.min_tet_quality;
        double degenerate_tet_quality = improvement::Thresholds{}.degenerate_tet_quality;
        double smooth_below = improvement::Thresholds{}.smooth_below;
        double min_edge_length = improvement::Thresholds{}.min_edge_length;
        double max_edge_length = improvement::Thresholds{}.max_edge_length;
        double min_tet_volume = improvement::Thresholds{}.min_tet_volume;
        double max_free_edge = improvement::Thresholds{}.max_free_edge;
    };
    static void declare(config::ParamSchema<Params>& schema);

    DscImprovement(const Params& params, const plugin::Setup& setup);

    void propose(const hooks::StepContext& context, const repair::RepairRound& round, std::vector<repair::Request>& out) override;
    double flatness() const override { return params_.flatness; }
    repair::TopologyLimits topology_limits() const override;
    void select(const hooks::StepContext& context, std::span<const repair::TopologyCandidate> candidates,
                std::span<std::uint8_t> accept) override;

private:
    Params params_;
    improvement::Proposals proposals_;
};

}  // namespace dsc::strategies
