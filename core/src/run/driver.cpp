#include <algorithm>
#include <dsc/base/error.hpp>
#include <dsc/base/state.hpp>
#include <dsc/kernel/deformer.hpp>
#include <dsc/mesh/adopt.hpp>
#include <dsc/run/driver.hpp>
#include <dsc/run/mesh_files.hpp>

#include "saved_run.hpp"
#include "step_figures.hpp"
#include "stopwatch.hpp"

namespace dsc::run {
namespace {

/// Vertices a block of evaluate() has. Fixed, so that the split never depends on the number of threads.
constexpr std::size_t evaluated_block = 256;
/// A series stalls when for this many steps less than this part of the asked motion came about.
constexpr unsigned stall_steps = 5;
constexpr double stall_ratio = 0.01;
/// Mean speed, in mean edges, below which a vertex counts as arrived (as in the kernel) and nothing can stall.
constexpr double stall_speed = 1e-4;

void require_inside(const cloud::TargetCloud& cloud, const Box3& box) {
    for (std::size_t i = 0; i < cloud.size(); ++i) {
        if (box.contains(cloud[i])) continue;
        throw GeometryError(
            "cloud.outside_box",
            "point " + std::to_string(i + 1) +
                " of the cloud lies outside the box of the initial mesh; lower input.normalize.scale or "
                "make the initial mesh larger");
    }
}

class Run {
public:
    Run(const Experiment& experiment, Strategies& strategies, const cloud::TargetCloud* cloud,
        const DriveOptions& options)
        : experiment_(experiment),
          strategies_(strategies),
          cloud_(cloud),
          options_(options),
          serial_(1),
          workers_(options.workers != nullptr ? *options.workers : serial_),
          planned_(planned_steps(experiment)),
          resumed_(options.resume),
          deformer_(options.resume.empty() ? kernel::Deformer(initial_complex(), {}, &workers_)
                                           : kernel::Deformer::load(resumed_, {}, &workers_)) {
        policy_.propose = [this](const mesh::RepairRound& round, std::vector<mesh::Request>& out) {
            strategies_.improvement->propose(*context_, round, out);
        };
        policy_.select = [this](std::span<const mesh::TopologyCandidate> candidates,
                                std::span<std::uint8_t> accept) {
            strategies_.improvement->select(*context_, candidates, accept);
        };
        policy_.topology = strategies_.improvement->topology_limits();
        policy_.flatness = strategies_.improvement->flatness();
        result_.totals.repair_class_names = strategies_.improvement->repair_classes();
    }

    DriveResult execute() {
        try {
            options_.resume.empty() ? begin() : go_on();
            while (place_.item < experiment_.schedule.size() && !over_) series();
            if (stopped_) {
                checkpoint();
                result_.totals.status = Status::cancelled;
            }
            finish();
        } catch (const StrategyError&) {
            if (options_.on_strategy_failure)
                options_.on_strategy_failure(deformer_.complex().to_mesh(), deformer_.step_count());
            throw;
        }
        return std::move(result_);
    }

private:
    mesh::Complex initial_complex() {
        hooks::InitialMeshContext context;
        context.cloud = cloud_;
        context.seed = experiment_.seed;
        context.cancel = options_.cancel;
        const MeshFiles files;
        context.files = &files;
        context.workers = &workers_;
        const mesh::TetMesh mesh = strategies_.initial_mesh->build(context);
        result_.totals.initial_mesh = strategies_.initial_mesh->figures();
        result_.totals.initial_mesh_seconds = strategies_.initial_mesh->seconds();
        result_.totals.warnings = strategies_.initial_mesh->warnings();
        const CpuTimed timed(result_.totals.seconds.adopt);
        mesh::Complex complex =
            mesh::adopt(mesh, "initial mesh '" + experiment_.initial_mesh.type + "'", &result_.totals.adopted,
                        strategies_.improvement->topology_limits().min_component);
        if (cloud_ != nullptr) require_inside(*cloud_, complex.box());
        return complex;
    }

    /// `step`: as in metrics.csv and events.jsonl, the first one is 1.
    hooks::StepContext make_context(std::uint64_t step) const {
        return {.step = step,
                .surface = view_,
                .cloud = cloud_,
                .nearest = nearest_,
                .target_length = deformer_.target_length(),
                .box = deformer_.complex().box(),
                .to_normalised = cloud_ != nullptr ? cloud_->transform() : cloud::Transform{},
                .seed = experiment_.seed,
                .instance = 0,
                .cancel = options_.cancel,
                .workers = &workers_};
    }

    /// The nearest points serve the velocity of the next step and the figures of this one.
    void refresh_view() {
        const Timed timed(result_.totals.seconds.velocity);
        surface::build_view(deformer_.complex(), view_, &workers_);
        if (cloud_ == nullptr) return;
        nearest_.resize(view_.vertex_count());
        workers_.for_blocks(nearest_.size(), evaluated_block, [this](std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i) nearest_[i] = cloud_->search().nearest(view_.positions[i]);
        });
    }

    void begin() {
        refresh_view();
        const hooks::StepContext context = make_context(deformer_.step_count());
        for (const auto& observer : strategies_.observers) observer->begin(context);
        StepMetrics row;
        measure_row(row);
        result_.totals.volume_initial = row.volume;
        // The columns of the observers are known after the first step only: row 0 has none of their figures.
        publish(row);
    }

    void finish() {
        RunTotals& totals = result_.totals;
        totals.target_length = deformer_.target_length();
        const hooks::StepContext context = make_context(deformer_.step_count());
        for (std::size_t i = 0; i < strategies_.observers.size(); ++i) {
            totals.observers.emplace_back(experiment_.observers[i].type,
                                          strategies_.observers[i]->end(context));
        }
        result_.mesh = deformer_.complex().to_mesh();
        result_.surface = surface::extract_interface(result_.mesh);
    }

    /// What the schedule has at `place_`, from there on; leaves `place_` where the run is to go on.
    void series() {
        const Series& item = experiment_.schedule[place_.item];
        hooks::RefinementPolicy* refinement = strategies_.refinements[place_.item].get();
        if (stop_asked()) return stop();
        if (!item.steps) {
            refine(*refinement);
            return next_item();
        }
        if (place_.steps == 0) result_.totals.status = Status::max_steps;
        while (place_.steps < *item.steps) {
            if (stop_asked()) return stop();
            const bool slow = advance();
            place_.quiet = slow ? place_.quiet + 1 : 0;
            ++place_.steps;
            if (over_) break;
            if (item.every && place_.steps % *item.every == 0) refine(*refinement);
            if (place_.stuck >= stall_steps) {
                result_.totals.status = Status::stalled;
                break;
            }
            if (experiment_.stop && place_.quiet >= experiment_.stop->patience) {
                result_.totals.status = Status::converged;
                break;
            }
            if (options_.checkpoint_every > 0 && deformer_.step_count() % options_.checkpoint_every == 0) checkpoint();
        }
        next_item();
    }

    void next_item() { place_ = {.item = place_.item + 1}; }

    /// What a run depends on: the strategies' state, and how far it has come.
    void checkpoint() {
        if (!options_.on_checkpoint || deformer_.step_count() == 0) return;
        StateWriter out;
        deformer_.save(out);
        out.value(place_);
        save(out, result_.totals);
        save(out, strategies_);
        options_.on_checkpoint(out.take(), deformer_.step_count());
    }

    void go_on() {
        resumed_.value(place_);
        load(resumed_, result_.totals);
        load(resumed_, strategies_);
        refresh_view();
        over_ = view_.vertex_count() == 0;
    }

    /// One step; true if its largest speed was below the stop criterion.
    bool advance() {
        const hooks::StepContext context = make_context(deformer_.step_count() + 1);
        context_ = &context;
        StepMetrics row;
        const double asked = velocities(context, row);
        const double mean_edge = view_.mean_edge;
        const kernel::StepReport report = deformer_.step(view_.vertex_ids, displacements_, policy_);
        context_ = nullptr;
        const double came_about = achieved();
        result_.totals.add(report);
        for (const kernel::Event& event : report.events) tell(event);
        tell_repairs(report);
        refresh_view();
        row.step = deformer_.step_count();
        row.rounds = report.rounds;
        row.requested = report.requested;
        row.arrived = report.arrived;
        row.clamped = report.clamped;
        row.dropped_motion = report.dropped_motion;
        row.edit_volume = report.edit_volume;
        row.relabelled_volume = report.relabelled_volume;
        for (const kernel::OperationCounts& counts : report.operations) row.committed += counts.committed;
        row.events = report.events.size();
        measure_row(row);
        observe(row);
        publish(row);

        const bool moving = row.mean_speed > stall_speed * mean_edge;
        place_.stuck = moving && came_about < stall_ratio * asked ? place_.stuck + 1 : 0;
        if (view_.vertex_count() == 0) over_ = true;
        return experiment_.stop && row.max_speed < experiment_.stop->speed * mean_edge;
    }

    /// Asks the velocity for all displacements; returns the summed length that movable vertices want to go.
    double velocities(const hooks::StepContext& context, StepMetrics& row) {
        const Timed timed(result_.totals.seconds.velocity);
        const std::size_t count = view_.vertex_count();
        displacements_.assign(count, Vec3::Zero());
        strategies_.velocity->prepare(context);
        workers_.for_blocks(count, evaluated_block, [&](std::size_t first, std::size_t last) {
            strategies_.velocity->evaluate({first, last},
                                           std::span(displacements_).subspan(first, last - first));
        });
        double sum = 0.0;
        std::size_t movable = 0;
        for (std::size_t i = 0; i < count; ++i) {
            if (view_.movable[i] == 0) continue;
            const double speed = displacements_[i].norm();
            sum += speed;
            row.max_speed = std::max(row.max_speed, speed);
            ++movable;
        }
        row.mean_speed = movable == 0 ? 0.0 : sum / static_cast<double>(movable);
        return sum;
    }

    /// Summed length that the vertices of the view have gone since it was taken; one that an edit removed counts with
    /// what it asked for.
    double achieved() const {
        const mesh::Complex& complex = deformer_.complex();
        double sum = 0.0;
        for (std::size_t i = 0; i < view_.vertex_count(); ++i) {
            if (view_.movable[i] == 0) continue;
            const mesh::VertexId v = view_.vertex_ids[i];
            const bool there = complex.vertex_alive(v) && complex.birth(v) == view_.births[i];
            sum += there ? (complex.position(v) - view_.positions[i]).norm() : displacements_[i].norm();
        }
        return sum;
    }

    void refine(hooks::RefinementPolicy& refinement) {
        const Timed timed(result_.totals.seconds.refine);
        const hooks::StepContext context = make_context(deformer_.step_count());
        strategies_.velocity->prepare(context);
        hooks::RefinementRequests requests;
        refinement.refine({context, strategies_.velocity.get()}, requests);
        ++result_.totals.refinements;
        relabel(context, requests);

        std::vector<std::array<mesh::VertexId, 3>> faces;
        for (const std::uint32_t f : requests.split_faces) {
            const auto& [a, b, c] = view_.faces[f];
            faces.push_back({view_.vertex_ids[a], view_.vertex_ids[b], view_.vertex_ids[c]});
        }
        std::vector<std::array<mesh::VertexId, 2>> edges;
        const auto add_edge = [&](std::uint32_t a, std::uint32_t b) {
            edges.push_back({view_.vertex_ids[a], view_.vertex_ids[b]});
        };
        for (const auto& [a, b] : requests.split_edges) add_edge(a, b);
        for (const auto& [a, b] : too_long(requests.sizing)) add_edge(a, b);
        const kernel::RefineReport report = deformer_.refine(faces, edges);
        result_.totals.refine_requested += report.requested;
        result_.totals.refine_committed += report.committed;
        refresh_view();
    }

    void relabel(const hooks::StepContext& context, const hooks::RefinementRequests& requests) {
        if (requests.relabel.empty()) return;
        std::vector<mesh::TetId> tets;
        std::vector<mesh::Label> labels;
        for (const auto& [tet, label] : requests.relabel) {
            tets.push_back(tet);
            labels.push_back(static_cast<mesh::Label>(label));
        }
        context_ = &context;
        std::vector<kernel::Event> events;
        result_.totals.refine_requested += tets.size();
        result_.totals.refine_committed += deformer_.relabel(tets, labels, policy_, events);
        context_ = nullptr;
        for (const kernel::Event& event : events) {
            result_.totals.count(event.kind);
            tell(event);
        }
    }

    /// Edges longer than the mean of the wanted lengths at their ends, each once, in ascending order.
    std::vector<std::array<std::uint32_t, 2>> too_long(const std::vector<double>& sizing) const {
        std::vector<std::array<std::uint32_t, 2>> edges;
        if (sizing.empty()) return edges;
        for (const auto& face : view_.faces) {
            for (std::size_t i = 0; i < 3; ++i) {
                const std::uint32_t a = face[i], b = face[(i + 1) % 3];
                const double length = (view_.positions[a] - view_.positions[b]).norm();
                if (length > 0.5 * (sizing[a] + sizing[b])) edges.push_back({std::min(a, b), std::max(a, b)});
            }
        }
        std::sort(edges.begin(), edges.end());
        edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
        return edges;
    }

    void measure_row(StepMetrics& row) {
        const Timed timed(result_.totals.seconds.measure);
        measure_state(deformer_.complex(), view_, cloud_, nearest_, workers_, row);
    }

    void observe(StepMetrics& row) {
        if (strategies_.observers.empty()) return;
        const Timed timed(result_.totals.seconds.measure);
        const hooks::StepContext context = make_context(deformer_.step_count());
        const hooks::StepFigures figures{row.step, row.interface_vertices, row.tets, row.volume,
                                         row.min_tet_quality};
        for (std::size_t i = 0; i < strategies_.observers.size(); ++i) {
            const std::string prefix = "observers." + experiment_.observers[i].type + ".";
            for (const auto& [figure, value] : strategies_.observers[i]->step(context, figures)) {
                row.observers.emplace_back(prefix + figure, value);
            }
        }
    }

    void publish(const StepMetrics& row) {
        result_.last = row;
        if (options_.on_step) options_.on_step(row, planned_);
        if (!options_.on_state) return;
        const Timed timed(result_.totals.seconds.io);
        options_.on_state(make_context(row.step), deformer_.complex());
    }

    void tell(const kernel::Event& event) const {
        if (options_.on_event) options_.on_event(event);
    }

    void tell_repairs(const kernel::StepReport& report) const {
        if (!options_.on_repairs) return;
        const std::vector<std::string>& names = result_.totals.repair_class_names;
        for (std::size_t i = 0; i < names.size(); ++i) {
            const kernel::OperationCounts& counts = report.repair_classes[i];
            if (counts.tried == 0) continue;
            options_.on_repairs({deformer_.step_count(), names[i], counts.tried, counts.committed});
        }
    }

    bool stop_asked() const {
        return (options_.cancel != nullptr && options_.cancel->cancelled()) ||
               (options_.out_of_time && options_.out_of_time());
    }

    void stop() {
        stopped_ = true;
        over_ = true;
    }

    const Experiment& experiment_;
    Strategies& strategies_;
    const cloud::TargetCloud* cloud_;
    const DriveOptions& options_;
    Workers serial_;
    Workers& workers_;
    std::uint64_t planned_;
    DriveResult result_;
    SchedulePlace place_;
    StateReader resumed_;
    kernel::Deformer deformer_;
    kernel::RepairPolicy policy_;
    surface::SurfaceView view_;
    std::vector<cloud::Neighbour> nearest_;
    std::vector<Vec3> displacements_;
    const hooks::StepContext* context_ = nullptr;  // of the step under way, for the policy
    bool stopped_ = false;  // before the end of the schedule
    bool over_ = false;
};

}  // namespace

std::uint64_t planned_steps(const Experiment& experiment) {
    std::uint64_t steps = 0;
    for (const Series& item : experiment.schedule) steps += item.steps.value_or(0);
    return steps;
}

DriveResult drive(const Experiment& experiment, Strategies& strategies, const cloud::TargetCloud* cloud,
                  const DriveOptions& options) {
    return Run(experiment, strategies, cloud, options).execute();
}

}  // namespace dsc::run
