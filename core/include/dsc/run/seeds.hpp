#pragma once
// Whether the seed of an experiment has an influence on its result.

#include <dsc/plugin/catalogue.hpp>
#include <dsc/run/experiment.hpp>

namespace dsc::run {

/// True if the input is sampled or varied, or if one of the strategies, also a nested one, is
/// declared stochastic (hooks::Traits). False: runs that differ only in their seeds have the same
/// result. [setup]
bool depends_on_seed(const LoadedExperiment& loaded, const plugin::Catalogue& catalogue);

}  // namespace dsc::run
