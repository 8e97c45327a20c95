#pragma once
// Velocity `surface_fit`: the whole interface moves to where a smooth surface with creases fits the cloud best.

#include <dsc/hooks/velocity_field.hpp>
#include <dsc/plugin/plugin.hpp>

#include "data_rows.hpp"
#include "solver.hpp"
#include "stages.hpp"
#include "support.hpp"
#include "surface_links.hpp"

namespace dsc::strategies {

/// Solves one least-squares problem over all vertices per step, linearised about the current surface: points pull the nearest
/// place of the surface towards them, robustly; hinges resist bending away from the angle of the filtered normals, the less the
/// sharper they are; vertices are held along the surface. The bending length decreases from step to step.
class SurfaceFit final : public hooks::VelocityField {
public:
    struct Params {
        std::uint64_t iterations = 0;
        double smoothing = 1.0;
        double crease_angle = 0.3;
        double noise = 0.0;
        bool fill_holes = true;
    };
    static void declare(config::ParamSchema<Params>& schema);

    SurfaceFit(const Params& params, const plugin::Setup& setup);

    bool needs_faces_of_points() const override { return true; }

    /// Solves the problem. Throws ConfigError "velocity.no_cloud" if the experiment has no cloud.
    void advance(const hooks::StepContext& context) override;
    /// Solves only if advance() has not, without counting an iteration.
    void prepare(const hooks::StepContext& context) override;
    void evaluate(hooks::Range range, std::span<Vec3> out) const override;

    /// `support`: share of the area around a vertex for which there are points; `gap`: distance to the nearest point, in its
    /// widths; `residual`: root mean square distance of the points, in normalised units.
    void publish(hooks::Attributes& out) const override;

    bool finished() const override;
    std::uint64_t planned_steps() const override;
    /// Creases are kept in the last two thirds of the iterations, when the surface has moved away from its start.
    std::optional<repair::CreaseRule> keep_creases() const override;

    void save(std::ostream& out) const override;
    void load(std::istream& in) override;

private:
    /// The state that is kept between steps.
    struct Progress {
        std::uint64_t first_step = 0;  ///< number of the step of iteration 0
        std::uint64_t iterations = 0;  ///< total number of iterations; 0 before the first
        std::uint64_t done = 0;
        std::uint64_t filled = 0;      ///< iterations that have filled holes
        std::uint64_t quiet = 0;       ///< last iterations in a row with hardly any motion at the last bending length
    };

    void measure(const hooks::StepContext& context);
    void solve(const hooks::StepContext& context, std::uint64_t iteration);
    void build_system(const hooks::StepContext& context, const fit::Stage& stage);
    void attach(const hooks::StepContext& context, std::size_t first);
    void bound_displacements(const hooks::StepContext& context);
    bool quiet() const;
    void fill(const hooks::StepContext& context);

    Params params_;
    Progress progress_;
    // Data of the current step; kept to reuse their memory.
    fit::Scales scales_;
    fit::SurfaceLinks links_;
    std::vector<surface::FacePoint> own_places_;  // used if the host provides none
    std::span<const surface::FacePoint> places_;
    std::vector<double> gaps_;
    std::vector<double> widths_;
    std::vector<double> lengths_;
    std::vector<double> curvature_;
    std::vector<Vec3> normals_;
    std::vector<fit::PointFit> fits_;
    std::vector<std::uint32_t> attached_;  // the point of each vertex
    fit::RowSystem system_;
    fit::Solver solver_;
    fit::Support support_;
    std::vector<Vec3> displacements_;
};

}  // namespace dsc::strategies
