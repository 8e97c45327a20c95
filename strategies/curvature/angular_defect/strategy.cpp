// Curvature `angular_defect`: a full turn minus the sum of the angles around a vertex, in radians.
//
//     K = 2 pi - sum of the angles of the faces at the vertex
//
// With `per_area`, K is divided by the mixed area of the vertex, which gives the Gaussian curvature
// [Meyer2003]. It is positive on bumps and in pits alike, and negative on saddles. The vector
// points along the normal.
#include <numbers>

#include <dsc/base/version.hpp>
#include <dsc/geometry/corner.hpp>
#include <dsc/hooks/curvature_estimator.hpp>
#include <dsc/plugin/plugin.hpp>

namespace {

using dsc::Vec3;

class AngularDefect final : public dsc::hooks::CurvatureEstimator {
public:
    /// The parameters that an experiment may set; the values here are the defaults.
    struct Params {
        bool per_area = false;
    };
    static void declare(dsc::config::ParamSchema<Params>& schema) {
        schema.boolean("per_area", &Params::per_area)
            .doc("Divide the angle by the area that belongs to the vertex; the result is the "
                 "Gaussian curvature.");
    }

    AngularDefect(const Params& params, const dsc::plugin::Setup&) : per_area_(params.per_area) {}

    void prepare(const dsc::hooks::StepContext& context) override { surface_ = &context.surface; }

    void evaluate(dsc::hooks::Range range, std::span<double> scalar,
                  std::span<Vec3> vector) const override {
        for (std::size_t i = 0; i < range.size(); ++i) {
            scalar[i] = at(range.begin + i);
            vector[i] = scalar[i] * surface_->normals[range.begin + i];
        }
    }

private:
    double at(std::size_t vertex) const {
        double angles = 0;
        double area = 0;
        for (const std::uint32_t face : surface_->faces_of(vertex)) {
            const auto [a, b, c] = surface_->corners_from(vertex, face);
            angles += dsc::geometry::corner_angle(a, b, c);
            area += dsc::geometry::mixed_area(a, b, c);
        }
        const double defect = 2 * std::numbers::pi - angles;
        if (!per_area_) return defect;
        return area > 0 ? defect / area : 0.0;
    }

    bool per_area_;
    const dsc::surface::SurfaceView* surface_ = nullptr;
};

}  // namespace

DSC_PLUGIN("angular_defect", DSC_VERSION, "BSD-3-Clause",
           "Curvature from the angles around a vertex") {
    registrar.add<AngularDefect>("angular_defect",
                                 "2 pi minus the sum of the angles at the vertex");
}
