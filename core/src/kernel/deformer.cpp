// A step: motion, repair and topology in turn (method.md, sections 5, 6 and 8).
#include <algorithm>
#include <chrono>
#include <cmath>

#include "kernel/deformer_state.hpp"

namespace dsc::kernel {
namespace {

using Clock = std::chrono::steady_clock;
double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

constexpr unsigned move_passes = 2;        // before a repair: neighbours that moved make room for each other
constexpr double worthwhile_pass = 0.1;    // fraction of the remaining distance by which a pass must advance the vertices

void count(const Event& event, repair::EventCounts& counts) {
    switch (event.kind) {
        case Event::Kind::merge: ++counts.merge; break;
        case Event::Kind::split: ++counts.split; break;
        case Event::Kind::handle_opened: ++counts.handle_opened; break;
        case Event::Kind::handle_closed: ++counts.handle_closed; break;
        case Event::Kind::vanished: ++counts.vanished; break;
        case Event::Kind::born: ++counts.born; break;
        case Event::Kind::unpinched: ++counts.unpinched; break;
    }
}

}  // namespace

std::string_view name(Event::Kind kind) {
    constexpr std::array<std::string_view, 7> names = {"merge",    "split", "handle_opened", "handle_closed",
                                                       "vanished", "born",  "unpinched"};
    return names[static_cast<std::size_t>(kind)];
}

void OperationCounts::add(repair::Refusal outcome) {
    ++tried;
    ++(outcome == Refusal::committed ? committed : refused[static_cast<std::size_t>(outcome)]);
}

OperationCounts& OperationCounts::operator+=(const OperationCounts& other) {
    tried += other.tried;
    committed += other.committed;
    for (std::size_t i = 0; i < refused.size(); ++i) refused[i] += other.refused[i];
    return *this;
}

void Deformer::State::begin(std::span<const VertexId> vertices, std::span<const Vec3> displacements, StepReport& report) {
    ++step;
    travels.clear();
    for (const TetId t : step_changes) noted[t] = false;
    step_changes.clear();
    last_requests.clear();
    outcomes.clear();
    bench.sums = {};
    bench.crease_exceptions = 0;
    const Vec3 low = complex.box().low.array() + 2.0 * length;
    const Vec3 high = complex.box().high.array() - 2.0 * length;
    for (std::size_t i = 0; i < vertices.size(); ++i) {
        const VertexId v = vertices[i];
        // In this order, so that a vertex without displacement is not even looked at.
        if (displacements[i].isZero(0.0) || !complex.movable(v)) continue;
        ++report.requested;
        const Vec3 wanted = complex.position(v) + displacements[i];
        const Vec3 inside = wanted.cwiseMax(low).cwiseMin(high);
        if (inside != wanted) ++report.clamped;
        travels.send(v, inside);
    }
}

// Collects for the topology stage what changed in this step, each tet once.
void Deformer::State::note_changes(std::span<const TetId> changed) {
    noted.resize(std::max(noted.size(), complex.tet_slots()), false);
    for (const TetId t : changed) {
        if (noted[t]) continue;
        noted[t] = true;
        step_changes.push_back(t);
    }
}

// The tet of a refused request waits until its neighbourhood changes.
void Deformer::State::record(std::uint32_t i, Refusal refusal, std::uint32_t date, StepReport& report) {
    outcomes[i] = {i, refusal};
    const repair::Request& request = requests[i];
    report.operations[static_cast<std::size_t>(request.operation)].add(refusal);
    report.repair_classes[std::min<std::size_t>(request.repair_class, repair::repair_class_limit - 1)].add(refusal);
    if (refusal == Refusal::committed) return;
    if (refusal != Refusal::stale && request.tet != mesh::none) queues.fail(request.tet, date);
}

// Consecutive requests that smooth different vertices may run in parallel.
struct Deformer::State::Smoothing {
    State& state;
    std::uint32_t first;  // request of vertex 0
    StepReport& report;

    const repair::Request& request(std::size_t i) const { return state.requests[first + i]; }
    bool decide(std::size_t i, Refusal refusal) const {
        state.outcomes[first + i].refusal = refusal;
        return refusal == Refusal::committed;
    }
    bool ready(std::size_t i) const {
        return decide(i, may_smooth(state.bench, request(i).vertices[0], request(i).accept_above));
    }
    bool attempt(std::size_t i, StarScratch& scratch) const {
        return decide(i, plan_laplacian(state.complex, state.bench.limits, request(i).vertices[0], request(i).accept_above, scratch));
    }
    void settle(std::uint32_t i, bool attempted, std::uint32_t date) const {
        const Refusal refusal = state.outcomes[first + i].refusal;
        if (attempted && refusal != Refusal::committed) {
            state.bench.remember(request(i).vertices[0], Workbench::Trial::laplacian, request(i).accept_above, refusal, date);
        }
        state.record(first + i, refusal, date, report);
    }
};

// Whether the request is certainly a Laplacian smoothing at its turn, whatever other smoothings do before it.
bool Deformer::State::plain_smoothing(const repair::Request& request) const {
    const VertexId v = request.vertices[0];
    const TetId t = request.tet;
    return request.operation == repair::Operation::smooth_laplacian && v != mesh::none && request.vertices[1] == mesh::none &&
           request.only_below > 1.0F && t != mesh::none && t < complex.tet_slots() && complex.tet_alive(t) &&
           complex.birth_date(t) == request.birth_date && mesh::has_vertex(complex.tet(t), v);
}

std::size_t Deformer::State::smooth_from(std::size_t first, StepReport& report) {
    smoothed.clear();
    for (std::size_t i = first; i < requests.size() && plain_smoothing(requests[i]); ++i) smoothed.push_back(requests[i].vertices[0]);
    Smoothing action{*this, static_cast<std::uint32_t>(first), report};
    star_loop.run(smoothed, workers, action);
    return smoothed.size();
}

void Deformer::State::repair(const RepairPolicy& policy, unsigned round, bool settled, StepReport& report) {
    const auto dirty = queues.next_round();
    note_changes(dirty);
    requests.clear();
    policy.propose(repair::RepairRound{complex, dirty, travels.blocked(), last_requests, outcomes, length, policy.flatness, round, settled, policy.size_edits,
                                     bench.lengths != nullptr ? std::span<const double>(*bench.lengths) : std::span<const double>()},
                   requests);
    outcomes.resize(requests.size());
    for (std::size_t i = 0; i < requests.size();) {
        const std::size_t done = smooth_from(i, report);
        i += done;
        if (done > 0) continue;
        const Refusal refusal = execute(bench, requests[i]);
        record(static_cast<std::uint32_t>(i), refusal, complex.clock(), report);
        ++i;
    }
    std::swap(last_requests, requests);
}

StepReport Deformer::State::advance(std::span<const VertexId> vertices, std::span<const Vec3> displacements, const RepairPolicy& policy) {
    StepReport report;
    apply_limits(policy.flatness, policy.creases);
    bench.limits.set_floor(policy.quality_floor.value_or(options.quality_floor));
    begin(vertices, displacements, report);
    const PassOptions passes{options.free_path, options.audit, workers};
    double best_left = INFINITY;
    unsigned idle_rounds = 0;
    unsigned slow_rounds = 0;
    for (unsigned round = 0; round < options.max_rounds; ++round) {
        auto start = Clock::now();
        double left = travels.pass(bench.limits, passes);
        for (unsigned again = 1; again < move_passes && !travels.done(); ++again) {
            const double before = left;
            left = travels.pass(bench.limits, passes);
            if (left > before * (1.0 - worthwhile_pass)) break;
        }
        const std::size_t tried = travels.take_tried();
        report.move_seconds += seconds_since(start);
        ++report.rounds;
        if (left < best_left * (1.0 - options.stall_ratio)) {
            best_left = left;
            slow_rounds = 0;
        } else if (!travels.done() && (++slow_rounds >= options.stall_rounds || (tried == 0 && ++idle_rounds > 1))) {
            travels.give_up(report);
        }
        const bool settled = travels.done();
        if (!policy.propose) {
            if (settled) break;
            continue;
        }
        start = Clock::now();
        repair(policy, round, settled, report);
        report.repair_seconds += seconds_since(start);
        if (settled && travels.done()) break;
    }
    travels.give_up(report);
    const auto start = Clock::now();
    note_changes(complex.changes());
    topology.run(step, step_changes, policy.topology, policy.select, report.events, workers);
    if (policy.topology.thickness > 0.0) {
        topology.remove_small_components(step, travels.near_collapses(), policy.topology.min_component, report.events);
    }
    fields.settle();
    report.repair_seconds += seconds_since(start);
    for (const Event& event : report.events) count(event, report.event_counts);
    report.crease_exceptions = bench.crease_exceptions;
    report.edit_distance = bench.sums.distance;
    report.edit_volume = bench.sums.volume;
    report.relabelled_volume = bench.sums.relabelled;
    report.arrived = report.requested > travels.stranded() ? report.requested - travels.stranded() : 0;
    return report;
}

StepReport Deformer::step(std::span<const VertexId> vertices, std::span<const Vec3> displacements, const RepairPolicy& policy) {
    return state_->advance(vertices, displacements, policy);
}

}  // namespace dsc::kernel
