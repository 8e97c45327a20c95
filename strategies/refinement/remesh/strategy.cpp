// Refinement `remesh`: keeps the edges of the interface at their target length, its triangles
// nearly equilateral, and its creases.
//
// The refinement consists of sweeps of splits, collapses, flips and tangential steps [Botsch2004],
// spread over its passes: many sweeps in the first refinement, two in early ones, only flips in the
// last third of the run. sizing.cpp computes the target lengths, edits.cpp chooses the edits of a
// pass on the edges of edge_mesh.cpp.
#include <cmath>
#include <istream>
#include <limits>
#include <ostream>

#include <dsc/base/version.hpp>
#include <dsc/hooks/refinement_policy.hpp>
#include <dsc/plugin/plugin.hpp>

#include "edge_mesh.hpp"
#include "edits.hpp"
#include "sizing.hpp"

namespace {

constexpr std::uint64_t usual_steps = 14;  // for a run without a planned number of steps
constexpr unsigned first_sweeps = 6, later_sweeps = 2;
constexpr unsigned last_flips = 2;  // passes with only flips at the end
// Radians: edges above the first angle are not flipped in sweeps once creases are kept, edges above
// the second angle are not flipped in passes with only flips.
constexpr double sweep_angle = 1.0, flip_angle = 0.5;
constexpr double too_many_factor = 1.02;
// Ratio of mean edge and target length, or its inverse, above which a surface is not yet remeshed.
constexpr double far_ratio = 1.25;

// Whether the surface still has to get its edge length although the run has begun.
bool far_off(const dsc::hooks::StepContext& step) {
    return !(step.surface.mean_edge < far_ratio * step.target_length &&
             step.target_length < far_ratio * step.surface.mean_edge);
}

class Remesh final : public dsc::hooks::RefinementPolicy {
public:
    /// The parameters that an experiment may set; the values here are the defaults.
    struct Params {
        dsc::cloud::Detail detail = dsc::cloud::Detail::medium;
        std::uint64_t vertices = 0;
        double edge_length = 0.0;
        bool thin_parts = true;
    };
    static void declare(dsc::config::ParamSchema<Params>& schema) {
        schema
            .choice("detail", &Params::detail,
                    {{"low", dsc::cloud::Detail::low},
                     {"medium", dsc::cloud::Detail::medium},
                     {"high", dsc::cloud::Detail::high}})
            .doc("Level of detail: half, all or twice the number of vertices that follows from the "
                 "number of points.");
        schema.integer("vertices", &Params::vertices)
            .at_least(0, "vertices")
            .doc("Number of vertices that the surface may have. 0: it follows from the number of "
                 "points; it is two per point up to 3,000 points, 20,000 at 20,000 points, and "
                 "grows with the root of their number above that.");
        schema.real("edge_length", &Params::edge_length)
            .at_least(0, "length")
            .doc("Length of all edges, in the units of the input. 0: it follows from the number of "
                 "vertices and the area of the cloud's points; it is longer if the points are "
                 "noisy, and local if their spacing is uneven.");
        schema.boolean("thin_parts", &Params::thin_parts)
            .doc("Whether parts thinner than two edges get shorter edges: half their thickness, at "
                 "least half a spacing, and up to 1.5 times as many vertices. Only with a "
                 "cloud and without an edge length.");
    }

    Remesh(const Params& params, const dsc::plugin::Setup&) : params_(params) {}

    bool owns_sizing() const override { return true; }
    unsigned passes() const override { return dsc::hooks::refinement_passes; }

    std::optional<dsc::repair::CreaseRule> keep_creases() const override {
        if (refinements_ == 0 || !keeps()) return std::nullopt;
        return dsc::repair::CreaseRule{dsc::remesh::crease_angle,
                                       std::acos(dsc::remesh::turn_cosine)};
    }

    void refine(const dsc::hooks::RefinementContext& context,
                dsc::hooks::RefinementRequests& out) override {
        if (context.step.surface.face_count() == 0) return;
        mesh_.build(context.step.surface, context.step.workers);
        dsc::remesh::Lengths lengths{context.step.target_length, context.step.target_lengths};
        if (context.pass == 0) {
            begin(context.step);
            edits_.start_refinement();
            // Flips need no target lengths, and the kernel keeps those of the last sweep.
            if (stages_.front() != Stage::flips) lengths = set_lengths(context.step, out);
        }
        edits_.start_pass(mesh_);
        while (next_stage_ < stages_.size()) {
            if (ask(stages_[next_stage_++], lengths, out)) break;
        }
    }

    void save(std::ostream& out) const override {
        out.precision(std::numeric_limits<double>::max_digits10);
        out << refinements_ << ' ' << step_ << ' ' << last_step_ << ' ' << too_many_ << ' '
            << allowed_ << '\n';
    }

    void load(std::istream& in) override {
        in >> refinements_ >> step_ >> last_step_ >> too_many_ >> allowed_;
        if (!in)
            throw dsc::StrategyError("refinement.state", "refinement 'remesh'",
                                     "the saved state is damaged", "start the run again");
    }

private:
    /// The kind of requests of a pass; each pass also requests flips.
    enum class Stage : std::uint8_t { sizes, collapses, moves, flips };

    void begin(const dsc::hooks::StepContext& step) {
        if (allowed_ > 0.0 && static_cast<double>(step.surface.vertex_count()) > allowed_)
            ++too_many_;
        step_ = step.step;
        last_step_ = step.planned_steps > 0 ? step.planned_steps : usual_steps;
        plan(step);
        ++refinements_;
    }

    void plan(const dsc::hooks::StepContext& step) {
        unsigned sweeps = 0;
        if (refinements_ == 0 && (step.step == 0 || far_off(step))) {
            sweeps = first_sweeps;
        } else if (refinements_ == 0 || step.step <= 2 ||
                   (step.step % 2 == 0 && 3 * step.step < 2 * last_step_)) {
            sweeps = later_sweeps;
        }
        stages_.clear();
        for (unsigned i = 0; i < sweeps; ++i) {
            stages_.insert(stages_.end(), {Stage::sizes, Stage::collapses, Stage::moves});
        }
        stages_.insert(stages_.end(), last_flips, Stage::flips);
        next_stage_ = 0;
        const double angle = sweeps == 0 ? flip_angle : sweep_angle;
        flatness_ = sweeps > 0 && !keeps()
                        ? -1.0
                        : std::cos(keeps() ? std::min(angle, dsc::remesh::crease_angle) : angle);
    }

    dsc::remesh::Lengths set_lengths(const dsc::hooks::StepContext& step,
                                     dsc::hooks::RefinementRequests& out) {
        const dsc::remesh::Wish wish{params_.vertices,
                                     params_.edge_length * step.to_normalised.scale,
                                     params_.thin_parts, params_.detail};
        const dsc::remesh::Lengths lengths = sizing_.lengths(
            step, mesh_, wish, std::pow(too_many_factor, static_cast<double>(too_many_)));
        allowed_ = wish.edge_length > 0.0
                       ? 0.0
                       : sizing_.allowance() * dsc::remesh::Sizing::budget(wish, step.cloud);
        if (lengths.each.empty()) {
            out.target_length = lengths.everywhere;
        } else {
            out.target_lengths.assign(lengths.each.begin(), lengths.each.end());
        }
        return lengths;
    }

    // True if it requested anything.
    bool ask(Stage stage, const dsc::remesh::Lengths& lengths,
             dsc::hooks::RefinementRequests& out) {
        if (stage == Stage::sizes) edits_.split(mesh_, lengths, out.split_edges);
        if (stage == Stage::sizes || stage == Stage::collapses)
            edits_.collapse(mesh_, lengths, keeps(), out.collapse_edges);
        edits_.flip(mesh_, flatness_, out.flip_edges);
        const bool edits =
            !out.split_edges.empty() || !out.collapse_edges.empty() || !out.flip_edges.empty();
        // A surface that needs no edit at the beginning of a sweep is finished, and is not smoothed
        // either.
        if (stage == Stage::sizes && !edits) next_stage_ = stages_.size();
        if (stage == Stage::moves) edits_.move(mesh_, lengths, out.move_vertices);
        return edits || !out.move_vertices.empty();
    }

    bool keeps() const { return 3 * step_ >= last_step_; }

    Params params_;
    // Saved.
    std::uint64_t refinements_ = 0;  // number of refinements begun
    std::uint64_t step_ = 0;         // step of the last refinement
    std::uint64_t last_step_ = 0;    // last step of the run
    std::uint64_t too_many_ = 0;     // refinements with more vertices afterwards than allowed
    double allowed_ = 0.0;           // allowed vertices after the last refinement; 0: no limit

    // State of the current refinement.
    std::vector<Stage> stages_;
    std::size_t next_stage_ = 0;
    double flatness_ = 0.0;

    // Kept between calls to reuse their memory.
    dsc::remesh::EdgeMesh mesh_;
    dsc::remesh::Edits edits_;
    dsc::remesh::Sizing sizing_;
};

}  // namespace

DSC_PLUGIN("remesh", DSC_VERSION, "BSD-3-Clause",
           "Remeshing of the interface to edges of one length") {
    registrar.add<Remesh>("remesh", "splits, collapses and flips interface edges until their "
                                    "length suits the number of points of the cloud");
}
