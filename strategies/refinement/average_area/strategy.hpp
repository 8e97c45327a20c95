#pragma once
// Refinement `average_area`: splits the large faces of the interface.

#include <dsc/hooks/refinement_policy.hpp>
#include <dsc/plugin/plugin.hpp>

namespace dsc::strategies {

/// Requests a split of every interface face whose area is at least the average [Saul2015, ch. 4].
class AverageArea final : public hooks::RefinementPolicy {
public:
    struct Params {
        double factor = 1.0;
    };
    static void declare(config::ParamSchema<Params>& schema);

    AverageArea(const Params& params, const plugin::Setup& setup);

    void refine(const hooks::RefinementContext& context, hooks::RefinementRequests& out) override;

private:
    double factor_;
};

}  // namespace dsc::strategies
