#include "strategy.hpp"

#include <dsc/geometry/corner.hpp>

namespace dsc::strategies {

void ImplicitFairing::declare(config::ParamSchema<Params>& schema) {
    schema.choice("area", &Params::area, {{"mixed", Area::mixed}, {"ring", Area::ring}})
        .doc(
            "Area by which the sum is divided. 'mixed' is the part of the faces that belongs to the vertex; it gives the mean "
            "curvature, 1/r on a sphere. 'ring' is the area of all faces around the vertex; it gives the figure of the thesis, "
            "about a third of the mean curvature.");
}

ImplicitFairing::ImplicitFairing(const Params& params, const plugin::Setup&) : area_(params.area) {}

void ImplicitFairing::prepare(const hooks::StepContext& context) { surface_ = &context.surface; }

Vec3 ImplicitFairing::at(std::size_t vertex) const {
    constexpr double cotangent_limit = 57.28996163075943;  // cot 1 degree: smaller angles are noise
    const auto& positions = surface_->positions;
    Vec3 sum = Vec3::Zero();
    double area = 0;
    for (const std::uint32_t face : surface_->faces_of(vertex)) {
        // The corners in the order of the face, rotated so that the vertex comes first.
        const auto& f = surface_->faces[face];
        const std::size_t k = f[0] == vertex ? 0 : f[1] == vertex ? 1 : 2;
        const Vec3& a = positions[f[k]];
        const Vec3& b = positions[f[(k + 1) % 3]];
        const Vec3& c = positions[f[(k + 2) % 3]];
        sum += geometry::corner_cotangent(c, a, b, cotangent_limit) * (a - b);
        sum += geometry::corner_cotangent(b, a, c, cotangent_limit) * (a - c);
        area += area_ == Area::mixed ? geometry::mixed_area(a, b, c) : surface_->face_areas[face];
    }
    return area > 0 ? Vec3(sum / (4 * area)) : Vec3::Zero();
}

void ImplicitFairing::evaluate(hooks::Range range, std::span<double> scalar, std::span<Vec3> vector) const {
    for (std::size_t i = 0; i < range.size(); ++i) {
        vector[i] = at(range.begin + i);
        const double length = vector[i].norm();
        scalar[i] = vector[i].dot(surface_->normals[range.begin + i]) < 0 ? -length : length;
    }
}

}  // namespace dsc::strategies
