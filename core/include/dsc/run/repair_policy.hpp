#pragma once
// Connects the kernel to a strategy that improves the mesh.

#include <dsc/hooks/improvement.hpp>
#include <dsc/kernel/deformer.hpp>

namespace dsc::run {

/// The policy with which a step asks the improvement: for repairs, and which changes of topology to
/// accept. Both references must outlive the policy. [step]
kernel::RepairPolicy repair_policy(hooks::Improvement& improvement,
                                   const hooks::StepContext& context);

}  // namespace dsc::run
