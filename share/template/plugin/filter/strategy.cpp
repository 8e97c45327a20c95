// Filter `@NAME@`: removes the floor under a scanned object, and points above the object.
//
//     removed: z <= floor * height, or z > ceiling * height
//
// where z is measured from the bottom of the cloud's bounding box, and height is that of the box.
#include <vector>

#include <dsc/cloud/filter.hpp>
#include <dsc/hooks/cloud_filter.hpp>
#include <dsc/plugin/plugin.hpp>

namespace {

using dsc::cloud::Cloud;
using dsc::cloud::Filtered;

class @CLASS@ final : public dsc::hooks::CloudFilter {
public:
    /// The parameters that an experiment may set; the values here are the defaults.
    struct Params {
        double floor = 0.02;
        double ceiling = 1.0;
    };
    static void declare(dsc::config::ParamSchema<Params>& schema) {
        schema.real("floor", &Params::floor)
            .range(0, 1, "dimensionless")
            .doc("Fraction of the height of the cloud's bounding box up to which points are "
                 "removed.");
        schema.real("ceiling", &Params::ceiling)
            .range(0, 1, "dimensionless")
            .doc("Fraction of the height of the cloud's bounding box above which points are "
                 "removed.");
        schema.check([](const Params& p) { return p.floor < p.ceiling; },
                     "'floor' must lie below 'ceiling'");
    }

    @CLASS@(const Params& params, const dsc::plugin::Setup&) : params_(params) {}

    // Called once per run, before the cloud is normalised: lengths are in the units of the file.
    Filtered apply(const Cloud& cloud, const dsc::hooks::FilterContext&) override {
        const dsc::Box3 box = dsc::bounding_box(cloud.points);
        const double height = box.size().z();
        std::vector<std::size_t> kept;
        std::size_t at_floor = 0;
        std::size_t above_ceiling = 0;
        for (std::size_t i = 0; i < cloud.points.size(); ++i) {
            const double z = cloud.points[i].z() - box.low.z();
            if (z <= params_.floor * height) {
                ++at_floor;
            } else if (z > params_.ceiling * height) {
                ++above_ceiling;
            } else {
                kept.push_back(i);
            }
        }
        if (kept.empty())
            throw dsc::GeometryError("@NAME@.nothing_left", cloud.source,
                                     "filter @NAME@ removes all points", "widen the range");
        // pick() keeps the colours of the points and all attributes from earlier filters.
        Filtered result{dsc::cloud::pick(cloud, kept), {}};
        result.report.kept = kept.size();
        result.report.removed = cloud.points.size() - kept.size();
        result.report.reasons = {{"at the floor", at_floor}, {"above the ceiling", above_ceiling}};
        result.report.figures = {{"height", height}};
        return result;
    }

private:
    Params params_;
};

}  // namespace

DSC_PLUGIN("@NAME@", "0.1.0", "BSD-3-Clause", "Filter @NAME@") {
    registrar.add<@CLASS@>("@NAME@",
                           "removes the floor under a scanned object and points above the object");
}
