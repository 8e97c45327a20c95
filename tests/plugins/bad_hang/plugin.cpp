// Never ends to register.
#include <unistd.h>

#include "velocity.hpp"

DSC_PLUGIN("bad_hang", "1.0.0", "MIT", "waits for ever when it is loaded") {
    for (;;) pause();
    registrar.add<Still>("still", "does not move");
}
