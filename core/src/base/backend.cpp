// Asks the host of plugins for a backend.
#include "dsc/base/backend.hpp"

#include <atomic>

#include <dsc/base/error.hpp>

namespace dsc {
namespace {

std::atomic<BackendOpener> opener_of_backends = nullptr;

}  // namespace

void set_backend_opener(BackendOpener opener) { opener_of_backends = opener; }

const void* load_backend(const std::string& name) {
    const BackendOpener opener = opener_of_backends;
    if (opener == nullptr) {
        throw Error(ExitCode::internal, "backend.load", "libdsc_" + name + ".so",
                    "it cannot be loaded, because the program is not linked with the host of "
                    "plugins",
                    "link dsc::host too");
    }
    return opener(name);
}

}  // namespace dsc
