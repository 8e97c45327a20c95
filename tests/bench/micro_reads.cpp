// Walks, predicates, qualities and searches: what changes nothing.
#include <dsc/geometry/predicates.hpp>
#include <dsc/geometry/quality.hpp>
#include <dsc/surface/surface_view.hpp>

#include "candidates.hpp"
#include "micro.hpp"

namespace dsc::bench {
namespace {

using benchmark::State;

constexpr int passes = 5;  // over the same simplices: a step passes them several times, too

void star(State& state, const Snapshot& snapshot) {
    const auto vertices = movable_vertices(snapshot.complex);
    std::vector<mesh::TetId> out;
    time_reads(state, vertices.size(), [&](std::size_t i) {
        snapshot.complex.star(vertices[i], out);
        return out.size();
    });
}

void ring(State& state, const Snapshot& snapshot) {
    const auto places = edges(snapshot.complex, false, [](const Place&) { return true; });
    mesh::EdgeRing out;
    time_reads(state, places.size(), [&](std::size_t i) {
        snapshot.complex.ring(places[i].tet, places[i].a, places[i].b, out);
        return out.tets.size();
    });
}

void find_edge(State& state, const Snapshot& snapshot) {
    const auto places = edges(snapshot.complex, false, [](const Place&) { return true; });
    time_reads(state, places.size(),
               [&](std::size_t i) { return snapshot.complex.find_edge(places[i].a, places[i].b); });
}

template <class Value>
void over_band(State& state, const Snapshot& snapshot, const Value& value) {
    const mesh::Complex& c = snapshot.complex;
    const auto tets = band(c);
    time_reads(state, tets.size(), [&](std::size_t i) {
        const auto& v = c.tet(tets[i]).v;
        return value(c.position(v[0]), c.position(v[1]), c.position(v[2]), c.position(v[3]));
    });
}

void nearest(State& state, const Snapshot& snapshot) {
    const auto& search = target_cloud().search();
    const auto vertices = movable_vertices(snapshot.complex);
    time_reads(state, vertices.size(), [&](std::size_t i) {
        return search.nearest(snapshot.complex.position(vertices[i])).index;
    });
}

void view(State& state, const Snapshot& snapshot) {
    surface::SurfaceView out;
    surface::build_view(snapshot.complex, out);
    while (state.KeepRunning()) {
        record_batch(state, out.vertex_count(), [&] {
            surface::build_view(snapshot.complex, out);
            benchmark::DoNotOptimize(out.mean_edge);
            benchmark::ClobberMemory();
        });
    }
}

}  // namespace

void register_reads() {
    on_snapshots("walk: star", star, passes);
    on_snapshots("walk: ring", ring, passes);
    on_snapshots("walk: find edge", find_edge, passes);
    on_snapshots(
        "predicate: orient3d",
        [](State& state, const Snapshot& s) { over_band(state, s, geometry::orient3d); }, passes);
    on_snapshots(
        "quality of a tet",
        [](State& state, const Snapshot& s) { over_band(state, s, geometry::tet_quality); },
        passes);
    on_snapshots("nearest cloud point", nearest, passes);
    on_snapshots("surface view, a vertex", view, passes);
}

}  // namespace dsc::bench
