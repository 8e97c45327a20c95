// Fails after it registered something.
#include <stdexcept>

#include "velocity.hpp"

DSC_PLUGIN("bad_throws", "1.0.0", "MIT", "Throws while it registers") {
    registrar.add<Still>("half_registered", "must not stay behind");
    throw std::runtime_error("the licence server is away");
}
