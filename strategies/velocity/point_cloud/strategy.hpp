#pragma once
// Velocity `point_cloud`: every interface vertex moves along its normal towards the nearest point of the
// cloud.

#include <dsc/hooks/curvature_estimator.hpp>
#include <dsc/hooks/velocity_field.hpp>
#include <dsc/plugin/plugin.hpp>

namespace dsc::strategies {

/// Displacement (alpha N.(p - x) - beta * curvature) N, where x is the vertex, N its outward unit normal, p the point
/// of the cloud nearest to x [Saul2015, eq. 1-4], or a mean of several near points. The curvature acts everywhere or only
/// where no point supports the surface [Saul2015, ch. 7].
class PointCloud final : public hooks::VelocityField {
public:
    /// Unsupported surface: its data term may stall, because the nearest point lies in the surface's
    /// own plane (a lid over a tunnel, a web in a handle, a strut).
    struct Unsupported {
        double beyond = 0.0;
        double carve = 0.1;

        static void declare(config::ParamSchema<Unsupported>& schema);
    };
    /// The point p: the nearest point, or the mean of the k nearest with the weights exp((d_1^2 - d_i^2) / (2 w^2)), where d_i
    /// are their distances in ascending order and w is the width.
    struct Target {
        unsigned neighbours = 1;
        double width = 0.5;

        static void declare(config::ParamSchema<Target>& schema);
    };
    enum class CurvatureAt { everywhere, unsupported };
    struct Params {
        double alpha = 0.2;
        double beta = 0.0;
        config::StrategyConfig curvature;
        CurvatureAt curvature_at = CurvatureAt::everywhere;
        Target target;
        Unsupported unsupported;
    };
    static void declare(config::ParamSchema<Params>& schema);

    PointCloud(const Params& params, const plugin::Setup& setup);

    /// Throws ConfigError "velocity.no_cloud" if the experiment has no cloud.
    void prepare(const hooks::StepContext& context) override;
    void evaluate(hooks::Range range, std::span<Vec3> out) const override;

    bool can_sample() const override { return true; }
    /// Attraction and carving only: the curvature has values at vertices and none between them.
    void sample(std::span<const Vec3> points, std::span<const Vec3> unit_normals,
                std::span<Vec3> out) const override;

private:
    /// Speed and support of a point of the surface, from the cloud.
    struct DataTerm {
        double speed = 0.0;      ///< along the normal
        bool supported = true;  ///< a point is near, or the surface moves towards one
    };
    DataTerm data_term(const Vec3& point, const Vec3& unit_normal, const cloud::Neighbour& nearest) const;
    Vec3 mean_target(const Vec3& point, const cloud::Neighbour& nearest) const;
    void evaluate_piece(hooks::Range range, std::span<Vec3> out) const;
    void subtract_curvature(hooks::Range range, std::span<const std::uint8_t> acts, std::span<Vec3> out) const;

    double alpha_;
    double beta_;
    CurvatureAt curvature_at_;
    Target target_;
    Unsupported unsupported_;
    std::unique_ptr<hooks::CurvatureEstimator> curvature_;
    const surface::SurfaceView* surface_ = nullptr;
    const cloud::TargetCloud* cloud_ = nullptr;
    std::span<const cloud::Neighbour> nearest_;  // of the vertices; empty if the host has not searched
    double carving_speed_ = 0.0;  // length per step
};

}  // namespace dsc::strategies
