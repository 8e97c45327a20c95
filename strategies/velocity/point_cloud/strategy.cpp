#include "strategy.hpp"

#include <algorithm>
#include <array>

namespace dsc::strategies {
namespace {

/// A vertex whose nearest point lies less than this part of its distance outwards has stalled: it is not on its way to
/// points that lie ahead of it.
constexpr double stalled_below = 0.5;

}  // namespace

void PointCloud::Unsupported::declare(config::ParamSchema<Unsupported>& schema) {
    schema.real("beyond", &Unsupported::beyond)
        .at_least(0)
        .unit("point spacings")
        .doc(
            "A vertex is unsupported when no point lies within this many spacings of the cloud there (the distance from "
            "the nearest point to its sixth neighbour). Openings of the cloud wider than twice this are entered: "
            "take more than the radius of holes in the data. 0 switches carving off.");
    schema.real("carve", &Unsupported::carve)
        .range(0, 1)
        .unit("mean edges")
        .doc("How far an unsupported vertex whose data term stalls goes inwards in a step, at least.");
}

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
    schema.object("unsupported", &Params::unsupported, Unsupported::declare)
        .doc("What happens where no point speaks for the surface.");
    schema.check([](const Params& p) { return p.beta == 0 || !p.curvature.empty(); },
                 "beta above 0 needs a curvature, for instance curvature: {type: implicit_fairing}");
}

PointCloud::PointCloud(const Params& params, const plugin::Setup& setup)
    : alpha_(params.alpha),
      beta_(params.beta),
      unsupported_(params.unsupported),
      curvature_(setup.create<hooks::CurvatureEstimator>("curvature", params.curvature)) {}

void PointCloud::prepare(const hooks::StepContext& context) {
    if (context.cloud == nullptr) {
        throw ConfigError(
            "velocity.no_cloud",
            "velocity 'point_cloud': the experiment has no cloud to go to; add input: {cloud: {file: ...}}");
    }
    surface_ = &context.surface;
    cloud_ = context.cloud;
    carving_speed_ = unsupported_.carve * context.target_length;
    if (curvature_ && beta_ > 0) curvature_->prepare(context);
}

double PointCloud::speed(const Vec3& point, const Vec3& unit_normal) const {
    const cloud::Neighbour nearest = cloud_->search().nearest(point);
    const double ahead = unit_normal.dot((*cloud_)[nearest.index] - point);
    const double attraction = alpha_ * ahead;
    if (!(unsupported_.beyond > 0) || !(nearest.distance > 0)) return attraction;
    const bool stalled = ahead < stalled_below * nearest.distance;
    const bool alone = nearest.distance > unsupported_.beyond * cloud_->spacing(nearest.index);
    return stalled && alone ? std::min(attraction, -carving_speed_) : attraction;
}

void PointCloud::evaluate(hooks::Range range, std::span<Vec3> out) const {
    for (std::size_t i = 0; i < out.size(); ++i) {
        const std::size_t v = range.begin + i;
        const Vec3& normal = surface_->normals[v];
        out[i] = surface_->movable[v] ? Vec3(speed(surface_->positions[v], normal) * normal) : Vec3(Vec3::Zero());
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
    for (std::size_t i = 0; i < out.size(); ++i) out[i] = speed(points[i], unit_normals[i]) * unit_normals[i];
}

}  // namespace dsc::strategies
