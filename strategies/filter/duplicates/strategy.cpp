// Filter `duplicates`: removes points that repeat an earlier one.
//
// A point is removed if its distance to an earlier point that stays is at most `tolerance`. With
// `sort`, the points are first ordered by their coordinates and attributes, so that the result does
// not depend on their order. The algorithm is dsc::cloud::remove_duplicates.
#include <dsc/base/version.hpp>
#include <dsc/cloud/filter.hpp>
#include <dsc/hooks/cloud_filter.hpp>
#include <dsc/plugin/plugin.hpp>

namespace {

class Duplicates final : public dsc::hooks::CloudFilter {
public:
    /// The parameters that an experiment may set.
    using Params = dsc::cloud::DuplicatesOptions;
    static void declare(dsc::config::ParamSchema<Params>& schema) {
        schema.real("tolerance", &Params::tolerance)
            .range(0, 1, "diagonals")
            .doc("Distance to an earlier point up to which a point is removed; 0 removes only "
                 "exact repetitions.");
        schema.boolean("sort", &Params::sort)
            .doc("Sort the points by x, y and z before any is removed. A shuffled file then gives "
                 "the same cloud, bit for bit, with all its attributes. Of equal points the one "
                 "with the smallest colour, normal, area and confidence stays. Without sorting, "
                 "the order of the file is kept, and the first of equal points stays.");
    }

    Duplicates(const Params& params, const dsc::plugin::Setup&) : params_(params) {}

    dsc::cloud::Filtered apply(const dsc::cloud::Cloud& cloud,
                               const dsc::hooks::FilterContext&) override {
        return dsc::cloud::remove_duplicates(cloud, params_);
    }

private:
    Params params_;
};

}  // namespace

DSC_PLUGIN("duplicates", DSC_VERSION, "BSD-3-Clause", "Filter of repeated points") {
    registrar.add<Duplicates>("duplicates", "removes points that repeat an earlier one");
}
