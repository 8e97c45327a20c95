// Passes the kernel's questions of one step to the improvement.
#include "dsc/run/repair_policy.hpp"

namespace dsc::run {

kernel::RepairPolicy repair_policy(hooks::Improvement& improvement,
                                   const hooks::StepContext& context) {
    kernel::RepairPolicy policy;
    policy.propose = [&](const repair::RepairRound& round, std::vector<repair::Request>& out) {
        improvement.propose(context, round, out);
    };
    policy.select = [&](std::span<const repair::TopologyCandidate> candidates,
                        std::span<std::uint8_t> accept) {
        improvement.select(context, candidates, accept);
    };
    policy.topology = improvement.topology_limits();
    policy.flatness = improvement.flatness();
    return policy;
}

}  // namespace dsc::run
