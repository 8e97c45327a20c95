#pragma once
// Velocity `surface_fit`: the whole interface goes to where a smooth surface with creases fits the cloud best.

#include <dsc/hooks/velocity_field.hpp>
#include <dsc/plugin/plugin.hpp>

#include "data_rows.hpp"
#include "solver.hpp"
#include "stages.hpp"
#include "support.hpp"
#include "surface_links.hpp"

namespace dsc::strategies {

/// In each step one least-squares problem over all vertices, linearised about the surface as it is: points draw the nearest
/// place of the surface to them, robustly; hinges resist bending away from the angle of the filtered normals, the less the
/// sharper they are; vertices are held along the surface. Its bending length falls from step to step.
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

    /// Solves. Throws ConfigError "velocity.no_cloud" when the experiment has no cloud.
    void advance(const hooks::StepContext& context) override;
    /// Solves only where advance() has not, without counting an iteration.
    void prepare(const hooks::StepContext& context) override;
    void evaluate(hooks::Range range, std::span<Vec3> out) const override;

    /// `support`: share of the area round a vertex that points speak for; `gap`: distance to the nearest point, in its
    /// widths; `residual`: root mean square distance of the points, in normalised units.
    void publish(hooks::Attributes& out) const override;

    bool finished() const override;
    std::uint64_t planned_steps() const override;
    /// Creases are kept once the surface has left its start behind, in the last two thirds of the iterations.
    std::optional<mesh::CreaseRule> keep_creases() const override;

    void save(std::ostream& out) const override;
    void load(std::istream& in) override;

private:
    /// What is known from one step to the next.
    struct Progress {
        std::uint64_t first_step = 0;  ///< number of the step of iteration 0
        std::uint64_t iterations = 0;  ///< all that there will be; 0 before the first
        std::uint64_t done = 0;
        std::uint64_t filled = 0;      ///< iterations that have filled holes
        std::uint64_t quiet = 0;       ///< iterations in a row, up to the last one, that moved next to nothing at the last bending length
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
    // Of the step under way; kept for their memory.
    fit::Scales scales_;
    fit::SurfaceLinks links_;
    std::vector<surface::FacePoint> own_places_;  // where the host brings none
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
