// Filter `outliers`: removes points far from all others.
//
// Let r be the distance of a point to its 8th neighbour. A point is isolated if r exceeds
// `isolated` times the median of r over its neighbours and over all points. It is far if r exceeds
// `far` times the median over all points. In a dirty cloud the search is repeated in rounds, with
// further conditions (README.md). The algorithm is dsc::cloud::remove_outliers.
#include <dsc/base/version.hpp>
#include <dsc/cloud/filter.hpp>
#include <dsc/hooks/cloud_filter.hpp>
#include <dsc/plugin/plugin.hpp>

namespace {

class Outliers final : public dsc::hooks::CloudFilter {
public:
    /// The parameters that an experiment may set.
    using Params = dsc::cloud::OutliersOptions;
    static void declare(dsc::config::ParamSchema<Params>& schema) {
        schema.real("isolated", &Params::isolated)
            .range(1.01, 1000, "dimensionless")
            .doc("Factor above which a point is isolated: its distance to its 8th neighbour over "
                 "that of its neighbours, and over that of most points.");
        schema.real("far", &Params::far)
            .range(1.01, 1e6, "dimensionless")
            .doc("Largest allowed factor between the distance of a point to its 8th neighbour and "
                 "that of most points.");
        schema.real("most", &Params::most)
            .range(0, 0.99, "dimensionless")
            .doc("Fraction of the points; if more than this would be removed, none is removed.");
        schema.real("dirty", &Params::dirty)
            .range(0, 1, "dimensionless")
            .doc("Fraction of isolated points above which all points are searched in rounds for "
                 "outliers among outliers.");
    }

    Outliers(const Params& params, const dsc::plugin::Setup&) : params_(params) {}

    dsc::cloud::Filtered apply(const dsc::cloud::Cloud& cloud,
                               const dsc::hooks::FilterContext& context) override {
        return dsc::cloud::remove_outliers(cloud, params_, context.workers);
    }

private:
    Params params_;
};

}  // namespace

DSC_PLUGIN("outliers", DSC_VERSION, "BSD-3-Clause", "Filter of points far from all others") {
    registrar.add<Outliers>("outliers",
                            "removes points far from all others, and no points of a clean cloud");
}
