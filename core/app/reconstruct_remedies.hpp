#pragma once
// What helps against an error of `dsc reconstruct`, in its own words.

#include <dsc/base/error.hpp>

namespace dsc::app {

/// Errors of a run may advise another value of its experiment, which `dsc reconstruct` has no option for. Returns the error with
/// the same cause and a remedy that its user can follow; any other error as it is. [setup]
Error with_own_remedy(const Error& error);

}  // namespace dsc::app
