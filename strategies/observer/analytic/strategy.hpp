#pragma once
// Observer `analytic`: the distance of the interface from a known solution.

#include <dsc/hooks/observer.hpp>
#include <dsc/plugin/plugin.hpp>
#include <dsc/surface/triangle_mesh.hpp>

namespace dsc::strategies {

/// Compares the place and the enclosed volume of the interface with those that they should have. It treats the whole interface
/// as one surface, so it is meant for complexes with two labels.
class Analytic final : public hooks::Observer {
public:
    /// The solution: the surface of the start (for a motion that returns to it, or keeps it), a sphere that does not change,
    /// one that grows by the same length in every step, or one that shrinks by its mean curvature.
    enum class Solution { start, sphere, growing_sphere, shrinking_sphere };
    struct Params {
        Solution solution = Solution::start;
        Vec3 centre = Vec3::Zero();
        double radius = 1.0;
        double growth = 0.01;
        double time_step = 1e-3;
        double down_to = 0.5;
    };
    static void declare(config::ParamSchema<Params>& schema);

    Analytic(const Params& params, const plugin::Setup& setup);

    void begin(const hooks::StepContext& context) override;
    hooks::Figures step(const hooks::StepContext& context, const hooks::StepFigures& figures) override;
    hooks::Figures end(const hooks::StepContext& context) override;

    /// The figures and the surface of the start, and the largest radius error so far.
    void save(std::ostream& out) const override;
    /// Throws StrategyError "observer.state".
    void load(std::istream& in) override;

private:
    double true_radius(std::uint64_t step) const;
    double true_volume(std::uint64_t step) const;
    void add_sphere_figures(const hooks::StepContext& context, hooks::Figures& out);
    hooks::Figures figures_now(const hooks::StepContext& context);

    Params params_;
    surface::TriangleMesh start_;  // empty unless the solution is the start
    std::size_t start_vertices_ = 0;
    double start_volume_ = 0.0;
    double start_distance_ = 0.0;
    double worst_radius_error_ = 0.0;
    surface::TriangleMesh now_;
};

}  // namespace dsc::strategies
