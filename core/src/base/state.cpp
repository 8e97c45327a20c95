// The saved state of an object as bytes.
#include "dsc/base/state.hpp"

#include <dsc/base/error.hpp>

namespace dsc {

void StateReader::damaged() {
    throw IoError("state.damaged", "saved state", "",
                  "it ends too early, so it is damaged or another version wrote it",
                  "start the run again");
}

}  // namespace dsc
