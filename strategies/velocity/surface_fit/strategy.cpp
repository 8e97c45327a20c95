// Velocity `surface_fit`: the whole interface moves to where a smooth surface with creases fits the
// cloud best.
//
// Per step, one least-squares problem for the displacements u of all vertices is solved, linearised
// about the current surface:
//
//     sum over points     w_i (n_i . u(y_i) - r_i)^2               data_rows.cpp, attachments.cpp
//     + sum over edges    b_e (change of the angle - wanted)^2     bending_rows.cpp
//     + sum over vertices u_v . D_v u_v                            holds.cpp
//
// where y_i is the place of the surface nearest to point i, n_i the direction from there to the
// point and r_i its distance. The weights w_i are robust, b_e is smaller for sharper edges, and D_v
// holds a vertex along the surface. The wanted angles are those of the filtered normals
// [Zheng2011]. The bending length, which is part of b_e, decreases from step to step (stages.cpp).
// README.md gives all weights.
#include <algorithm>
#include <cmath>
#include <istream>
#include <iterator>
#include <ostream>

#include <dsc/base/state.hpp>
#include <dsc/base/version.hpp>
#include <dsc/hooks/velocity_field.hpp>
#include <dsc/plugin/plugin.hpp>

#include "attachments.hpp"
#include "bending_rows.hpp"
#include "data_rows.hpp"
#include "filtered_normals.hpp"
#include "holds.hpp"
#include "hole_fill.hpp"
#include "local_widths.hpp"
#include "mean_curvature.hpp"
#include "solver.hpp"
#include "stages.hpp"
#include "support.hpp"
#include "surface_links.hpp"

namespace {

namespace fit = dsc::strategies::fit;
using dsc::Vec3;

constexpr std::uint64_t few_iterations = 14;
constexpr std::uint64_t many_iterations = 24;  // used if there are holes
constexpr double unsupported_beyond = 2.0;     // spacings
constexpr double many_unsupported = 0.005;     // fraction of vertices: the cloud has holes
// In the second, the kernel continues motions that did not arrive in the first.
constexpr std::uint64_t fill_repeats = 2;
constexpr double longest_way = 0.7;        // target lengths: per step, and to a point at a vertex
constexpr double largest_curvature = 0.5;  // divided by a spacing
constexpr double quiet_way = 0.005;        // mean, in spacings
constexpr std::uint64_t quiet_iterations = 2;

class SurfaceFit final : public dsc::hooks::VelocityField {
public:
    /// The parameters that an experiment may set; the values here are the defaults.
    struct Params {
        std::uint64_t iterations = 0;
        double smoothing = 1.0;
        double crease_angle = 0.3;
        double noise = 0.0;
        bool fill_holes = true;
    };
    static void declare(dsc::config::ParamSchema<Params>& schema) {
        schema.integer("iterations", &Params::iterations)
            .range(0, 1000, "steps")
            .doc("Number of steps of the whole motion; the bending length decreases in the first "
                 "60 % of them. 0: 14, or 24 if the cloud has holes.");
        schema.real("smoothing", &Params::smoothing)
            .range(0, 100, "dimensionless")
            .open_low()
            .doc("Factor of the final bending length, over which the surface is smooth; the length "
                 "itself follows from the noise.");
        schema.real("crease_angle", &Params::crease_angle)
            .greater(0, "radians")
            .doc("Angle between the faces of an edge above which the edge resists bending less and "
                 "becomes a crease.");
        schema.real("noise", &Params::noise)
            .range(0, 100, "spacings")
            .doc("Standard deviation of the points across the surface; a spacing is the root "
                 "of the area per point. 0: it is measured.");
        schema.boolean("fill_holes", &Params::fill_holes)
            .doc("Continue the surrounding surface over holes in the cloud, once, after 2/7 of the "
                 "steps.");
    }

    SurfaceFit(const Params& params, const dsc::plugin::Setup&) : params_(params) {}

    bool needs_faces_of_points() const override { return true; }

    /// Solves the problem. Throws ConfigError "velocity.no_cloud" if the experiment has no cloud.
    void advance(const dsc::hooks::StepContext& context) override {
        measure(context);
        // The numbers of steps increase: a smaller number belongs to another motion.
        if (context.step < progress_.first_step + progress_.done) progress_ = {};
        if (progress_.iterations == 0) {
            progress_.first_step = context.step;
            const auto far = std::count_if(gaps_.begin(), gaps_.end(),
                                           [](double gap) { return gap > unsupported_beyond; });
            const bool holes =
                static_cast<double>(far) > many_unsupported * static_cast<double>(gaps_.size());
            progress_.iterations = params_.iterations > 0 ? params_.iterations
                                   : holes                ? many_iterations
                                                          : few_iterations;
        }
        solve(context, progress_.done);
        if (params_.fill_holes && progress_.done >= fit::fill_iteration(progress_.iterations) &&
            progress_.filled < fill_repeats) {
            fill(context);
            ++progress_.filled;
        }
        const bool settled = static_cast<double>(progress_.done) >=
                             fit::settling_part * static_cast<double>(progress_.iterations);
        progress_.quiet = settled && quiet() ? progress_.quiet + 1 : 0;
        ++progress_.done;
    }

    /// Solves only if advance() has not, without counting an iteration.
    void prepare(const dsc::hooks::StepContext& context) override {
        if (context.cloud != nullptr && progress_.done > 0 &&
            displacements_.size() == context.surface.vertex_count())
            return;
        measure(context);
        solve(context, progress_.done > 0 ? progress_.done - 1 : 0);
    }

    void evaluate(dsc::hooks::Range range, std::span<Vec3> out) const override {
        std::copy_n(displacements_.begin() + static_cast<std::ptrdiff_t>(range.begin), out.size(),
                    out.begin());
    }

    /// `support`: share of the area around a vertex for which there are points; `gap`: distance to
    /// the nearest point, in its widths; `residual`: root mean square distance of the points, in
    /// normalised units.
    void publish(dsc::hooks::Attributes& out) const override {
        out.push_back({"support", support_.share});
        out.push_back({"gap", gaps_});
        out.push_back({"residual", support_.residual});
    }

    bool finished() const override {
        return progress_.iterations > 0 &&
               (progress_.done >= progress_.iterations || progress_.quiet >= quiet_iterations);
    }

    std::uint64_t planned_steps() const override {
        return progress_.iterations > 0 ? progress_.first_step + progress_.iterations - 1
                                        : params_.iterations;
    }

    /// Creases are kept in the last two thirds of the iterations, when the surface has moved away
    /// from its start.
    std::optional<dsc::repair::CreaseRule> keep_creases() const override {
        const bool shaped = progress_.iterations > 0 &&
                            static_cast<double>(progress_.done) >
                                fit::start_part * static_cast<double>(progress_.iterations);
        return shaped ? std::optional(dsc::repair::CreaseRule{}) : std::nullopt;
    }

    void save(std::ostream& out) const override {
        dsc::StateWriter state;
        state.value(progress_);
        const std::string bytes = state.take();
        out.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    }

    void load(std::istream& in) override {
        const std::string bytes{std::istreambuf_iterator<char>(in),
                                std::istreambuf_iterator<char>()};
        dsc::StateReader state(bytes);
        state.value(progress_);
        displacements_.clear();
    }

private:
    /// The state that is kept between steps.
    struct Progress {
        std::uint64_t first_step = 0;  ///< number of the step of iteration 0
        std::uint64_t iterations = 0;  ///< total number of iterations; 0 before the first
        std::uint64_t done = 0;
        std::uint64_t filled = 0;  ///< iterations that have filled holes
        /// Last iterations in a row with hardly any motion at the last bending length.
        std::uint64_t quiet = 0;
    };

    // Prepares all data of surface and cloud for the rows.
    void measure(const dsc::hooks::StepContext& context) {
        if (context.cloud == nullptr) {
            throw dsc::ConfigError("velocity.no_cloud", "velocity 'surface_fit'",
                                   "the experiment has no cloud",
                                   "add input: {cloud: {file: ...}}");
        }
        const dsc::surface::SurfaceView& view = context.surface;
        scales_ = fit::scales_of(context.cloud->statistics(context.workers), params_.noise);
        places_ = context.faces_of_points;
        if (places_.size() != context.cloud->size()) {
            dsc::surface::nearest_faces(view, context.cloud->points(), own_places_,
                                        context.workers);
            places_ = own_places_;
        }
        fit::build_links(view, links_);
        fit::measure_gaps(context, gaps_);
        fit::measure_widths(context, links_, scales_, widths_);
        lengths_.resize(view.vertex_count());
        for (std::size_t v = 0; v < lengths_.size(); ++v) {
            const double length = context.target_length_at(v);
            lengths_[v] = length > 0.0 ? length : view.mean_edge;
        }
    }

    void solve(const dsc::hooks::StepContext& context, std::uint64_t iteration) {
        const std::uint64_t iterations = std::max<std::uint64_t>(1, progress_.iterations);
        const fit::Stage stage = fit::stage_of(scales_, iteration, iterations, params_.smoothing);
        build_system(context, stage);
        solver_.solve(system_, {}, context.workers, displacements_);
        bound_displacements(context);
        fit::measure_support(context.surface, places_, fits_, support_);
    }

    void build_system(const dsc::hooks::StepContext& context, const fit::Stage& stage) {
        const dsc::surface::SurfaceView& view = context.surface;
        dsc::Workers* const workers = context.workers;
        fit::filter_normals(view, stage.filter_rounds, stage.filter_range, lengths_, workers,
                            normals_);
        curvature_.clear();
        if (scales_.noise > 0.0)
            fit::measure_curvature(view, links_, largest_curvature / scales_.width, workers,
                                   curvature_);

        const std::size_t hinges = links_.hinges.size();
        system_.rows.resize(hinges + places_.size() + (stage.attach ? 3 * view.vertex_count() : 0));
        system_.wanted.resize(system_.rows.size());
        fit::bending_rows(
            {view, links_.hinges, normals_, widths_, stage.bending, params_.crease_angle}, 0,
            system_, workers);
        fit::data_rows({view, context.cloud->points().first(places_.size()), places_,
                        context.cloud->statistics().point_width, widths_, curvature_, scales_.noise,
                        stage.reach},
                       hinges, system_, fits_, workers);
        if (stage.attach) attach(context, hinges + places_.size());
        fit::measure_holds(view, lengths_, stage.tangential, stage.normal, workers, system_.holds);
        fit::gather_rows(system_, view.movable);
    }

    // If the spacing is uneven, nearly equilateral triangles have an edge along every ridge that
    // lines of points mark only if vertices move to points.
    void attach(const dsc::hooks::StepContext& context, std::size_t first) {
        const std::span<const Vec3> points = context.cloud->points().first(places_.size());
        fit::attach_vertices(context.surface, points, places_, lengths_, longest_way, attached_);
        fit::attachment_rows(context.surface, points, attached_, widths_, first, system_,
                             context.workers);
    }

    void bound_displacements(const dsc::hooks::StepContext& context) {
        for (std::size_t v = 0; v < displacements_.size(); ++v) {
            Vec3& d = displacements_[v];
            const double way = d.norm();
            const double bound = longest_way * lengths_[v];
            if (context.surface.movable[v] == 0 || !std::isfinite(way))
                d = Vec3::Zero();
            else if (way > bound)
                d *= bound / way;
        }
    }

    // The surface over holes, which settles last, must also have come to rest.
    bool quiet() const {
        double way = 0.0, way_in_holes = 0.0;
        std::size_t in_holes = 0;
        for (std::size_t v = 0; v < displacements_.size(); ++v) {
            const double d = displacements_[v].norm();
            way += d;
            if (gaps_[v] <= unsupported_beyond) continue;
            way_in_holes += d;
            ++in_holes;
        }
        const double bound = quiet_way * scales_.width;
        return way <= bound * static_cast<double>(displacements_.size()) &&
               way_in_holes <= bound * static_cast<double>(in_holes);
    }

    // For the surface as the solution would move it.
    void fill(const dsc::hooks::StepContext& context) {
        const dsc::surface::SurfaceView& view = context.surface;
        std::vector<Vec3> places = view.positions;
        for (std::size_t v = 0; v < places.size(); ++v) places[v] += displacements_[v];
        if (fit::fill_holes(links_, gaps_, view.movable, places) == 0) return;
        for (std::size_t v = 0; v < places.size(); ++v)
            displacements_[v] = places[v] - view.positions[v];
    }

    Params params_;
    Progress progress_;
    // Data of the current step; kept to reuse their memory.
    fit::Scales scales_;
    fit::SurfaceLinks links_;
    std::vector<dsc::surface::FacePoint> own_places_;  // used if the host provides none
    std::span<const dsc::surface::FacePoint> places_;
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

}  // namespace

DSC_PLUGIN("surface_fit", DSC_VERSION, "BSD-3-Clause",
           "Least-squares fit of the interface to a point cloud") {
    registrar.add<SurfaceFit>(
        "surface_fit",
        "moves the whole surface to where a smooth surface with creases fits the cloud best");
}
