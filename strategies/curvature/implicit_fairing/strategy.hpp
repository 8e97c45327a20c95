#pragma once
// Curvature `implicit_fairing`: the mean curvature normal by cotangent weights.

#include <dsc/hooks/curvature_estimator.hpp>
#include <dsc/plugin/plugin.hpp>

namespace dsc::strategies {

/// K = 1/(4A) sum_j (cot a_j + cot b_j) (x_i - x_j), where a_j and b_j are the angles opposite edge ij [Desbrun1999,
/// eq. 14]. The vector is K, which points outwards where the solid is convex; the scalar is its length with
/// that sign.
class ImplicitFairing final : public hooks::CurvatureEstimator {
public:
    /// The area A: the part of the faces that belongs to the vertex [Meyer2003], or all faces around it.
    enum class Area { mixed, ring };
    struct Params {
        Area area = Area::mixed;
    };
    static void declare(config::ParamSchema<Params>& schema);

    ImplicitFairing(const Params& params, const plugin::Setup& setup);

    void prepare(const hooks::StepContext& context) override;
    void evaluate(hooks::Range range, std::span<double> scalar, std::span<Vec3> vector) const override;

private:
    Vec3 at(std::size_t vertex) const;

    Area area_;
    const surface::SurfaceView* surface_ = nullptr;
};

}  // namespace dsc::strategies
