// Observer `analytic`: the distance of the interface from a known solution.
//
// Compares the place and the enclosed volume of the interface with those that they should have
// after n steps: those of the start, or of a sphere with the radius
//
//     sphere            r
//     growing_sphere    r + n g
//     shrinking_sphere  sqrt(r^2 - 4 n dt)    mean curvature flow [Huisken1984]
//
// It treats the whole interface as one surface, so it is meant for complexes with two labels.
#include <algorithm>
#include <cmath>
#include <istream>
#include <limits>
#include <ostream>

#include <dsc/base/version.hpp>
#include <dsc/hooks/observer.hpp>
#include <dsc/plugin/plugin.hpp>
#include <dsc/surface/measure.hpp>
#include <dsc/surface/triangle_mesh.hpp>

#include "comparison.hpp"

namespace {

using dsc::Vec3;

void copy_surface(const dsc::surface::SurfaceView& view, dsc::surface::TriangleMesh& mesh) {
    mesh.points = view.positions;
    mesh.faces = view.faces;
}

class Analytic final : public dsc::hooks::Observer {
public:
    /// The solution: the surface of the start (for a motion that returns to it, or keeps it), a
    /// sphere that does not change, one that grows by the same length in every step, or one that
    /// shrinks by its mean curvature.
    enum class Solution { start, sphere, growing_sphere, shrinking_sphere };

    /// The parameters that an experiment may set; the values here are the defaults.
    struct Params {
        Solution solution = Solution::start;
        Vec3 centre = Vec3::Zero();
        double radius = 1.0;
        double growth = 0.01;
        double time_step = 1e-3;
        double down_to = 0.5;
    };
    static void declare(dsc::config::ParamSchema<Params>& schema) {
        schema
            .choice("solution", &Params::solution,
                    {{"start", Solution::start},
                     {"sphere", Solution::sphere},
                     {"growing_sphere", Solution::growing_sphere},
                     {"shrinking_sphere", Solution::shrinking_sphere}})
            .doc("Surface where the interface should be: 'start', its place at the start, for a "
                 "motion that returns there; 'sphere', a sphere that does not change; "
                 "'growing_sphere', a sphere whose radius grows with every step; "
                 "'shrinking_sphere', a sphere whose radius is sqrt(radius^2 - 4 t).");
        schema.vec3("centre", &Params::centre).unit("length").doc("Centre of the sphere.");
        schema.real("radius", &Params::radius)
            .greater(0, "length")
            .doc("Radius of the sphere at the start.");
        schema.real("growth", &Params::growth)
            .unit("length")
            .doc("Growth of the radius of 'growing_sphere' per step.");
        schema.real("time_step", &Params::time_step)
            .greater(0, "length^2")
            .doc("Time per step of 'shrinking_sphere'; use the same value as the velocity.");
        schema.real("down_to", &Params::down_to)
            .range(0, 1, "radius")
            .open_low()
            .doc("Fraction of the initial radius down to which radius_error includes a shrinking "
                 "sphere.");
    }

    Analytic(const Params& params, const dsc::plugin::Setup&) : params_(params) {}

    void begin(const dsc::hooks::StepContext& context) override {
        copy_surface(context.surface, now_);
        start_vertices_ = now_.points.size();
        start_volume_ = dsc::surface::volume(now_);
        if (params_.solution == Solution::start) {
            start_ = now_;
            return;
        }
        start_distance_ = dsc::strategies::compare_with_sphere(now_, params_.centre, params_.radius)
                              .largest_distance;
        worst_radius_error_ = 0.0;
    }

    dsc::hooks::Figures step(const dsc::hooks::StepContext& context,
                             const dsc::hooks::StepFigures&) override {
        return figures_now(context);
    }

    dsc::hooks::Figures end(const dsc::hooks::StepContext& context) override {
        dsc::hooks::Figures out = figures_now(context);
        if (params_.solution == Solution::start) {
            if (!now_.faces.empty() && !start_.faces.empty() && context.target_length > 0)
                out.emplace_back("surface_error", dsc::strategies::mean_distance(now_, start_) /
                                                      context.target_length);
            return out;
        }
        for (auto& [figure, value] : out) {
            if (figure == "radius_error") value = worst_radius_error_;
        }
        return out;
    }

    /// The figures and the surface of the start, and the largest radius error so far.
    void save(std::ostream& out) const override {
        out.precision(std::numeric_limits<double>::max_digits10);
        out << start_vertices_ << ' ' << start_volume_ << ' ' << start_distance_ << ' '
            << worst_radius_error_ << ' ' << start_.points.size() << ' ' << start_.faces.size()
            << '\n';
        for (const Vec3& p : start_.points) out << p.x() << ' ' << p.y() << ' ' << p.z() << '\n';
        for (const auto& [a, b, c] : start_.faces) out << a << ' ' << b << ' ' << c << '\n';
    }

    /// Throws StrategyError "observer.state".
    void load(std::istream& in) override {
        std::size_t points = 0;
        std::size_t faces = 0;
        in >> start_vertices_ >> start_volume_ >> start_distance_ >> worst_radius_error_ >>
            points >> faces;
        start_ = {};
        for (std::size_t i = 0; in && i < points; ++i) {
            Vec3 p;
            in >> p.x() >> p.y() >> p.z();
            start_.points.push_back(p);
        }
        for (std::size_t i = 0; in && i < faces; ++i) {
            std::array<std::uint32_t, 3> face{};
            in >> face[0] >> face[1] >> face[2];
            start_.faces.push_back(face);
        }
        if (!in)
            throw dsc::StrategyError("observer.state", "observer 'analytic'",
                                     "the saved state is damaged", "start the run again");
        dsc::surface::require_sound(start_);
    }

private:
    double true_radius(std::uint64_t step) const {
        const auto steps = static_cast<double>(step);
        switch (params_.solution) {
            case Solution::start:
            case Solution::sphere: return params_.radius;
            case Solution::growing_sphere:
                return std::max(0.0, params_.radius + params_.growth * steps);
            case Solution::shrinking_sphere:
                return std::sqrt(
                    std::max(0.0, params_.radius * params_.radius - 4 * params_.time_step * steps));
        }
        return params_.radius;
    }

    double true_volume(std::uint64_t step) const {
        const double shrunk = true_radius(step) / params_.radius;
        return start_volume_ * shrunk * shrunk * shrunk;
    }

    void add_sphere_figures(const dsc::hooks::StepContext& context, dsc::hooks::Figures& out) {
        const double radius = true_radius(context.step);
        const double least = params_.down_to * params_.radius;
        const dsc::strategies::SphereComparison found =
            dsc::strategies::compare_with_sphere(now_, params_.centre, radius);
        // If nothing is left, the distance from the sphere is its radius.
        const double distance = now_.faces.empty() ? radius : found.largest_distance;
        const double mean = now_.faces.empty() ? radius : found.mean_distance;
        const double error = std::abs(found.radius - radius) / std::max(radius, least);
        if (radius >= least) worst_radius_error_ = std::max(worst_radius_error_, error);
        out.emplace_back("distance_ratio", start_distance_ > 0 ? distance / start_distance_ : 0.0);
        out.emplace_back("radius_error", error);
        out.emplace_back("surface_error",
                         context.target_length > 0 ? mean / context.target_length : 0.0);
    }

    dsc::hooks::Figures figures_now(const dsc::hooks::StepContext& context) {
        copy_surface(context.surface, now_);
        const double expected = true_volume(context.step);
        const double off = std::abs(dsc::surface::volume(now_) - expected);
        const auto vertices = static_cast<double>(now_.points.size());
        dsc::hooks::Figures out;
        out.emplace_back("volume_drift", expected > 0        ? off / expected
                                         : start_volume_ > 0 ? off / start_volume_
                                                             : 0.0);
        out.emplace_back("vertex_ratio", start_vertices_ > 0
                                             ? vertices / static_cast<double>(start_vertices_)
                                             : 0.0);
        if (params_.solution != Solution::start) add_sphere_figures(context, out);
        return out;
    }

    Params params_;
    dsc::surface::TriangleMesh start_;  // empty unless the solution is the start
    std::size_t start_vertices_ = 0;
    double start_volume_ = 0.0;
    double start_distance_ = 0.0;
    double worst_radius_error_ = 0.0;
    dsc::surface::TriangleMesh now_;
};

}  // namespace

DSC_PLUGIN("analytic", DSC_VERSION, "BSD-3-Clause",
           "Error of the interface against a known solution") {
    registrar.add<Analytic>("analytic", "compares the interface with a known solution");
}
