// Curvature `implicit_fairing`: the mean curvature normal by cotangent weights.
//
//     K = 1/(4A) sum_j (cot a_j + cot b_j) (x_i - x_j)
//
// where a_j and b_j are the angles opposite edge ij [Desbrun1999, eq. 14]. The area A is the part
// of the faces that belongs to the vertex [Meyer2003], or that of all faces around it. The vector
// is K, which points outwards where the solid is convex; the scalar is its length with that sign.
#include <dsc/base/version.hpp>
#include <dsc/geometry/corner.hpp>
#include <dsc/hooks/curvature_estimator.hpp>
#include <dsc/plugin/plugin.hpp>

namespace {

using dsc::Vec3;

class ImplicitFairing final : public dsc::hooks::CurvatureEstimator {
public:
    /// The area A: the part of the faces that belongs to the vertex [Meyer2003], or all faces
    /// around it.
    enum class Area { mixed, ring };

    /// The parameters that an experiment may set; the values here are the defaults.
    struct Params {
        Area area = Area::mixed;
    };
    static void declare(dsc::config::ParamSchema<Params>& schema) {
        schema.choice("area", &Params::area, {{"mixed", Area::mixed}, {"ring", Area::ring}})
            .doc("Area by which the sum is divided. 'mixed' is the part of the faces that belongs "
                 "to the vertex; it gives the mean curvature, 1/r on a sphere. 'ring' is the area "
                 "of all faces around the vertex; it gives the figure of the thesis, about a third "
                 "of the mean curvature.");
    }

    ImplicitFairing(const Params& params, const dsc::plugin::Setup&) : area_(params.area) {}

    void prepare(const dsc::hooks::StepContext& context) override { surface_ = &context.surface; }

    void evaluate(dsc::hooks::Range range, std::span<double> scalar,
                  std::span<Vec3> vector) const override {
        for (std::size_t i = 0; i < range.size(); ++i) {
            vector[i] = at(range.begin + i);
            const double length = vector[i].norm();
            scalar[i] = vector[i].dot(surface_->normals[range.begin + i]) < 0 ? -length : length;
        }
    }

private:
    Vec3 at(std::size_t vertex) const {
        // cot 1 degree: smaller angles are noise
        constexpr double cotangent_limit = 57.28996163075943;
        Vec3 sum = Vec3::Zero();
        double area = 0;
        for (const std::uint32_t face : surface_->faces_of(vertex)) {
            const auto [a, b, c] = surface_->corners_from(vertex, face);
            sum += dsc::geometry::corner_cotangent(c, a, b, cotangent_limit) * (a - b);
            sum += dsc::geometry::corner_cotangent(b, a, c, cotangent_limit) * (a - c);
            area += area_ == Area::mixed ? dsc::geometry::mixed_area(a, b, c)
                                         : surface_->face_areas[face];
        }
        return area > 0 ? Vec3(sum / (4 * area)) : Vec3::Zero();
    }

    Area area_;
    const dsc::surface::SurfaceView* surface_ = nullptr;
};

}  // namespace

DSC_PLUGIN("implicit_fairing", DSC_VERSION, "BSD-3-Clause", "Mean curvature by cotangent weights") {
    registrar.add<ImplicitFairing>(
        "implicit_fairing", "signed mean curvature by cotangent weights (Desbrun et al. 1999)");
}
