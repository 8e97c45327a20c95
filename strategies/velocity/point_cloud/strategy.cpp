#include "strategy.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace dsc::strategies {
namespace {

/// A vertex has stalled if its nearest point lies outwards by less than this fraction of its distance: the vertex does not move
/// to points ahead of it.
constexpr double stalled_below = 0.5;
/// Number of vertices that are processed together: they fit on the stack, so nothing is allocated.
constexpr std::size_t piece = 128;

}  // namespace

void PointCloud::Unsupported::declare(config::ParamSchema<Unsupported>& schema) {
    schema.real("beyond", &Unsupported::beyond)
        .at_least(0)
        .unit("point spacings")
        .doc(
            "Distance without points from which a vertex is unsupported, in spacings of the cloud there (the distance from "
            "the nearest point to its sixth neighbour). The surface enters openings of the cloud wider than twice this distance: "
            "use more than the radius of holes in the data. 0: all vertices are supported.");
    schema.real("carve", &Unsupported::carve)
        .range(0, 1)
        .unit("target lengths (L)")
        .doc("Least distance that an unsupported vertex whose data term stalls moves inwards per step.");
}

void PointCloud::Target::declare(config::ParamSchema<Target>& schema) {
    schema.integer("neighbours", &Target::neighbours)
        .range(1, 1000)
        .unit("points")
        .doc("Number of nearest points; a vertex moves to their weighted mean. 1: to the nearest point, as in the thesis.");
    schema.real("width", &Target::width)
        .greater(0)
        .unit("point spacings")
        .doc("Standard deviation of the Gaussian of the distance that gives the weights of the points.");
}

void PointCloud::declare(config::ParamSchema<Params>& schema) {
    schema.real("alpha", &Params::alpha)
        .range(0, 2)
        .unit("1")
        .doc("Fraction of the normal distance to the nearest point that a vertex moves per step.");
    schema.real("beta", &Params::beta)
        .at_least(0)
        .unit("length/curvature")
        .doc(
            "Distance that a vertex moves inwards per step for a curvature of 1: length^2 for a mean curvature, length for an "
            "angle. 0 switches the curvature off.");
    schema.strategy("curvature", &Params::curvature, "curvature")
        .optional()
        .doc("Estimator of the curvature that beta multiplies.");
    schema.choice("curvature_at", &Params::curvature_at,
                  {{"everywhere", CurvatureAt::everywhere}, {"unsupported", CurvatureAt::unsupported}})
        .doc("Places where the curvature acts: everywhere, as in the thesis, or only where the surface is unsupported and the "
             "data term stalls, so that webs and leftover pieces shrink and supported horns, ears and tips keep their shape.");
    schema.object("target", &Params::target, Target::declare).doc("Point of the cloud to which a vertex moves.");
    schema.object("unsupported", &Params::unsupported, Unsupported::declare)
        .doc("Handling of surface regions without cloud support.");
    schema.check([](const Params& p) { return p.beta == 0 || !p.curvature.empty(); },
                 "beta above 0 needs a curvature, for example curvature: {type: implicit_fairing}");
    schema.check([](const Params& p) { return p.curvature_at == CurvatureAt::everywhere || p.unsupported.beyond > 0; },
                 "curvature_at: unsupported needs unsupported: {beyond: ...} above 0");
}

PointCloud::PointCloud(const Params& params, const plugin::Setup& setup)
    : alpha_(params.alpha),
      beta_(params.beta),
      curvature_at_(params.curvature_at),
      target_(params.target),
      unsupported_(params.unsupported),
      curvature_(setup.create<hooks::CurvatureEstimator>("curvature", params.curvature)) {}

void PointCloud::prepare(const hooks::StepContext& context) {
    if (context.cloud == nullptr) {
        throw ConfigError(
            "velocity.no_cloud",
            "velocity 'point_cloud': the experiment has no cloud; add input: {cloud: {file: ...}}");
    }
    surface_ = &context.surface;
    cloud_ = context.cloud;
    nearest_ = context.nearest;
    carving_speed_ = unsupported_.carve * context.target_length;
    if (curvature_ && beta_ > 0) curvature_->prepare(context);
}

Vec3 PointCloud::mean_target(const Vec3& point, const cloud::Neighbour& nearest) const {
    thread_local std::vector<cloud::Neighbour> around;  // keeps its memory between calls
    cloud_->search().k_nearest(point, target_.neighbours, around);
    const double width = target_.width * cloud_->spacing(nearest.index);
    if (!(width > 0)) return (*cloud_)[nearest.index];
    Vec3 sum = Vec3::Zero();
    double weights = 0;
    for (const cloud::Neighbour& n : around) {
        const double excess = (n.distance - nearest.distance) * (n.distance + nearest.distance);
        const double weight = std::exp(-excess / (2 * width * width));
        sum += weight * (*cloud_)[n.index];
        weights += weight;
    }
    return sum / weights;
}

PointCloud::DataTerm PointCloud::data_term(const Vec3& point, const Vec3& unit_normal,
                                           const cloud::Neighbour& nearest) const {
    const Vec3 target = target_.neighbours > 1 ? mean_target(point, nearest) : (*cloud_)[nearest.index];
    const double ahead = unit_normal.dot(target - point);
    const double attraction = alpha_ * ahead;
    if (!(unsupported_.beyond > 0) || !(nearest.distance > 0)) return {attraction, true};
    const bool stalled = ahead < stalled_below * nearest.distance;
    const bool alone = nearest.distance > unsupported_.beyond * cloud_->spacing(nearest.index);
    if (!stalled || !alone) return {attraction, true};
    return {std::min(attraction, -carving_speed_), false};
}

void PointCloud::evaluate(hooks::Range range, std::span<Vec3> out) const {
    for (std::size_t done = 0; done < range.size(); done += piece) {
        const std::size_t count = std::min(piece, range.size() - done);
        const std::size_t first = range.begin + done;
        evaluate_piece({first, first + count}, out.subspan(done, count));
    }
}

void PointCloud::evaluate_piece(hooks::Range range, std::span<Vec3> out) const {
    std::array<std::uint8_t, piece> acts{};
    bool any = false;
    for (std::size_t i = 0; i < out.size(); ++i) {
        const std::size_t v = range.begin + i;
        out[i] = Vec3::Zero();
        if (!surface_->movable[v]) continue;
        const Vec3& point = surface_->positions[v];
        const DataTerm term =
            data_term(point, surface_->normals[v], nearest_.empty() ? cloud_->search().nearest(point) : nearest_[v]);
        out[i] = term.speed * surface_->normals[v];
        const bool curved = curvature_at_ == CurvatureAt::everywhere || !term.supported;
        acts[i] = curved ? 1 : 0;
        any = any || curved;
    }
    if (any && curvature_ && beta_ > 0) subtract_curvature(range, std::span(acts).first(out.size()), out);
}

void PointCloud::subtract_curvature(hooks::Range range, std::span<const std::uint8_t> acts, std::span<Vec3> out) const {
    std::array<double, piece> scalar{};
    std::array<Vec3, piece> vector;
    curvature_->evaluate(range, std::span(scalar).first(out.size()), std::span(vector).first(out.size()));
    for (std::size_t i = 0; i < out.size(); ++i) {
        if (acts[i] != 0) out[i] -= beta_ * scalar[i] * surface_->normals[range.begin + i];
    }
}

void PointCloud::sample(std::span<const Vec3> points, std::span<const Vec3> unit_normals,
                        std::span<Vec3> out) const {
    for (std::size_t i = 0; i < out.size(); ++i) {
        const cloud::Neighbour nearest = cloud_->search().nearest(points[i]);
        out[i] = data_term(points[i], unit_normals[i], nearest).speed * unit_normals[i];
    }
}

}  // namespace dsc::strategies
