// One id, two strategies.
#include "velocity.hpp"

DSC_PLUGIN("bad_twice", "1.0.0", "MIT", "Registers an id twice") {
    registrar.add<Still>("still", "does not move");
    registrar.add<Still>("still", "does not move either");
}
