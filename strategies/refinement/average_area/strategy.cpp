// Refinement `average_area`: splits the large faces of the interface.
//
// Requests a split of every interface face whose area is at least `factor` times the average area
// [Saul2015, ch. 4].
#include <dsc/base/version.hpp>
#include <dsc/hooks/refinement_policy.hpp>
#include <dsc/plugin/plugin.hpp>

namespace {

class AverageArea final : public dsc::hooks::RefinementPolicy {
public:
    /// The parameters that an experiment may set; the values here are the defaults.
    struct Params {
        double factor = 1.0;
    };
    static void declare(dsc::config::ParamSchema<Params>& schema) {
        schema.real("factor", &Params::factor)
            .greater(0, "dimensionless")
            .doc("Area from which faces are split, in average areas.");
    }

    AverageArea(const Params& params, const dsc::plugin::Setup&) : factor_(params.factor) {}

    void refine(const dsc::hooks::RefinementContext& context,
                dsc::hooks::RefinementRequests& out) override {
        const std::vector<double>& areas = context.step.surface.face_areas;
        if (areas.empty()) return;
        double sum = 0;
        for (const double area : areas) sum += area;
        // Equal areas equal their average, in spite of rounding in the sum.
        constexpr double rounding = 1e-12;
        const double bound = factor_ * (sum / static_cast<double>(areas.size())) * (1 - rounding);
        for (std::uint32_t face = 0; face < areas.size(); ++face) {
            if (areas[face] >= bound) out.split_faces.push_back(face);
        }
    }

private:
    double factor_;
};

}  // namespace

DSC_PLUGIN("average_area", DSC_VERSION, "BSD-3-Clause", "Splitting of large interface faces") {
    registrar.add<AverageArea>("average_area",
                               "splits interface faces of at least the average area");
}
