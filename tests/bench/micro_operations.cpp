// Moves and local operations. What commits works on a fresh copy of the snapshot; neither the copy
// nor the first few attempts, in which the arrays of the copy grow, are timed.
#include <dsc/base/random.hpp>

#include "candidates.hpp"
#include "kernel_access.hpp"
#include "micro.hpp"

namespace dsc::bench {
namespace {

using benchmark::State;
using repair::Operation;

constexpr std::size_t warm_up = 16;        // attempts before the clock starts
constexpr std::size_t least_attempts = 8;  // fewer say nothing
constexpr float any_quality = 0.0F;        // accepts whatever the quality floor allows
constexpr float gain_only = 2.0F;          // accepts what is better than before

/// attempt(operations, i) for all i < count on one fresh copy.
template <class Attempt>
void time_attempts(State& state, const Snapshot& snapshot, std::size_t count,
                   const Attempt& attempt) {
    const std::size_t first = std::min(warm_up, count / 4);
    if (count < least_attempts) {
        state.SkipWithError("no such simplex in this mesh");
        return;
    }
    std::size_t committed = 0;
    while (state.KeepRunning()) {
        Operations operations(snapshot.complex, snapshot.length);
        for (std::size_t i = 0; i < first; ++i) attempt(operations, i);
        committed = 0;
        record_batch(state, count - first, [&] {
            for (std::size_t i = first; i < count; ++i)
                committed += attempt(operations, i) ? 1U : 0U;
        });
        benchmark::DoNotOptimize(committed);
    }
    state.counters["committed"] =
        static_cast<double>(committed) / static_cast<double>(count - first);
}

bool attempt_at(Operations& operations, Operation operation, const Place& place,
                float accept_above) {
    return operations.apply(request_at(operations.complex(), operation, place, accept_above));
}

// The removal of several faces may take a tet that a later place names: that one is passed over.
bool attempt_face(Operations& operations, const Snapshot& snapshot, const Place& place,
                  float accept_above) {
    const mesh::Complex& now = operations.complex();
    const bool same = now.tet_alive(place.tet) &&
                      now.birth_date(place.tet) == snapshot.complex.birth_date(place.tet);
    return same && operations.remove_face(place.tet, place.face, accept_above);
}

/// Those of the places where the attempt, made on a copy in their order, has the wanted outcome.
template <class Attempt, class Wanted>
std::vector<Place> tried(const Snapshot& snapshot, const std::vector<Place>& places,
                         const Attempt& attempt, const Wanted& wanted) {
    Operations operations(snapshot.complex, snapshot.length);
    std::vector<Place> out;
    for (const Place& place : places) {
        const bool committed = attempt(operations, place);
        if (wanted(operations, committed)) out.push_back(place);
    }
    return out;
}

// Removals of edges with rings of `size`, all of which commit, or none.
void edge_removal(State& state, const Snapshot& snapshot, std::size_t size, bool commits) {
    const float accept_above = commits ? any_quality : gain_only;
    const auto attempt = [&](Operations& o, const Place& p) {
        return attempt_at(o, Operation::edge_removal, p, accept_above);
    };
    const auto places =
        tried(snapshot,
              edges(snapshot.complex, false,
                    [&](const Place& p) { return p.ring == size && !p.on_interface; }),
              attempt, [&](Operations&, bool committed) { return committed == commits; });
    time_attempts(state, snapshot, places.size(),
                  [&](Operations& o, std::size_t i) { return attempt(o, places[i]); });
}

// Face removals that commit: a 2-3 flip adds three tets, a removal of several faces more.
void face_removal(State& state, const Snapshot& snapshot, bool single) {
    const auto attempt = [&](Operations& o, const Place& p) {
        return attempt_face(o, snapshot, p, any_quality);
    };
    const auto places =
        tried(snapshot, faces(snapshot.complex), attempt, [&](Operations& o, bool committed) {
            return committed && (o.complex().last_added().size() == 3) == single;
        });
    time_attempts(state, snapshot, places.size(),
                  [&](Operations& o, std::size_t i) { return attempt(o, places[i]); });
}

void face_removal_refused(State& state, const Snapshot& snapshot) {
    const auto attempt = [&](Operations& o, const Place& p) {
        return attempt_face(o, snapshot, p, gain_only);
    };
    const auto places = tried(snapshot, faces(snapshot.complex), attempt,
                              [](Operations&, bool committed) { return !committed; });
    time_attempts(state, snapshot, places.size(),
                  [&](Operations& o, std::size_t i) { return attempt(o, places[i]); });
}

void interface_flip(State& state, const Snapshot& snapshot) {
    const auto attempt = [](Operations& o, const Place& p) {
        return attempt_at(o, Operation::interface_flip, p, any_quality);
    };
    const auto places = tried(
        snapshot, edges(snapshot.complex, true, [](const Place& p) { return p.on_interface; }),
        attempt, [](Operations&, bool committed) { return committed; });
    time_attempts(state, snapshot, places.size(),
                  [&](Operations& o, std::size_t i) { return attempt(o, places[i]); });
}

void edge_split(State& state, const Snapshot& snapshot, bool on_interface) {
    const auto places = edges(snapshot.complex, false,
                              [&](const Place& p) { return p.on_interface == on_interface; });
    time_attempts(state, snapshot, places.size(), [&](Operations& o, std::size_t i) {
        return attempt_at(o, Operation::edge_split, places[i], any_quality);
    });
}

// As a repair asks for it: within the edit bounds, the result better than 0.1 or than it was.
void edge_collapse(State& state, const Snapshot& snapshot, bool on_interface) {
    const auto places = edges(snapshot.complex, true,
                              [&](const Place& p) { return p.on_interface == on_interface; });
    time_attempts(state, snapshot, places.size(), [&](Operations& o, std::size_t i) {
        return attempt_at(o, Operation::edge_collapse, places[i], 0.1F);
    });
}

void smoothing(State& state, const Snapshot& snapshot, Operation operation) {
    const auto vertices = free_vertices(snapshot.complex);
    time_attempts(state, snapshot, vertices.size(), [&](Operations& o, std::size_t i) {
        repair::Request request;
        request.operation = operation;
        request.tet = o.complex().seed(vertices[i]);
        request.birth_date = o.complex().birth_date(request.tet);
        request.vertices[0] = vertices[i];
        request.accept_above = gain_only;
        return o.apply(request);
    });
}

struct Way {
    mesh::VertexId vertex;
    Vec3 destination;
};

// A fiftieth of L in a random direction for each movable vertex.
std::vector<Way> ways(const Snapshot& snapshot) {
    std::vector<Way> out;
    for (const mesh::VertexId v : movable_vertices(snapshot.complex)) {
        RandomStream random(RandomKey{1, stream_id("bench.ways"), 0, snapshot.complex.birth(v)});
        const Vec3 direction = Vec3(random.normal(), random.normal(), random.normal()).normalized();
        out.push_back({v, snapshot.complex.position(v) + 0.02 * snapshot.length * direction});
    }
    return out;
}

void move(State& state, const Snapshot& snapshot) {
    const auto all = ways(snapshot);
    time_attempts(state, snapshot, all.size(), [&](Operations& o, std::size_t i) {
        return o.move(all[i].vertex, all[i].destination);
    });
}

// The same moves without the search for the way: they were found possible, in this order, on a
// copy.
void move_commit(State& state, const Snapshot& snapshot) {
    std::vector<Way> done;
    std::vector<std::vector<mesh::TetId>> stars;
    Operations rehearsal(snapshot.complex, snapshot.length);
    for (const Way& way : ways(snapshot)) {
        if (!rehearsal.move(way.vertex, way.destination)) continue;
        done.push_back({way.vertex, rehearsal.complex().position(way.vertex)});
        snapshot.complex.star(way.vertex, stars.emplace_back());
    }
    time_attempts(state, snapshot, done.size(), [&](Operations& o, std::size_t i) {
        o.complex().move(done[i].vertex, done[i].destination, stars[i]);
        return true;
    });
}

}  // namespace

void register_operations() {
    on_snapshots("move: test and commit", move);
    on_snapshots("move: commit alone", move_commit);
    on_snapshots("smoothing trial, laplacian", [](State& state, const Snapshot& s) {
        smoothing(state, s, Operation::smooth_laplacian);
    });
    on_snapshots("smoothing trial, optimise", [](State& state, const Snapshot& s) {
        smoothing(state, s, Operation::smooth_optimise);
    });
    on_snapshots("flip 2-3", [](State& state, const Snapshot& s) { face_removal(state, s, true); });
    on_snapshots("face removal, several faces",
                 [](State& state, const Snapshot& s) { face_removal(state, s, false); });
    on_snapshots("face removal, refused", face_removal_refused);
    for (std::size_t ring = 3; ring <= 7; ++ring) {
        const std::string name = ring == 3   ? "flip 3-2"
                                 : ring == 4 ? "flip 4-4"
                                             : "edge removal, ring " + std::to_string(ring);
        on_snapshots(
            name, [ring](State& state, const Snapshot& s) { edge_removal(state, s, ring, true); });
    }
    for (std::size_t ring = 3; ring <= 7; ++ring) {
        on_snapshots(
            "edge removal refused, ring " + std::to_string(ring),
            [ring](State& state, const Snapshot& s) { edge_removal(state, s, ring, false); });
    }
    on_snapshots("flip of an interface edge", interface_flip);
    on_snapshots("edge split, interface",
                 [](State& state, const Snapshot& s) { edge_split(state, s, true); });
    on_snapshots("edge split, inside",
                 [](State& state, const Snapshot& s) { edge_split(state, s, false); });
    on_snapshots("edge collapse attempt, interface",
                 [](State& state, const Snapshot& s) { edge_collapse(state, s, true); });
    on_snapshots("edge collapse attempt, inside",
                 [](State& state, const Snapshot& s) { edge_collapse(state, s, false); });
}

}  // namespace dsc::bench
