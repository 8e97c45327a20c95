// Loads a backend from the folder of the library that contains this function.
#include "dsc/base/backend.hpp"

#include <filesystem>

#include <dlfcn.h>

#include <dsc/base/error.hpp>

namespace dsc {
namespace {

[[noreturn]] void refuse(const std::filesystem::path& library) {
    const char* reason = dlerror();
    throw Error(ExitCode::internal, "backend.load", library.string(),
                std::string("it cannot be loaded: ") + (reason == nullptr ? "no reason" : reason),
                "install dsc and the libraries that it needs again");
}

std::filesystem::path own_folder() {
    Dl_info info{};
    const auto* here = reinterpret_cast<const void*>(&load_backend);
    if (dladdr(here, &info) == 0 || info.dli_fname == nullptr) return {};
    return std::filesystem::path(info.dli_fname).parent_path();
}

}  // namespace

const void* load_backend(const std::string& name) {
    const std::filesystem::path library = own_folder() / ("libdsc_" + name + ".so");
    void* const opened = dlopen(library.c_str(), RTLD_NOW | RTLD_LOCAL | RTLD_NODELETE);
    if (opened == nullptr) refuse(library);
    using Table = const void* (*)();
    const auto table = reinterpret_cast<Table>(dlsym(opened, ("dsc_backend_" + name).c_str()));
    if (table == nullptr) refuse(library);
    return table();
}

}  // namespace dsc
