#pragma once
// Hook `improvement`: which repairs a step tries, in which order, on which tets (method.md, section
// 6).

#include <span>
#include <string>
#include <vector>

#include <dsc/hooks/context.hpp>
#include <dsc/repair/contract.hpp>

namespace dsc::hooks {

/// Requests repairs. The kernel evaluates each request at its turn and keeps the invariants. [step]
class Improvement : public Strategy {
public:
    ~Improvement() override;

    /// Called once per repair round. Appends requests in the order in which the kernel shall try
    /// them.
    virtual void propose(const StepContext& context, const repair::RepairRound& round,
                         std::vector<repair::Request>& out) = 0;

    /// Cosine between unit normals above which neighbouring interface faces count as flat.
    virtual double flatness() const { return repair::default_flatness; }

    virtual repair::TopologyLimits topology_limits() const { return {}; }
    /// Receives all candidates of a step as one batch. Sets accept[i] to 1 for those that may be
    /// committed. Sizes are equal.
    virtual void select(const StepContext& context,
                        std::span<const repair::TopologyCandidate> candidates,
                        std::span<std::uint8_t> accept);

    /// Names of the classes by which requests are counted (Request::repair_class): different names,
    /// snake_case, at most repair_class_limit. If there are any, events.jsonl and summary.json
    /// contain the numbers of requests made and committed per class. [setup]
    virtual std::vector<std::string> repair_classes() const { return {}; }
};

}  // namespace dsc::hooks
