#include "strategy.hpp"

namespace dsc::strategies {

void Duplicates::declare(config::ParamSchema<Params>& schema) {
    schema.real("tolerance", &Params::tolerance)
        .range(0, 1)
        .unit("diagonals")
        .doc("Distance to an earlier point up to which a point is removed; 0 removes only exact repetitions.");
    schema.boolean("sort", &Params::sort)
        .doc(
            "Sort the points by x, y and z before any is removed. A shuffled file then gives the same cloud, bit for bit, "
            "with all its attributes. Of equal points the one with the smallest colour, normal, area and confidence stays. "
            "Without sorting, the order of the file is kept, and the first of equal points stays.");
}

Duplicates::Duplicates(const Params& params, const plugin::Setup&) : params_(params) {}

cloud::Filtered Duplicates::apply(const cloud::Cloud& cloud, const hooks::FilterContext&) {
    return cloud::remove_duplicates(cloud, params_);
}

}  // namespace dsc::strategies
