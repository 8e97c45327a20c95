#include <dsc/kernel/deformer.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>

#include <dsc/base/error.hpp>
#include <dsc/base/state.hpp>
#include <dsc/geometry/quality.hpp>
#include <dsc/mesh/unpinch.hpp>
#include <dsc/mesh/validate.hpp>

#include "kernel/operations.hpp"
#include "kernel/queues.hpp"
#include "kernel/topology.hpp"
#include "kernel/travels.hpp"

namespace dsc::kernel {
namespace {

using Clock = std::chrono::steady_clock;
double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

constexpr unsigned move_passes = 2;        // before a repair: neighbours that moved make way for each other
constexpr double worthwhile_pass = 0.1;    // part of the way left by which a pass must bring the vertices on

void count(const Event& event, mesh::EventCounts& counts) {
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

void OperationCounts::add(mesh::Refusal outcome) {
    ++tried;
    ++(outcome == Refusal::committed ? committed : refused[static_cast<std::size_t>(outcome)]);
}

OperationCounts& OperationCounts::operator+=(const OperationCounts& other) {
    tried += other.tried;
    committed += other.committed;
    for (std::size_t i = 0; i < refused.size(); ++i) refused[i] += other.refused[i];
    return *this;
}

struct Deformer::State {
    mesh::Complex complex;
    DeformerOptions options;
    Workbench bench;
    RepairQueues queues;
    TopologyStage topology;
    double length = 0.0;
    std::uint64_t step = 0;

    StarLoop star_loop;
    Travels travels;
    Workers* workers;  // null: one thread

    std::vector<TetId> step_changes;
    std::vector<bool> noted;  // per tet: it is in step_changes
    std::vector<mesh::Request> requests, last_requests;
    std::vector<mesh::Outcome> outcomes;
    std::vector<VertexId> smoothed;  // of a batch of requests

    State(mesh::Complex start, const DeformerOptions& wanted, Workers* given)
        : complex(std::move(start)),
          options(wanted),
          bench(complex),
          queues(complex, wanted.audit, wanted.drop_wake_up),
          topology(bench),
          star_loop(complex),
          travels(complex, queues, star_loop),
          // The lost wake-up is counted in the order of one thread.
          workers(wanted.drop_wake_up == 0 ? given : nullptr) {
        bench.listener = &travels;
        length = mean_interface_edge();
        apply_limits(0.995);
    }

    void apply_limits(double flatness) {
        if (bench.limits.length != length) bench.forget_refusals();
        bench.limits = {length, options.quality_floor, options.max_edit_distance * length,
                        options.max_edit_volume * geometry::regular_tet_volume(length), flatness};
    }

    double mean_interface_edge() const {
        double sum = 0.0;
        std::size_t edges = 0;
        std::vector<VertexId> order(complex.interface_vertices().begin(), complex.interface_vertices().end());
        std::sort(order.begin(), order.end(), [this](VertexId a, VertexId b) { return complex.birth(a) < complex.birth(b); });
        std::vector<TetId> star;
        std::vector<std::uint32_t> ends;
        std::vector<std::pair<std::uint32_t, double>> lengths;
        for (const VertexId v : order) {
            complex.star(v, star);
            lengths.clear();
            for (const TetId t : star) {
                for (unsigned f = 0; f < 4; ++f) {
                    if (complex.tet(t).v[f] == v || !complex.interface_face(t, f)) continue;
                    for (const auto k : mesh::face_vertices[f]) {
                        const VertexId w = complex.tet(t).v[k];
                        if (complex.birth(w) > complex.birth(v)) lengths.emplace_back(complex.birth(w), (complex.position(w) - complex.position(v)).norm());
                    }
                }
            }
            std::sort(lengths.begin(), lengths.end());
            lengths.erase(std::unique(lengths.begin(), lengths.end()), lengths.end());
            for (const auto& edge : lengths) sum += edge.second;
            edges += lengths.size();
        }
        return edges > 0 ? sum / static_cast<double>(edges) : 0.0;
    }

    // ---- the parts of a step ------------------------------------------------------------------------------------
    void begin(std::span<const VertexId> vertices, std::span<const Vec3> displacements, StepReport& report) {
        ++step;
        travels.clear();
        for (const TetId t : step_changes) noted[t] = false;
        step_changes.clear();
        last_requests.clear();
        outcomes.clear();
        bench.sums = {};
        const Vec3 low = complex.box().low.array() + 2.0 * length;
        const Vec3 high = complex.box().high.array() - 2.0 * length;
        for (std::size_t i = 0; i < vertices.size(); ++i) {
            const VertexId v = vertices[i];
            // In this order: a vertex that rests is not even looked at.
            if (displacements[i].isZero(0.0) || !complex.movable(v)) continue;
            ++report.requested;
            const Vec3 wanted = complex.position(v) + displacements[i];
            const Vec3 inside = wanted.cwiseMax(low).cwiseMin(high);
            if (inside != wanted) ++report.clamped;
            travels.send(v, inside);
        }
    }

    // For the topology stage: what changed in this step, each tet once.
    void note_changes(std::span<const TetId> changed) {
        noted.resize(std::max(noted.size(), complex.tet_slots()), false);
        for (const TetId t : changed) {
            if (noted[t]) continue;
            noted[t] = true;
            step_changes.push_back(t);
        }
    }

    // A refused request makes its tet wait until its neighbourhood changes.
    void record(std::uint32_t i, Refusal refusal, std::uint32_t date, StepReport& report) {
        outcomes[i] = {i, refusal};
        const mesh::Request& request = requests[i];
        report.operations[static_cast<std::size_t>(request.operation)].add(refusal);
        report.repair_classes[std::min<std::size_t>(request.repair_class, mesh::repair_class_limit - 1)].add(refusal);
        if (refusal == Refusal::committed) return;
        if (refusal != Refusal::stale && request.tet != mesh::none) queues.fail(request.tet, date);
    }

    // Requests that smooth different vertices one after the other may run side by side.
    struct Smoothing {
        State& state;
        std::uint32_t first;  // request of vertex 0
        StepReport& report;

        const mesh::Request& request(std::size_t i) const { return state.requests[first + i]; }
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

    // Whether the request is sure to be a Laplacian smoothing at its turn, whatever other smoothings do before it.
    bool plain_smoothing(const mesh::Request& request) const {
        const VertexId v = request.vertices[0];
        const TetId t = request.tet;
        return request.operation == mesh::Operation::smooth_laplacian && v != mesh::none && request.vertices[1] == mesh::none &&
               request.only_below > 1.0F && t != mesh::none && t < complex.tet_slots() && complex.tet_alive(t) &&
               complex.birth_date(t) == request.birth_date && mesh::has_vertex(complex.tet(t), v);
    }

    std::size_t smooth_from(std::size_t first, StepReport& report) {
        smoothed.clear();
        for (std::size_t i = first; i < requests.size() && plain_smoothing(requests[i]); ++i) smoothed.push_back(requests[i].vertices[0]);
        Smoothing action{*this, static_cast<std::uint32_t>(first), report};
        star_loop.run(smoothed, workers, action);
        return smoothed.size();
    }

    void repair(const RepairPolicy& policy, unsigned round, bool settled, StepReport& report) {
        const auto dirty = queues.next_round();
        note_changes(dirty);
        requests.clear();
        policy.propose(mesh::RepairRound{complex, dirty, travels.blocked(), last_requests, outcomes, length, policy.flatness, round, settled},
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

    StepReport advance(std::span<const VertexId> vertices, std::span<const Vec3> displacements, const RepairPolicy& policy) {
        StepReport report;
        apply_limits(policy.flatness);
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
        report.repair_seconds += seconds_since(start);
        for (const Event& event : report.events) count(event, report.event_counts);
        report.edit_distance = bench.sums.distance;
        report.edit_volume = bench.sums.volume;
        report.relabelled_volume = bench.sums.relabelled;
        report.arrived = report.requested > travels.stranded() ? report.requested - travels.stranded() : 0;
        return report;
    }

};

Deformer::Deformer(mesh::Complex complex, const DeformerOptions& options, Workers* workers)
    : state_(std::make_unique<State>(std::move(complex), options, workers)) {}
Deformer::~Deformer() = default;
Deformer::Deformer(Deformer&&) noexcept = default;
Deformer& Deformer::operator=(Deformer&&) noexcept = default;

const mesh::Complex& Deformer::complex() const { return state_->complex; }
double Deformer::target_length() const { return state_->length; }
std::uint64_t Deformer::step_count() const { return state_->step; }

void Deformer::save(StateWriter& out) const {
    state_->complex.save(out);
    out.value(state_->length);
    out.value(state_->step);
    out.value(state_->bench.limits);
    state_->queues.save(out);
    state_->topology.save(out);
}

Deformer Deformer::load(StateReader& in, const DeformerOptions& options, Workers* workers) {
    Deformer deformer(mesh::Complex::load(in), options, workers);
    State& s = *deformer.state_;
    in.value(s.length);
    in.value(s.step);
    in.value(s.bench.limits);
    s.queues.load(in);
    s.topology.load(in);
    return deformer;
}

StepReport Deformer::step(std::span<const VertexId> vertices, std::span<const Vec3> displacements, const RepairPolicy& policy) {
    return state_->advance(vertices, displacements, policy);
}

RefineReport Deformer::refine(std::span<const std::array<VertexId, 3>> faces, std::span<const std::array<VertexId, 2>> edges) {
    State& s = *state_;
    RefineReport report;
    report.requested = faces.size() + edges.size();
    const auto alive = [&](VertexId v) { return v < s.complex.vertex_slots() && s.complex.vertex_alive(v); };
    std::vector<TetId> star;
    for (const auto& face : faces) {
        if (!alive(face[0]) || !alive(face[1]) || !alive(face[2])) continue;
        // Only while the three vertices still bound one interface face.
        s.complex.star(face[0], star);
        TetId found = mesh::none;
        for (const TetId t : star) {
            const mesh::Tet& tet = s.complex.tet(t);
            if (!mesh::has_vertex(tet, face[1]) || !mesh::has_vertex(tet, face[2])) continue;
            for (unsigned f = 0; f < 4; ++f) {
                const bool opposite = tet.v[f] != face[0] && tet.v[f] != face[1] && tet.v[f] != face[2];
                if (opposite && s.complex.interface_face(t, f)) found = t;
            }
        }
        if (found == mesh::none) continue;
        VertexId a = face[0], b = face[1];
        double longest = -1.0;
        for (unsigned k = 0; k < 3; ++k) {
            const double d = (s.complex.position(face[k]) - s.complex.position(face[(k + 1) % 3])).squaredNorm();
            if (d <= longest) continue;
            longest = d;
            a = face[k];
            b = face[(k + 1) % 3];
        }
        if (split_edge(s.bench, found, a, b, 0.5) == Refusal::committed) ++report.committed;
    }
    for (const auto& edge : edges) {
        if (!alive(edge[0]) || !alive(edge[1])) continue;
        const TetId t = s.complex.find_edge(edge[0], edge[1]);
        if (t != mesh::none && split_edge(s.bench, t, edge[0], edge[1], 0.5) == Refusal::committed) ++report.committed;
    }
    report.length_changed = report.committed > 0;
    if (report.length_changed) {
        s.length = s.mean_interface_edge();
        s.apply_limits(s.bench.limits.flatness);
    }
    return report;
}

std::size_t Deformer::relabel(std::span<const TetId> tets, std::span<const mesh::Label> labels, const RepairPolicy& policy,
                              std::vector<Event>& events) {
    State& s = *state_;
    s.apply_limits(policy.flatness);
    const mesh::InterfaceCounts before = mesh::count_interface(s.complex);
    std::vector<VertexId> touched;
    std::size_t changed = 0;
    Event event;
    event.step = s.step;
    for (std::size_t i = 0; i < tets.size(); ++i) {
        const TetId t = tets[i];
        if (t >= s.complex.tet_slots() || !s.complex.tet_alive(t) || s.complex.label(t) == labels[i]) continue;
        const auto v = s.complex.tet(t).v;
        if (std::any_of(v.begin(), v.end(), [&](VertexId x) { return s.complex.on_box(x); })) continue;
        event.label = s.complex.label(t);
        event.place = 0.25 * (s.complex.position(v[0]) + s.complex.position(v[1]) + s.complex.position(v[2]) + s.complex.position(v[3]));
        event.volume += s.complex.volume(t);
        s.complex.relabel(std::span(&t, 1), labels[i]);
        touched.insert(touched.end(), v.begin(), v.end());
        ++changed;
    }
    if (changed == 0) return 0;
    event.tets = changed;
    std::sort(touched.begin(), touched.end(), [&](VertexId a, VertexId b) { return s.complex.birth(a) < s.complex.birth(b); });
    touched.erase(std::unique(touched.begin(), touched.end()), touched.end());
    const std::size_t unpinched = mesh::unpinch(s.complex, "relabelling", touched);
    const mesh::InterfaceCounts after = mesh::count_interface(s.complex);
    const auto emit = [&](Event::Kind kind, long times) {
        for (long i = 0; i < times; ++i) {
            event.kind = kind;
            events.push_back(event);
        }
    };
    const long shells = static_cast<long>(after.shells) - static_cast<long>(before.shells);
    emit(Event::Kind::born, shells);
    emit(Event::Kind::vanished, -shells);
    emit(Event::Kind::handle_opened, after.genus() - before.genus());
    emit(Event::Kind::handle_closed, before.genus() - after.genus());
    emit(Event::Kind::unpinched, static_cast<long>(unpinched));
    return changed;
}

}  // namespace dsc::kernel
