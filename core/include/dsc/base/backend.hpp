#pragma once
// Libraries of this project that are loaded when they are first needed, because the third-party
// library behind them takes long to load.

#include <string>

/// Before the definition of dsc_backend_NAME().
#define DSC_BACKEND_EXPORT __attribute__((visibility("default")))

namespace dsc {

/// The table of functions of the backend `name`: what dsc_backend_NAME() of libdsc_NAME.so returns.
/// The library lies beside the library of the core and stays loaded. Throws Error "backend.load" if
/// it cannot be loaded. [setup]
const void* load_backend(const std::string& name);

}  // namespace dsc
