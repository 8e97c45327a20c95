#pragma once
// Remedies for the errors of `dsc reconstruct`.

#include <dsc/base/error.hpp>

namespace dsc::app {

/// Errors of a run may suggest another value in its experiment, for which `dsc reconstruct` has no
/// option. Returns the error with the same cause and a remedy that its user can follow; any other
/// error as it is. [setup]
Error with_own_remedy(const Error& error);

}  // namespace dsc::app
