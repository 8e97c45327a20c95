// Improvement `illinois`: the repairs of the Illinois DSC, in a form that terminates.
//
// Examines only tets that are flat or stop a vertex, and repairs each by its class [Saul2015, ch.
// 3]; then falls back on flips, smoothing and collapses. The topology never changes. tet_shape.cpp
// determines the class of a tet, repairs.cpp chooses the repairs of a round.
#include <dsc/base/version.hpp>
#include <dsc/hooks/improvement.hpp>
#include <dsc/plugin/plugin.hpp>

#include "repairs.hpp"

namespace {

class IllinoisImprovement final : public dsc::hooks::Improvement {
public:
    /// The parameters that an experiment may set; the values here are the defaults.
    struct Params : dsc::improvement::RepairLimits {
        double flatness = dsc::repair::default_flatness;
    };
    static void declare(dsc::config::ParamSchema<Params>& schema) {
        schema.real("flat", &Params::flat)
            .range(0, 1, "dimensionless")
            .doc(
                "Altitude below which a tet is flat: the distance of a vertex from the plane of "
                "the others, in the smaller of the longest edge of the tet and the target length.");
        schema.real("wedge", &Params::wedge)
            .range(0, 1, "dimensionless")
            .doc("Edge length below which a flat tet is a wedge, in the same unit.");
        schema.real("tee", &Params::tee)
            .range(0, 1, "dimensionless")
            .doc("Distance of a vertex from an edge below which a flat tet is a tee, in the same "
                 "unit.");
        schema.real("flip_below", &Params::flip_below)
            .range(0, 1, "dimensionless")
            .doc("Fall-back: altitude below which flips and smoothing are tried, in the unit of "
                 "'flat'.");
        schema.real("smooth_below", &Params::smooth_below)
            .range(0, 1, "dimensionless")
            .doc("Fall-back: altitude of tets below which their free vertices move to the mean of "
                 "their neighbours, in the unit of 'flat'.");
        schema.real("degenerate_tet_quality", &Params::degenerate_tet_quality)
            .range(0, 1, "dimensionless")
            .doc("Volume-length quality below which a collapse may leave no tet, unless the lowest "
                 "quality was already lower.");
        schema.real("least_edge", &Params::least_edge)
            .range(0, 1, "target lengths (L)")
            .doc("Length below which no insertion makes an edge; edges shorter than twice this "
                 "length are not split.");
        schema.real("insertions", &Params::insertions)
            .range(0, 10, "dimensionless")
            .doc("Number of vertices that may be inserted per step, as a fraction of the interface "
                 "vertices.");
        schema.real("longest_spoke", &Params::longest_spoke)
            .range(0, 1000, "target lengths (L)")
            .doc("Length above which edges from the interface into a phase are split, as the "
                 "thesis tried with edges to the corners of the box; 0: none is split.");
        schema.real("flatness", &Params::flatness)
            .range(0, 1, "dimensionless")
            .advanced()
            .doc("Cosine between the normals of neighbouring interface faces above which they "
                 "count as flat.");
        schema.boolean("fallbacks", &Params::fallbacks)
            .doc("Whether flips, smoothing and collapse are tried on a tet that the repair of its "
                 "class did not remove; without them the motion gets stuck, as in the thesis.");
    }

    IllinoisImprovement(const Params& params, const dsc::plugin::Setup&)
        : flatness_(params.flatness), repairs_(params) {}

    void propose(const dsc::hooks::StepContext&, const dsc::repair::RepairRound& round,
                 std::vector<dsc::repair::Request>& out) override {
        repairs_.write(round, out);
    }

    double flatness() const override { return flatness_; }

    dsc::repair::TopologyLimits topology_limits() const override {
        dsc::repair::TopologyLimits limits;
        limits.thickness = 0.0;
        limits.min_component = 0.0;
        return limits;
    }

    std::vector<std::string> repair_classes() const override {
        return dsc::improvement::repair_class_names();
    }

private:
    double flatness_;
    dsc::improvement::Repairs repairs_;
};

}  // namespace

DSC_PLUGIN("illinois", DSC_VERSION, "BSD-3-Clause",
           "Repairs of flat tets by their class: wedge, tee, cap, sliver") {
    registrar.add<IllinoisImprovement>("illinois",
                                       "repairs flat tets by their class, and no others");
}
