// Runs the schedule of an experiment: steps, refinements, figures, checkpoints.
#include "dsc/run/simulation.hpp"

#include <dsc/base/error.hpp>
#include <dsc/base/state.hpp>
#include <dsc/kernel/deformer.hpp>
#include <dsc/run/repair_policy.hpp>

#include "initial_complex.hpp"
#include "offered_rescue.hpp"
#include "refinement.hpp"
#include "refinement_watch.hpp"
#include "revocable_calls.hpp"
#include "saved_run.hpp"
#include "step_contexts.hpp"
#include "step_data.hpp"
#include "step_figures.hpp"

namespace dsc::run {
namespace {

/// Number of vertices per block of evaluate(). Constant, so that the blocks do not depend on the
/// number of threads.
constexpr std::size_t evaluated_block = 256;
/// A series stalls if less than this fraction of the wanted motion was made in this many steps in a
/// row.
constexpr unsigned stall_steps = 5;
constexpr double stall_ratio = 0.01;
/// Mean speed, in current mean edges, below which vertices count as arrived (as in the kernel), so
/// the series cannot stall.
constexpr double stall_speed = 1e-4;

class Simulation {
public:
    Simulation(const Experiment& experiment, Strategies& strategies,
               const cloud::TargetCloud* cloud, const SimulationOptions& options)
        : experiment_(experiment),
          strategies_(strategies),
          cloud_(cloud),
          options_(options),
          serial_(1),
          workers_(options.workers != nullptr ? *options.workers : serial_),
          planned_(planned_steps(experiment)),
          observer_names_(observer_names(experiment)),
          resumed_(options.resume),
          deformer_(
              options.resume.empty()
                  ? kernel::Deformer(initial_complex(experiment, strategies, cloud, options.cancel,
                                                     workers_, result_.totals),
                                     {}, &workers_)
                  : kernel::Deformer::load(resumed_, {}, &workers_)),
          watch_(experiment, &strategies),
          data_(deformer_, {experiment.seed, cloud}, workers_),
          calls_(options.cancel),
          contexts_(data_, strategies, cloud, planned_, calls_.token()) {
        // Every step asks again. Asked here too, an improvement with invalid answers ends the run
        // before its first step.
        strategies_.improvement->topology_limits();
        strategies_.improvement->flatness();
        result_.totals.repair_class_names = strategies_.improvement->repair_classes();
    }

    SimulationResult execute() {
        const OfferedRescue offered(options_, [this] { report_failure(); });
        try {
            options_.resume.empty() ? begin() : go_on();
            while (place_.item < experiment_.schedule.size() && !over_) series();
            if (stopped_) {
                checkpoint();
                result_.totals.status = Status::cancelled;
            }
            finish();
        } catch (const StrategyError&) {
            report_failure();
            throw;
        }
        return std::move(result_);
    }

private:
    void report_failure() const {
        if (options_.on_strategy_failure)
            options_.on_strategy_failure(deformer_.complex().to_mesh(), deformer_.step_count());
    }

    hooks::StepContext make_velocity_context() {
        const Timed timed(result_.totals.seconds.velocity);
        return contexts_.for_velocity(deformer_.step_count() + 1);
    }

    hooks::StepContext make_observer_context(const hooks::Observer& observer) {
        return contexts_.for_observer(observer, deformer_.step_count());
    }

    void refresh_view() {
        const Timed timed(result_.totals.seconds.velocity);
        data_.refresh();
    }

    void begin() {
        refresh_view();
        for (const auto& observer : strategies_.observers)
            observer->begin(make_observer_context(*observer));
        StepMetrics row;
        measure_row(row);
        result_.totals.volume_initial = row.volume;
        // The columns of the observers are known only after the first step, so row 0 does not
        // contain their figures.
        publish(row);
    }

    void finish() {
        RunTotals& totals = result_.totals;
        totals.target_length = deformer_.target_length();
        totals.refinement_items = watch_.figures();
        for (std::size_t i = 0; i < strategies_.observers.size(); ++i) {
            hooks::Observer& observer = *strategies_.observers[i];
            totals.observers.emplace_back(observer_names_[i],
                                          observer.end(make_observer_context(observer)));
        }
        std::vector<mesh::VertexId> ids;
        result_.mesh = deformer_.complex().to_mesh(&ids);
        result_.attributes = attributes_at(deformer_, ids);
        result_.surface = surface::extract_interface(result_.mesh);
    }

    /// Runs the schedule from `place_` on; afterwards `place_` is where the run continues.
    void series() {
        const Series& item = experiment_.schedule[place_.item];
        hooks::RefinementPolicy* refinement = strategies_.refinements[place_.item].get();
        if (calls_.stop_asked()) return stop();
        const bool owned = refinement != nullptr && refinement->owns_sizing();
        size_edits_ = !owned;
        quality_floor_ = owned ? std::optional(kernel::refinement_floor) : std::nullopt;
        if (!item.steps) {
            if (watch_.comes_too_late(place_.item)) {
                skip();
            } else if (!refine(*refinement)) {
                return stop();
            }
            return next_item();
        }
        if (place_.steps == 0) result_.totals.status = Status::max_steps;
        while (place_.steps < *item.steps || place_.refining != 0) {
            if (calls_.stop_asked()) return stop();
            creases_ = creases(refinement);
            if (place_.refining == 0) {
                const std::optional<bool> slow = advance();
                if (!slow) return stop();
                place_.quiet = *slow ? place_.quiet + 1 : 0;
                ++place_.steps;
                if (over_) break;
            }
            const bool due = item.every && place_.steps % *item.every == 0;
            if (due && !refine(*refinement)) return stop();
            if (item.until && strategies_.velocity->finished()) {
                result_.totals.status = Status::converged;
                break;
            }
            if (place_.stuck >= stall_steps) {
                result_.totals.status = Status::stalled;
                break;
            }
            if (experiment_.stop && place_.quiet >= experiment_.stop->patience) {
                result_.totals.status = Status::converged;
                break;
            }
            if (options_.checkpoint_every > 0 &&
                deformer_.step_count() % options_.checkpoint_every == 0)
                checkpoint();
        }
        next_item();
    }

    /// What the kernel may do and whom it asks, until the context ends.
    kernel::RepairPolicy policy(const hooks::StepContext& context) const {
        kernel::RepairPolicy policy = repair_policy(*strategies_.improvement, context);
        policy.size_edits = size_edits_;
        policy.quality_floor = quality_floor_;
        policy.creases = creases_;
        return policy;
    }

    std::optional<repair::CreaseRule> creases(const hooks::RefinementPolicy* refinement) const {
        return stricter(strategies_.velocity->keep_creases(),
                        refinement != nullptr ? refinement->keep_creases() : std::nullopt);
    }

    void next_item() { place_ = {.item = place_.item + 1}; }

    /// Saves everything on which the run depends: the complex, the strategies' states, and the
    /// progress.
    void checkpoint() {
        if (!options_.on_checkpoint || deformer_.step_count() == 0) return;
        StateWriter out;
        deformer_.save(out);
        out.value(place_);
        data_.history().save(out);
        watch_.save(out);
        save(out, result_.totals);
        save(out, strategies_, calls_.states_before());
        options_.on_checkpoint(out.take(), deformer_.step_count());
    }

    void go_on() {
        resumed_.value(place_);
        data_.history().load(resumed_);
        watch_.load(resumed_);
        load(resumed_, result_.totals);
        load(resumed_, strategies_);
        refresh_view();
        over_ = data_.view().vertex_count() == 0;
    }

    /// Makes one step; true if its largest speed was below the stop criterion. Empty if the step
    /// was discarded, because a strategy was told to stop.
    std::optional<bool> advance() {
        hooks::StepContext context = make_velocity_context();
        StepMetrics row;
        const std::optional<double> asked = velocities(context, row);
        if (!asked) return std::nullopt;
        context.cancel = nullptr;  // from here on the step is made to its end
        const surface::SurfaceView& view = data_.view();
        const double mean_edge = view.mean_edge;
        data_.history().begin_step(view);
        const kernel::StepReport report =
            deformer_.step(view.vertex_ids, displacements_, policy(context));
        data_.history().end_step(deformer_.not_arrived());
        const double came_about = distance_gone(deformer_.complex(), view, displacements_);
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
        for (const kernel::OperationCounts& counts : report.operations)
            row.committed += counts.committed;
        row.events = report.events.size();
        measure_row(row);
        observe(row);
        publish(row);

        const bool moving = row.mean_speed > stall_speed * mean_edge;
        place_.stuck = moving && came_about < stall_ratio * *asked ? place_.stuck + 1 : 0;
        if (view.vertex_count() == 0) over_ = true;
        return experiment_.stop && row.max_speed < experiment_.stop->speed * mean_edge;
    }

    /// Evaluates all displacements; returns the sum of the wanted lengths over the movable
    /// vertices. Empty if the answers are discarded.
    std::optional<double> velocities(const hooks::StepContext& context, StepMetrics& row) {
        const Timed timed(result_.totals.seconds.velocity);
        const std::size_t count = data_.view().vertex_count();
        displacements_.assign(count, Vec3::Zero());
        hooks::VelocityField& velocity = *strategies_.velocity;
        hooks::Attributes attributes;
        const bool answered = calls_.complete({&velocity}, [&] {
            velocity.advance(context);
            velocity.prepare(context);
            workers_.for_blocks(count, evaluated_block, [&](std::size_t first, std::size_t last) {
                velocity.evaluate({first, last},
                                  std::span(displacements_).subspan(first, last - first));
            });
            velocity.publish(attributes);
        });
        if (!answered) return std::nullopt;
        set_attributes(deformer_, data_.view(), attributes);
        return measure_speeds(data_.view(), displacements_, row);
    }

    /// Runs the passes of a refinement, each on a fresh view, until it requests no change of the
    /// mesh. False if a pass was discarded, because a strategy was told to stop; a later call
    /// begins with this pass.
    bool refine(hooks::RefinementPolicy& refinement) {
        const Timed timed(result_.totals.seconds.refine);
        const bool sampling = refinement.needs_sampling();
        const unsigned passes = refinement.passes();
        if (place_.refining == 0) {
            place_.refining = 1;
            ++result_.totals.refinements;
            watch_.begin(deformer_.complex().next_birth());
        }
        hooks::VelocityField& velocity = *strategies_.velocity;
        for (bool asked = true; place_.pass < passes && asked; ++place_.pass) {
            hooks::StepContext context =
                contexts_.for_refinement(refinement, sampling, deformer_.step_count());
            hooks::StepContext of_velocity = context;
            of_velocity.volume = nullptr;
            hooks::RefinementRequests requests;
            const bool answered = calls_.complete({&velocity, &refinement}, [&] {
                if (sampling) velocity.prepare(of_velocity);
                refinement.refine({context, sampling ? &velocity : nullptr, place_.pass}, requests);
            });
            if (!answered) return false;
            context.cancel = nullptr;
            set_fields(deformer_, data_.view(), requests);
            relabel(context, requests);
            kernel::RefineRequests wanted =
                kernel_requests(data_.view(), requests, refinement.owns_sizing());
            wanted.creases = creases(&refinement);
            const kernel::RefineReport report = deformer_.refine(wanted);
            result_.totals.crease_exceptions += report.crease_exceptions;
            result_.totals.refine_requested += report.requested;
            result_.totals.refine_committed += report.committed;
            result_.totals.refine_edits.add(report);
            watch_.add(report.requested, report.committed);
            asked = report.requested > 0 || !requests.relabel.empty();
            asked ? refresh_view() : data_.refresh_fields();
        }
        watch_.end(place_.item, deformer_.step_count(), data_.view());
        place_.refining = place_.pass = 0;
        return true;
    }

    /// Skips the refinement of the current item: no step would repair and move what it makes.
    void skip() {
        watch_.skip(place_.item);
        result_.totals.warnings.push_back(
            {"refinement.skipped",
             "schedule." + std::to_string(place_.item) + ".refine: the refinement '" +
                 experiment_.schedule[place_.item].refine.type +
                 "' comes after the last step and was skipped, because no step would repair and "
                 "move what it makes. Write {steps: N} after it, or remove it."});
    }

    void relabel(const hooks::StepContext& context, const hooks::RefinementRequests& requests) {
        if (requests.relabel.empty()) return;
        std::vector<mesh::TetId> tets;
        std::vector<mesh::Label> labels;
        for (const auto& [tet, label] : requests.relabel) {
            tets.push_back(tet);
            labels.push_back(static_cast<mesh::Label>(label));
        }
        std::vector<kernel::Event> events;
        const std::size_t committed = deformer_.relabel(tets, labels, policy(context), events);
        result_.totals.refine_requested += tets.size();
        result_.totals.refine_committed += committed;
        watch_.add(tets.size(), committed);
        for (const kernel::Event& event : events) {
            result_.totals.events.add(event.kind);
            tell(event);
        }
    }

    void measure_row(StepMetrics& row) {
        const Timed timed(result_.totals.seconds.measure);
        row.refinement = watch_.row(deformer_.step_count(), data_.view());
        measure_state(deformer_.complex(), data_.view(), cloud_, data_.nearest(), workers_, row);
    }

    void observe(StepMetrics& row) {
        if (strategies_.observers.empty()) return;
        const Timed timed(result_.totals.seconds.measure);
        const hooks::StepFigures figures{row.step, row.interface_vertices, row.tets, row.volume,
                                         row.min_tet_quality};
        for (std::size_t i = 0; i < strategies_.observers.size(); ++i) {
            const std::string prefix = "observers." + observer_names_[i] + ".";
            hooks::Observer& observer = *strategies_.observers[i];
            const hooks::StepContext context = make_observer_context(observer);
            for (const auto& [figure, value] : observer.step(context, figures)) {
                row.observers.emplace_back(prefix + figure, value);
            }
        }
    }

    void publish(const StepMetrics& row) {
        result_.last = row;
        if (options_.on_step) options_.on_step(row, planned_);
        if (!options_.on_state) return;
        const Timed timed(result_.totals.seconds.io);
        options_.on_state(contexts_.make(row.step), deformer_.complex());
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

    void stop() {
        stopped_ = true;
        over_ = true;
    }

    const Experiment& experiment_;
    Strategies& strategies_;
    const cloud::TargetCloud* cloud_;
    const SimulationOptions& options_;
    Workers serial_;
    Workers& workers_;
    std::uint64_t planned_;
    std::vector<std::string> observer_names_;
    SimulationResult result_;
    SchedulePlace place_;
    StateReader resumed_;
    kernel::Deformer deformer_;
    RefinementWatch watch_;
    StepData data_;
    RevocableCalls calls_;
    StepContexts contexts_;
    std::vector<Vec3> displacements_;
    bool size_edits_ = true;  // these three: of the current series, for the policy
    std::optional<double> quality_floor_;
    std::optional<repair::CreaseRule> creases_;
    bool stopped_ = false;  // stopped before the end of the schedule
    bool over_ = false;
};

}  // namespace

std::uint64_t planned_steps(const Experiment& experiment) {
    std::uint64_t steps = 0;
    for (const Series& item : experiment.schedule) steps += item.steps.value_or(0);
    return steps;
}

SimulationResult simulate(const Experiment& experiment, Strategies& strategies,
                          const cloud::TargetCloud* cloud, const SimulationOptions& options) {
    return Simulation(experiment, strategies, cloud, options).execute();
}

}  // namespace dsc::run
