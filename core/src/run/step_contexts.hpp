#pragma once
// The contexts that a run gives to its strategies. Each strategy gets the data that it needs. A
// strategy whose answer can be discarded also gets the token that says whether the run shall stop.

#include <cstdint>

#include <dsc/run/simulation.hpp>

#include "step_data.hpp"

namespace dsc::run {

/// This object refers to parts of a run. These parts must exist longer than the object. `planned`
/// is the number of steps in the schedule.
class StepContexts {
public:
    StepContexts(StepData& data, const Strategies& strategies, const cloud::TargetCloud* cloud,
                 std::uint64_t planned, const CancelToken& token)
        : data_(data), strategies_(strategies), cloud_(cloud), planned_(planned), token_(token) {}

    /// `step`: the number in metrics.csv and events.jsonl; the first one is 1. [step]
    hooks::StepContext make(std::uint64_t step, const Needs& needs = {}) {
        return data_.context(step, last_step(), needs);
    }

    hooks::StepContext for_velocity(std::uint64_t step) {
        return cancellable(make(step, needs_of(*strategies_.velocity)));
    }

    hooks::StepContext for_observer(const hooks::Observer& observer, std::uint64_t step) {
        Needs needs = needs_of(observer);
        needs.volume = true;
        return make(step, needs);
    }

    /// For a pass. If the refinement samples the velocity, it contains what the velocity needs too.
    hooks::StepContext for_refinement(const hooks::RefinementPolicy& refinement, bool sampling,
                                      std::uint64_t step) {
        Needs needs = needs_of(refinement);
        if (sampling) {
            const Needs of_velocity = needs_of(*strategies_.velocity);
            needs.faces_of_points = needs.faces_of_points || of_velocity.faces_of_points;
            needs.support = needs.support || of_velocity.support;
        }
        needs.volume = true;
        return cancellable(make(step, needs));
    }

private:
    /// The last step of the run as far as it is known; 0: unknown.
    std::uint64_t last_step() const {
        const std::uint64_t told = strategies_.velocity->planned_steps();
        return told > 0 ? told : planned_;
    }

    /// What the strategy needs of the cloud; without a cloud it is not asked.
    template <class Hook>
    Needs needs_of(const Hook& strategy) const {
        if (cloud_ == nullptr) return {};
        return {strategy.needs_faces_of_points(), strategy.needs_support()};
    }

    hooks::StepContext cancellable(hooks::StepContext context) const {
        context.cancel = &token_;
        return context;
    }

    StepData& data_;
    const Strategies& strategies_;
    const cloud::TargetCloud* cloud_;
    std::uint64_t planned_;
    const CancelToken& token_;
};

}  // namespace dsc::run
