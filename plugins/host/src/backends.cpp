// Opens the backends of the core. Every program that links the host contains this file.
#include <filesystem>
#include <string>

#include <dlfcn.h>

#include <dsc/base/backend.hpp>
#include <dsc/base/error.hpp>

#include "library.hpp"

namespace dsc::host {
namespace {

[[noreturn]] void refuse_backend(const std::filesystem::path& library) {
    throw Error(ExitCode::internal, "backend.load", library.string(),
                "it cannot be loaded: " + dl_reason(),
                "install dsc and the libraries that it needs again");
}

const void* open_backend(const std::string& name) {
    const std::filesystem::path library = library_folder() / ("libdsc_" + name + ".so");
    void* const opened = dlopen(library.c_str(), RTLD_NOW | RTLD_LOCAL | RTLD_NODELETE);
    if (opened == nullptr) refuse_backend(library);
    using Table = const void* (*)();
    const auto table = reinterpret_cast<Table>(dlsym(opened, ("dsc_backend_" + name).c_str()));
    if (table == nullptr) refuse_backend(library);
    return table();
}

[[maybe_unused]] const bool offered = [] {
    set_backend_opener(open_backend);
    return true;
}();

}  // namespace
}  // namespace dsc::host

// CMake makes every program that links the host ask for this symbol, so that the linker takes this
// file from the archive.
extern "C" void dsc_host_offers_backends() {}
