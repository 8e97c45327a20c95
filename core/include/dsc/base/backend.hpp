#pragma once
// Libraries of this project that are loaded when they are first needed, because the third-party
// library behind them takes long to load. Only the host of plugins opens libraries, so it offers
// them; a program that links it has them.

#include <string>

/// Before the definition of dsc_backend_NAME().
#define DSC_BACKEND_EXPORT __attribute__((visibility("default")))

namespace dsc {

/// Opens the backend `name` and returns its table of functions: what dsc_backend_NAME() of
/// libdsc_NAME.so returns. Throws Error "backend.load".
using BackendOpener = const void* (*)(const std::string& name);

/// Sets the function that opens backends. [setup]
void set_backend_opener(BackendOpener opener);

/// The table of functions of the backend `name`. Throws Error "backend.load" if it cannot be loaded
/// or if the program links no host. [setup]
const void* load_backend(const std::string& name);

}  // namespace dsc
