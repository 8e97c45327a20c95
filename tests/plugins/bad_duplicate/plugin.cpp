// Its second id is the one of the plugin `good`.
#include "velocity.hpp"

DSC_PLUGIN("bad_duplicate", "1.0.0", "MIT", "Takes an id that another plugin has") {
    registrar.add<Still>("bad_duplicate_first", "must not stay behind");
    registrar.add<Still>("upwards", "not the one of plugin good");
}
