// The saved state of an object as bytes.
#include "dsc/base/state.hpp"

#include <dsc/base/error.hpp>

namespace dsc {

void StateReader::damaged() {
    throw IoError(
        "state.damaged",
        "a saved state ends too early; it was written by another version, or is not what it seems");
}

}  // namespace dsc
