// What a Deformer does between steps when a refinement requests it (method.md, section 7).
#include <algorithm>
#include <cmath>

#include <dsc/mesh/unpinch.hpp>
#include <dsc/mesh/validate.hpp>

#include "kernel/deformer_state.hpp"
#include "kernel/movement.hpp"

namespace dsc::kernel {

Refusal Deformer::State::split_longest_edge(const std::array<VertexId, 3>& face) {
    if (!alive(face[0]) || !alive(face[1]) || !alive(face[2])) return Refusal::stale;
    // Only if the three vertices still bound one interface face.
    std::vector<TetId>& star = bench.star_a;
    complex.star(face[0], star);
    TetId found = mesh::none;
    for (const TetId t : star) {
        const mesh::Tet& tet = complex.tet(t);
        if (!mesh::has_vertex(tet, face[1]) || !mesh::has_vertex(tet, face[2])) continue;
        for (unsigned f = 0; f < 4; ++f) {
            const bool opposite = tet.v[f] != face[0] && tet.v[f] != face[1] && tet.v[f] != face[2];
            if (opposite && complex.interface_face(t, f)) found = t;
        }
    }
    if (found == mesh::none) return Refusal::stale;
    VertexId a = face[0], b = face[1];
    double longest = -1.0;
    for (unsigned k = 0; k < 3; ++k) {
        const double d = (complex.position(face[k]) - complex.position(face[(k + 1) % 3])).squaredNorm();
        if (d <= longest) continue;
        longest = d;
        a = face[k];
        b = face[(k + 1) % 3];
    }
    return split_edge(bench, found, a, b, 0.5);
}

Refusal Deformer::State::split(const std::array<VertexId, 2>& edge) {
    if (!alive(edge[0]) || !alive(edge[1])) return Refusal::stale;
    const TetId t = complex.find_edge(edge[0], edge[1]);
    return t != mesh::none ? split_edge(bench, t, edge[0], edge[1], 0.5) : Refusal::stale;
}

Refusal Deformer::State::collapse(const CollapseTo& request) {
    if (!alive(request.kept) || !alive(request.removed)) return Refusal::stale;
    const TetId t = complex.find_edge(request.kept, request.removed);
    return t != mesh::none ? collapse_edge_to(bench, t, request.kept, request.removed, request.place) : Refusal::stale;
}

Refusal Deformer::State::flip(const FlipTo& request) {
    if (!alive(request.a) || !alive(request.b)) return Refusal::stale;
    const TetId t = complex.find_edge(request.a, request.b);
    if (t == mesh::none) return Refusal::stale;
    bench.limits.flatness = request.flatness;
    // The quality may fall to the floor.
    return flip_interface_edge(bench, t, request.a, request.b, 0.0F);
}

Refusal Deformer::State::move(const MoveTo& request) {
    if (!alive(request.vertex)) return Refusal::stale;
    if (!complex.movable(request.vertex)) return Refusal::not_applicable;
    bool moved = false;
    const Vec3 low = complex.box().low.array() + 2.0 * length, high = complex.box().high.array() - 2.0 * length;
    const Vec3 place = request.place.cwiseMax(low).cwiseMin(high);
    // Several attempts, because each covers only part of the distance to the first inversion.
    for (int attempt = 0; attempt < 4; ++attempt) {
        const Motion motion = move_towards(bench, request.vertex, place, options.free_path);
        moved = moved || motion != Motion::blocked;
        if (motion != Motion::moved) break;
    }
    return moved ? Refusal::committed : Refusal::quality;
}

RefineReport Deformer::refine(std::span<const std::array<VertexId, 3>> faces, std::span<const std::array<VertexId, 2>> edges) {
    RefineRequests requests;
    requests.split_faces.assign(faces.begin(), faces.end());
    requests.split_edges.assign(edges.begin(), edges.end());
    return refine(requests);
}

RefineReport Deformer::refine(const RefineRequests& requests) {
    State& s = *state_;
    RefineReport report;
    s.apply_limits(s.bench.limits.flatness, requests.creases);
    const Limits before = s.bench.limits;
    s.bench.crease_exceptions = 0;
    const auto each = [&report](const auto& list, OperationCounts& counts, const auto& act) {
        for (const auto& request : list) {
            const Refusal outcome = act(request);
            counts.add(outcome);
            report.committed += outcome == Refusal::committed ? 1 : 0;
        }
        report.requested += list.size();
    };
    if (requests.owns_sizing) s.bench.limits.set_floor(refinement_floor);
    each(requests.split_faces, report.splits, [&s](const auto& face) { return s.split_longest_edge(face); });
    each(requests.split_edges, report.splits, [&s](const auto& edge) { return s.split(edge); });
    s.bench.limits.set_floor(refinement_floor);
    each(requests.collapses, report.collapses, [&s](const CollapseTo& request) { return s.collapse(request); });
    each(requests.flips, report.flips, [&s](const FlipTo& request) { return s.flip(request); });
    each(requests.moves, report.moves, [&s](const MoveTo& request) { return s.move(request); });
    s.bench.limits = before;
    report.crease_exceptions = s.bench.crease_exceptions;
    s.fields.settle();
    report.length_changed = report.splits.committed > 0 && !requests.owns_sizing;
    if (report.length_changed) s.set_length(s.mean_interface_edge());
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
    s.fields.settle();  // unpinching creates vertices
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
