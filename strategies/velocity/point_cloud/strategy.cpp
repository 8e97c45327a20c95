// Velocity `point_cloud`: every interface vertex moves along its normal towards the nearest point
// of the cloud.
//
//     displacement = (alpha N.(p - x) - beta * curvature) N
//
// where x is the vertex, N its outward unit normal and p the point of the cloud nearest to x, or a
// mean of several near points [Saul2015, eq. 1-4]. The curvature acts everywhere, or only where no
// point supports the surface [Saul2015, ch. 7].
#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include <dsc/base/version.hpp>
#include <dsc/hooks/curvature_estimator.hpp>
#include <dsc/hooks/velocity_field.hpp>
#include <dsc/plugin/plugin.hpp>

namespace {

using dsc::Vec3;

/// A vertex has stalled if its nearest point lies outwards by less than this fraction of its
/// distance: the vertex does not move to points ahead of it.
constexpr double stalled_below = 0.5;
/// Number of vertices that are processed together: they fit on the stack, so nothing is allocated.
constexpr std::size_t piece = 128;

class PointCloud final : public dsc::hooks::VelocityField {
public:
    /// Unsupported surface: its data term may stall, because the nearest point lies in the
    /// surface's own plane (a lid over a tunnel, a web in a handle, a strut).
    struct Unsupported {
        double beyond = 0.0;
        double carve = 0.1;

        static void declare(dsc::config::ParamSchema<Unsupported>& schema) {
            schema.real("beyond", &Unsupported::beyond)
                .at_least(0, "neighbour distances")
                .doc("Distance without points from which a vertex is unsupported, in "
                     "neighbour distances (from the nearest point to its sixth neighbour). "
                     "The surface enters openings of the cloud wider than twice this distance: use "
                     "more than the radius of holes in the data. 0: all vertices are supported.");
            schema.real("carve", &Unsupported::carve)
                .range(0, 1, "target lengths (L)")
                .doc("Least distance that an unsupported vertex whose data term stalls moves "
                     "inwards per step.");
        }
    };

    /// The point p: the nearest point, or the mean of the k nearest with the weights exp((d_1^2 -
    /// d_i^2) / (2 w^2)), where d_i are their distances in ascending order and w is the width.
    struct Target {
        unsigned neighbours = 1;
        double width = 0.5;

        static void declare(dsc::config::ParamSchema<Target>& schema) {
            schema.integer("neighbours", &Target::neighbours)
                .range(1, 1000, "points")
                .doc("Number of nearest points; a vertex moves to their weighted mean. 1: to the "
                     "nearest point, as in the thesis.");
            schema.real("width", &Target::width)
                .greater(0, "neighbour distances")
                .doc("Standard deviation of the Gaussian of the distance that gives the weights of "
                     "the points.");
        }
    };

    enum class CurvatureAt { everywhere, unsupported };

    /// The parameters that an experiment may set; the values here are the defaults.
    struct Params {
        double alpha = 0.2;
        double beta = 0.0;
        dsc::config::StrategyConfig curvature;
        CurvatureAt curvature_at = CurvatureAt::everywhere;
        Target target;
        Unsupported unsupported;
    };
    static void declare(dsc::config::ParamSchema<Params>& schema) {
        schema.real("alpha", &Params::alpha)
            .range(0, 2, "dimensionless")
            .doc("Fraction of the normal distance to the nearest point that a vertex moves per "
                 "step.");
        schema.real("beta", &Params::beta)
            .at_least(0, "length/curvature")
            .doc("Distance that a vertex moves inwards per step for a curvature of 1: length^2 for "
                 "a mean curvature, length for an angle. 0 switches the curvature off.");
        schema.strategy("curvature", &Params::curvature, "curvature")
            .optional()
            .doc("Estimator of the curvature that beta multiplies.");
        schema
            .choice("curvature_at", &Params::curvature_at,
                    {{"everywhere", CurvatureAt::everywhere},
                     {"unsupported", CurvatureAt::unsupported}})
            .doc("Places where the curvature acts: everywhere, as in the thesis, or only where the "
                 "surface is unsupported and the data term stalls, so that webs and leftover "
                 "pieces shrink and supported horns, ears and tips keep their shape.");
        schema.object("target", &Params::target, Target::declare)
            .doc("Point of the cloud to which a vertex moves.");
        schema.object("unsupported", &Params::unsupported, Unsupported::declare)
            .doc("Handling of surface regions without cloud support.");
        schema.check(
            [](const Params& p) { return p.beta == 0 || !p.curvature.empty(); },
            "beta above 0 needs a curvature, for example curvature: {type: implicit_fairing}");
        schema.check(
            [](const Params& p) {
                return p.curvature_at == CurvatureAt::everywhere || p.unsupported.beyond > 0;
            },
            "curvature_at: unsupported needs unsupported: {beyond: ...} above 0");
    }

    PointCloud(const Params& params, const dsc::plugin::Setup& setup)
        : alpha_(params.alpha),
          beta_(params.beta),
          curvature_at_(params.curvature_at),
          target_(params.target),
          unsupported_(params.unsupported),
          curvature_(setup.create<dsc::hooks::CurvatureEstimator>("curvature", params.curvature)) {}

    /// Throws ConfigError "velocity.no_cloud" if the experiment has no cloud.
    void prepare(const dsc::hooks::StepContext& context) override {
        if (context.cloud == nullptr) {
            throw dsc::ConfigError("velocity.no_cloud", "velocity 'point_cloud'",
                                   "the experiment has no cloud",
                                   "add input: {cloud: {file: ...}}");
        }
        surface_ = &context.surface;
        cloud_ = context.cloud;
        nearest_ = context.nearest;
        carving_speed_ = unsupported_.carve * context.target_length;
        if (curvature_ && beta_ > 0) curvature_->prepare(context);
    }

    void evaluate(dsc::hooks::Range range, std::span<Vec3> out) const override {
        for (std::size_t done = 0; done < range.size(); done += piece) {
            const std::size_t count = std::min(piece, range.size() - done);
            const std::size_t first = range.begin + done;
            evaluate_piece({first, first + count}, out.subspan(done, count));
        }
    }

    bool can_sample() const override { return true; }

    /// Attraction and carving only: the curvature has values at vertices and none between them.
    void sample(std::span<const Vec3> points, std::span<const Vec3> unit_normals,
                std::span<Vec3> out) const override {
        for (std::size_t i = 0; i < out.size(); ++i) {
            const dsc::cloud::Neighbour nearest = cloud_->search().nearest(points[i]);
            out[i] = data_term(points[i], unit_normals[i], nearest).speed * unit_normals[i];
        }
    }

private:
    /// Speed and support of a point of the surface, from the cloud.
    struct DataTerm {
        double speed = 0.0;     ///< along the normal
        bool supported = true;  ///< a point is near, or the surface moves towards one
    };
    DataTerm data_term(const Vec3& point, const Vec3& unit_normal,
                       const dsc::cloud::Neighbour& nearest) const {
        const Vec3 target =
            target_.neighbours > 1 ? mean_target(point, nearest) : (*cloud_)[nearest.index];
        const double ahead = unit_normal.dot(target - point);
        const double attraction = alpha_ * ahead;
        if (!(unsupported_.beyond > 0) || !(nearest.distance > 0)) return {attraction, true};
        const bool stalled = ahead < stalled_below * nearest.distance;
        const bool alone =
            nearest.distance > unsupported_.beyond * cloud_->neighbour_distance(nearest.index);
        if (!stalled || !alone) return {attraction, true};
        return {std::min(attraction, -carving_speed_), false};
    }

    Vec3 mean_target(const Vec3& point, const dsc::cloud::Neighbour& nearest) const {
        thread_local std::vector<dsc::cloud::Neighbour> around;  // keeps its memory between calls
        cloud_->search().k_nearest(point, target_.neighbours, around);
        const double width = target_.width * cloud_->neighbour_distance(nearest.index);
        if (!(width > 0)) return (*cloud_)[nearest.index];
        Vec3 sum = Vec3::Zero();
        double weights = 0;
        for (const dsc::cloud::Neighbour& n : around) {
            const double excess = (n.distance - nearest.distance) * (n.distance + nearest.distance);
            const double weight = std::exp(-excess / (2 * width * width));
            sum += weight * (*cloud_)[n.index];
            weights += weight;
        }
        return sum / weights;
    }

    void evaluate_piece(dsc::hooks::Range range, std::span<Vec3> out) const {
        std::array<std::uint8_t, piece> acts{};
        bool any = false;
        for (std::size_t i = 0; i < out.size(); ++i) {
            const std::size_t v = range.begin + i;
            out[i] = Vec3::Zero();
            if (!surface_->movable[v]) continue;
            const Vec3& point = surface_->positions[v];
            const DataTerm term =
                data_term(point, surface_->normals[v],
                          nearest_.empty() ? cloud_->search().nearest(point) : nearest_[v]);
            out[i] = term.speed * surface_->normals[v];
            const bool curved = curvature_at_ == CurvatureAt::everywhere || !term.supported;
            acts[i] = curved ? 1 : 0;
            any = any || curved;
        }
        if (any && curvature_ && beta_ > 0)
            subtract_curvature(range, std::span(acts).first(out.size()), out);
    }

    void subtract_curvature(dsc::hooks::Range range, std::span<const std::uint8_t> acts,
                            std::span<Vec3> out) const {
        std::array<double, piece> scalar{};
        std::array<Vec3, piece> vector;
        curvature_->evaluate(range, std::span(scalar).first(out.size()),
                             std::span(vector).first(out.size()));
        for (std::size_t i = 0; i < out.size(); ++i) {
            if (acts[i] != 0) out[i] -= beta_ * scalar[i] * surface_->normals[range.begin + i];
        }
    }

    double alpha_;
    double beta_;
    CurvatureAt curvature_at_;
    Target target_;
    Unsupported unsupported_;
    std::unique_ptr<dsc::hooks::CurvatureEstimator> curvature_;
    const dsc::surface::SurfaceView* surface_ = nullptr;
    const dsc::cloud::TargetCloud* cloud_ = nullptr;
    std::span<const dsc::cloud::Neighbour> nearest_;  // of the vertices; empty if the host has not
                                                      // searched
    double carving_speed_ = 0.0;                      // length per step
};

}  // namespace

DSC_PLUGIN("point_cloud", DSC_VERSION, "BSD-3-Clause",
           "Attraction of the interface to a point cloud") {
    registrar.add<PointCloud>(
        "point_cloud",
        "moves vertices along their normals towards the nearest cloud point, minus curvature");
}
