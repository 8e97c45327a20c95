#include "strategy.hpp"

#include <algorithm>
#include <array>

namespace dsc::strategies {

void PointCloud::declare(config::ParamSchema<Params>& schema) {
    schema.real("alpha", &Params::alpha)
        .range(0, 2)
        .unit("1")
        .doc("Part of the way to the nearest point, seen along the normal, that a vertex goes in a step.");
    schema.real("beta", &Params::beta)
        .at_least(0)
        .unit("length/curvature")
        .doc(
            "How far a vertex goes inwards in a step for a curvature of 1: length^2 for a mean curvature, "
            "length for an "
            "angle. 0 switches the curvature off.");
    schema.strategy("curvature", &Params::curvature, "curvature")
        .optional()
        .doc("Estimator of the curvature that beta weighs.");
    schema.check([](const Params& p) { return p.beta == 0 || !p.curvature.empty(); },
                 "beta above 0 needs a curvature, for instance curvature: {type: implicit_fairing}");
}

PointCloud::PointCloud(const Params& params, const plugin::Setup& setup)
    : alpha_(params.alpha),
      beta_(params.beta),
      curvature_(setup.create<hooks::CurvatureEstimator>("curvature", params.curvature)) {}

void PointCloud::prepare(const hooks::StepContext& context) {
    if (context.cloud == nullptr) {
        throw ConfigError(
            "velocity.no_cloud",
            "velocity 'point_cloud': the experiment has no cloud to go to; add input: {cloud: {file: ...}}");
    }
    surface_ = &context.surface;
    cloud_ = context.cloud;
    if (curvature_ && beta_ > 0) curvature_->prepare(context);
}

Vec3 PointCloud::attraction(const Vec3& point, const Vec3& unit_normal) const {
    const Vec3& target = (*cloud_)[cloud_->search().nearest(point).index];
    return alpha_ * unit_normal.dot(target - point) * unit_normal;
}

void PointCloud::evaluate(hooks::Range range, std::span<Vec3> out) const {
    for (std::size_t i = 0; i < out.size(); ++i) {
        const std::size_t v = range.begin + i;
        out[i] =
            surface_->movable[v] ? attraction(surface_->positions[v], surface_->normals[v]) : Vec3::Zero();
    }
    if (curvature_ && beta_ > 0) subtract_curvature(range, out);
}

// In pieces that fit on the stack, so that nothing is allocated.
void PointCloud::subtract_curvature(hooks::Range range, std::span<Vec3> out) const {
    constexpr std::size_t piece = 128;
    std::array<double, piece> scalar{};
    std::array<Vec3, piece> vector;
    for (std::size_t done = 0; done < range.size(); done += piece) {
        const std::size_t count = std::min(piece, range.size() - done);
        const std::size_t first = range.begin + done;
        curvature_->evaluate({first, first + count}, std::span(scalar).first(count),
                             std::span(vector).first(count));
        for (std::size_t i = 0; i < count; ++i) {
            if (surface_->movable[first + i])
                out[done + i] -= beta_ * scalar[i] * surface_->normals[first + i];
        }
    }
}

void PointCloud::sample(std::span<const Vec3> points, std::span<const Vec3> unit_normals,
                        std::span<Vec3> out) const {
    for (std::size_t i = 0; i < out.size(); ++i) out[i] = attraction(points[i], unit_normals[i]);
}

}  // namespace dsc::strategies
