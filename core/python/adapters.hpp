#pragma once
// Adapters: a strategy written in Python behind each hook.

#include <memory>

#include <dsc/hooks/context.hpp>
#include <dsc/plugin/kind.hpp>

#include "instance.hpp"

namespace dsc::python {

std::unique_ptr<hooks::Strategy> adapt_velocity(Instance instance);
std::unique_ptr<hooks::Strategy> adapt_curvature(Instance instance);
std::unique_ptr<hooks::Strategy> adapt_refinement(Instance instance);
std::unique_ptr<hooks::Strategy> adapt_initial_mesh(Instance instance);
std::unique_ptr<hooks::Strategy> adapt_observer(Instance instance);

}  // namespace dsc::python
