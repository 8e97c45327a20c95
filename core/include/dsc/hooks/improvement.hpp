#pragma once
// Hook `improvement`: which repairs a step tries, in which order, on which tets.

#include <span>
#include <string>
#include <vector>

#include <dsc/hooks/context.hpp>
#include <dsc/mesh/repair.hpp>

namespace dsc::hooks {

/// Proposes; the kernel re-evaluates each request at its turn and owns the invariants. [step]
class Improvement : public Strategy {
public:
    ~Improvement() override;

    /// Called once a repair round. Appends requests in the order in which they shall be tried.
    virtual void propose(const StepContext& context, const mesh::RepairRound& round, std::vector<mesh::Request>& out) = 0;

    /// Cosine between unit normals above which neighbouring interface faces count as flat.
    virtual double flatness() const { return 0.995; }

    virtual mesh::TopologyLimits topology_limits() const { return {}; }
    /// All candidates of a step as one batch; sets accept[i] to 1 for those that may happen. Sizes are equal.
    virtual void select(const StepContext& context, std::span<const mesh::TopologyCandidate> candidates,
                        std::span<std::uint8_t> accept);

    /// Names of the classes that Request::repair_class counts by: differing, snake_case, at most repair_class_limit. Where there
    /// are any, events.jsonl and summary.json tell how many requests of each were made and committed. [setup]
    virtual std::vector<std::string> repair_classes() const { return {}; }
};

}  // namespace dsc::hooks
