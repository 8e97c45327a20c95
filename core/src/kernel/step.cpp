// The parts of a step: motion and repair in turn, then topology (method.md, sections 5, 6 and 8).
#include <algorithm>
#include <atomic>
#include <utility>

#include <dsc/mesh/date_ranks.hpp>

#include "kernel/deformer_state.hpp"

namespace dsc::kernel {
// Replaces the dates by their ranks, if necessary. The clock advances by one at each vertex that is
// tried: a surface of 50,000 vertices reaches this limit after some 5,000 steps.
void Deformer::State::renew_dates() {
    constexpr std::uint32_t limit = 1U << 31U;
    if (complex.clock() < limit) return;
    queues.renew(complex.renew_dates());
    bench.forget_dates();
    foresights.forget_dates();
    star_loop.forget_dates();
}

void Deformer::State::begin_step(std::span<const VertexId> vertices,
                                 std::span<const Vec3> displacements, const RepairPolicy& policy,
                                 StepReport& report) {
    apply_limits(policy.flatness, policy.creases);
    bench.limits.set_floor(policy.quality_floor.value_or(options.quality_floor));
    ++step;
    renew_dates();
    destinations.clear();
    // For the topology stage.
    complex.start_watch();
    last_requests.clear();
    outcomes.clear();
    bench.sums = {};
    bench.crease_exceptions = 0;
    const Vec3 margin = Vec3::Constant(2.0 * length);
    const Destinations::Sent sent =
        destinations.send(vertices, displacements,
                          {complex.box().low + margin, complex.box().high - margin}, workers);
    report.requested += sent.requested;
    report.clamped += sent.clamped;
}

// The tet of a refused request waits until its neighbourhood changes.
void Deformer::State::record(std::uint32_t i, Outcome outcome, std::uint32_t date,
                             StepReport& report) {
    outcomes[i] = outcome;
    const repair::Request& request = requests[i];
    report.operations[static_cast<std::size_t>(request.operation)].add(outcome);
    report
        .repair_classes[std::min<std::size_t>(request.repair_class, repair::repair_class_limit - 1)]
        .add(outcome);
    if (!outcome.refused()) return;
    if (outcome != Refusal::stale && request.tet != mesh::none)
        queues.fail(request.tet, request.birth_date, date);
}

// Consecutive requests that smooth different vertices may run in parallel.
struct Deformer::State::Smoothing {
    using Note = Refusal;

    State& state;
    std::uint32_t first;  // request of vertex 0
    StepReport& report;

    const repair::Request& request(std::size_t i) const { return state.requests[first + i]; }
    void prefetch(std::size_t i, VertexId v) const {
        state.bench.prefetch_memory(v);
        prefetch_line(&request(i));
    }
    static bool decide(Note& note, Outcome outcome) {
        note = outcome.reason();
        return !outcome.refused();
    }
    bool ready(std::size_t i, Note& note) const {
        return decide(note, may_smooth(state.bench, state.smoothed[i], request(i).accept_above));
    }
    bool attempt(std::size_t i, StarScratch& scratch, std::uint32_t date, Note& note) const {
        const VertexId v = state.smoothed[i];
        const float accept_above = request(i).accept_above;
        const Outcome outcome =
            plan_laplacian(state.complex, state.bench.limits, v, accept_above, scratch);
        if (outcome.refused()) {
            state.bench.remember(v, Workbench::Smoother::laplacian, accept_above, outcome.reason(),
                                 date);
        }
        return decide(note, outcome);
    }
    void settle(std::uint32_t i, std::uint32_t date, Note note) const {
        state.record(first + i, note, date, report);
    }
};

// Whether the request is certainly a Laplacian smoothing at its turn, whatever other smoothings do
// before it.
bool Deformer::State::plain_smoothing(const repair::Request& request) const {
    const VertexId v = request.vertices[0];
    const TetId t = request.tet;
    return request.operation == repair::Operation::smooth_laplacian && v != mesh::none &&
           request.vertices[1] == mesh::none && request.only_below > 1.0F && t != mesh::none &&
           t < complex.tet_slots() && complex.tet_alive(t) &&
           complex.birth_date(t) == request.birth_date && mesh::has_vertex(complex.tet(t), v);
}

// How many requests from `first` on are certainly Laplacian smoothings; writes their vertices.
std::size_t Deformer::State::find_smoothings(std::size_t first) {
    smoothed.clear();
    if (!plain_smoothing(requests[first])) return 0;
    smoothed.resize(requests.size() - first);
    std::atomic<std::size_t> count{smoothed.size()};
    const auto look = [this, first, &count](std::size_t begin, std::size_t end) {
        constexpr std::size_t ahead = 16;
        const bool fetch = complex.exceeds_caches();
        end = std::min(end, count.load(std::memory_order_relaxed));
        for (std::size_t i = begin; i < end; ++i) {
            if (fetch && i + ahead < end && requests[first + i + ahead].tet < complex.tet_slots())
                complex.prefetch(requests[first + i + ahead].tet);
            if (!plain_smoothing(requests[first + i])) {
                std::size_t known = count.load(std::memory_order_relaxed);
                while (i < known &&
                       !count.compare_exchange_weak(known, i, std::memory_order_relaxed)) {
                }
                return;
            }
            smoothed[i] = requests[first + i].vertices[0];
        }
    };
    constexpr std::size_t block = 4096;  // requests that a thread looks at
    for_blocks(workers, smoothed.size(), block, look);
    smoothed.resize(count);
    return count;
}

std::size_t Deformer::State::smooth_from(std::size_t first, StepReport& report) {
    if (find_smoothings(first) == 0) return 0;
    bench.provide_memory();
    Smoothing action{*this, static_cast<std::uint32_t>(first), report};
    star_loop.run(smoothed, workers, action);
    return smoothed.size();
}

void Deformer::State::repair(const RepairPolicy& policy, unsigned round, bool settled,
                             StepReport& report) {
    const auto dirty = queues.next_round(workers);
    complex.watch(queues.woken());
    requests.clear();
    policy.propose(
        repair::RepairRound{complex, dirty, destinations.blocked(), last_requests, outcomes, length,
                            policy.flatness, round, settled, policy.size_edits,
                            bench.lengths != nullptr ? std::span<const double>(*bench.lengths)
                                                     : std::span<const double>()},
        requests);
    queues.forget_round();
    outcomes.resize(requests.size());
    foresights.start(requests, workers);
    for (std::size_t i = 0; i < requests.size();) {
        const std::size_t done = smooth_from(i, report);
        i += done;
        if (done > 0) continue;
        const Outcome outcome = execute(bench, requests[i], foresights.of(i));
        record(static_cast<std::uint32_t>(i), outcome, complex.clock(), report);
        ++i;
    }
    std::swap(last_requests, requests);
}

// The remaining motion is dropped if it no longer falls, or if nothing can be tried any more
// (method.md, section 5.3).
class Deformer::State::Stall {
public:
    explicit Stall(const DeformerOptions& options) : options_(options) {}

    /// After the passes of a round: `left` is the remaining distance, `tried` the number of
    /// attempted moves.
    bool reached(double left, std::size_t tried, bool done) {
        if (left < best_left_ * (1.0 - options_.stall_ratio)) {
            best_left_ = left;
            slow_rounds_ = 0;
            return false;
        }
        return !done &&
               (++slow_rounds_ >= options_.stall_rounds || (tried == 0 && ++idle_rounds_ > 1));
    }

private:
    const DeformerOptions& options_;
    double best_left_ = INFINITY;
    unsigned idle_rounds_ = 0;
    unsigned slow_rounds_ = 0;
};

// Returns the sum of the remaining distances.
double Deformer::State::make_moves() {
    // The test that loses wake-ups counts them, which one thread must do.
    const PassOptions passes{options.free_path, options.audit,
                             options.drop_wake_up == 0 ? workers : nullptr};
    const double left = destinations.pass(bench.limits, passes);
    // A second pass, because neighbours that moved make room for each other.
    return destinations.done() ? left : destinations.pass(bench.limits, passes);
}

void Deformer::State::move_and_repair(const RepairPolicy& policy, StepReport& report) {
    Stall stall(options);
    for (unsigned round = 0; round < options.max_rounds; ++round) {
        const Stopwatch moving;
        const double left = make_moves();
        const std::size_t tried = destinations.take_tried();
        report.move_time += moving.elapsed();
        ++report.rounds;
        if (stall.reached(left, tried, destinations.done())) destinations.drop_remaining(report);
        const bool settled = destinations.done();
        if (!policy.propose) {
            if (settled) break;
            continue;
        }
        const Timed repairing(report.repair_time);
        repair(policy, round, settled, report);
        if (settled && destinations.done()) break;
    }
    destinations.drop_remaining(report);
}

void Deformer::State::change_topology(const RepairPolicy& policy, StepReport& report) {
    const Timed timed(report.repair_time);
    topology.run(step, complex.watched(), policy.topology, policy.select, report.events, workers);
    if (policy.topology.thickness > 0.0) {
        topology.remove_small_components(step, destinations.near_collapses(),
                                         policy.topology.min_component, report.events);
    }
    fields.settle();
}

void Deformer::State::sum_up(StepReport& report) const {
    for (const Event& event : report.events) report.event_counts.add(event.kind);
    report.crease_exceptions = bench.crease_exceptions;
    report.edit_distance = bench.sums.distance;
    report.edit_volume = bench.sums.volume;
    report.relabelled_volume = bench.sums.relabelled;
    report.arrived =
        report.requested > destinations.stranded() ? report.requested - destinations.stranded() : 0;
}

}  // namespace dsc::kernel
