// The parts of a refinement: splits, collapses, flips and moves that it requests (method.md,
// section 7).

#include "kernel/deformer_state.hpp"
#include "kernel/movement.hpp"

namespace dsc::kernel {

Outcome Deformer::State::split_longest_edge(const std::array<VertexId, 3>& face) {
    if (!alive(face[0]) || !alive(face[1]) || !alive(face[2])) return Refusal::stale;
    // Only if the three vertices still bound one interface face.
    complex.star(face[0], face_star);
    TetId found = mesh::none;
    for (const TetId t : face_star) {
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
        const double d =
            (complex.position(face[k]) - complex.position(face[(k + 1) % 3])).squaredNorm();
        if (d <= longest) continue;
        longest = d;
        a = face[k];
        b = face[(k + 1) % 3];
    }
    return split_edge(bench, found, a, b, 0.5);
}

Outcome Deformer::State::split(const std::array<VertexId, 2>& edge) {
    if (!alive(edge[0]) || !alive(edge[1])) return Refusal::stale;
    const TetId t = complex.find_edge(edge[0], edge[1]);
    return t != mesh::none ? split_edge(bench, t, edge[0], edge[1], 0.5) : Refusal::stale;
}

Outcome Deformer::State::collapse(const CollapseTo& request) {
    if (!alive(request.kept) || !alive(request.removed)) return Refusal::stale;
    const TetId t = complex.find_edge(request.kept, request.removed);
    return t != mesh::none
               ? collapse_edge_to(bench, t, request.kept, request.removed, request.place)
               : Refusal::stale;
}

Outcome Deformer::State::flip(const FlipTo& request) {
    if (!alive(request.a) || !alive(request.b)) return Refusal::stale;
    const TetId t = complex.find_edge(request.a, request.b);
    if (t == mesh::none) return Refusal::stale;
    bench.limits.flatness = request.flatness;
    // The quality may fall to the floor.
    return flip_interface_edge(bench, t, request.a, request.b, 0.0F);
}

Outcome Deformer::State::move(const MoveTo& request) {
    if (!alive(request.vertex)) return Refusal::stale;
    if (!complex.movable(request.vertex)) return Refusal::not_applicable;
    bool moved = false;
    const Vec3 low = complex.box().low.array() + 2.0 * length,
               high = complex.box().high.array() - 2.0 * length;
    const Vec3 place = request.place.cwiseMax(low).cwiseMin(high);
    // Several attempts, because each covers only part of the distance to the first inversion.
    for (int attempt = 0; attempt < 4; ++attempt) {
        const Motion motion = move_towards(bench, request.vertex, place, options.free_path);
        moved = moved || motion != Motion::blocked;
        if (motion != Motion::moved) break;
    }
    return moved ? success : Outcome(Refusal::quality);
}

namespace {

template <class List, class Act>
void each(const List& list, OperationCounts& counts, RefineReport& report, const Act& act) {
    for (const auto& request : list) {
        const Outcome outcome = act(request);
        counts.add(outcome);
        report.committed += outcome.refused() ? 0 : 1;
    }
    report.requested += list.size();
}

}  // namespace

void Deformer::State::split_all(const RefineRequests& wanted, RefineReport& report) {
    if (wanted.owns_sizing) bench.limits.set_floor(refinement_floor);
    each(wanted.split_faces, report.splits, report,
         [this](const auto& face) { return split_longest_edge(face); });
    each(wanted.split_edges, report.splits, report,
         [this](const auto& edge) { return split(edge); });
}

void Deformer::State::edit_all(const RefineRequests& wanted, RefineReport& report) {
    bench.limits.set_floor(refinement_floor);
    each(wanted.collapses, report.collapses, report,
         [this](const CollapseTo& request) { return collapse(request); });
    each(wanted.flips, report.flips, report,
         [this](const FlipTo& request) { return flip(request); });
    each(wanted.moves, report.moves, report,
         [this](const MoveTo& request) { return move(request); });
}

}  // namespace dsc::kernel
