#include "strategy.hpp"

#include <dsc/geometry/corner.hpp>
#include <numbers>

namespace dsc::strategies {

void AngularDefect::declare(config::ParamSchema<Params>& schema) {
    schema.boolean("per_area", &Params::per_area)
        .doc("Divide the angle by the area that belongs to the vertex; the result is the Gaussian curvature.");
}

AngularDefect::AngularDefect(const Params& params, const plugin::Setup&) : per_area_(params.per_area) {}

void AngularDefect::prepare(const hooks::StepContext& context) { surface_ = &context.surface; }

double AngularDefect::at(std::size_t vertex) const {
    const auto& positions = surface_->positions;
    double angles = 0;
    double area = 0;
    for (const std::uint32_t face : surface_->faces_of(vertex)) {
        // The corners in the order of the face, rotated so that the vertex comes first.
        const auto& f = surface_->faces[face];
        const std::size_t k = f[0] == vertex ? 0 : f[1] == vertex ? 1 : 2;
        const Vec3& a = positions[f[k]];
        const Vec3& b = positions[f[(k + 1) % 3]];
        const Vec3& c = positions[f[(k + 2) % 3]];
        angles += geometry::corner_angle(a, b, c);
        area += geometry::mixed_area(a, b, c);
    }
    const double defect = 2 * std::numbers::pi - angles;
    if (!per_area_) return defect;
    return area > 0 ? defect / area : 0.0;
}

void AngularDefect::evaluate(hooks::Range range, std::span<double> scalar, std::span<Vec3> vector) const {
    for (std::size_t i = 0; i < range.size(); ++i) {
        scalar[i] = at(range.begin + i);
        vector[i] = scalar[i] * surface_->normals[range.begin + i];
    }
}

}  // namespace dsc::strategies
