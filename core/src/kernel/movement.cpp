// Moves one vertex towards its destination without inverting a tet (method.md, section 5.2).
#include "kernel/movement.hpp"

#include <dsc/geometry/tet_pair.hpp>
#include <dsc/mesh/star_trial.hpp>

namespace dsc::kernel {

struct MoveScratch {
    StarScratch star;
};

namespace {

constexpr double arrival = 1e-4;  // in L: a vertex closer than this has arrived; a shorter move is
                                  // not made

// Fraction of the distance to `d` at which the first link plane is reached; infinity if no plane is
// reached.
double first_inversion(const mesh::Complex& c, std::span<const TetId> star, VertexId v,
                       const Vec3& p, const Vec3& d) {
    using namespace geometry;
    const auto link_face = [&](std::size_t i) {
        const mesh::Tet& tet = c.tet(star[i]);
        const auto& f = mesh::face_vertices[mesh::index_of(tet, v)];
        return std::array<const Vec3*, 3>{&c.position(tet.v[f[0]]), &c.position(tet.v[f[1]]),
                                          &c.position(tet.v[f[2]])};
    };
    const TwoVec3 from = side_by_side(p, p), way = side_by_side(d - p, d - p);
    Two first = Two::Constant(INFINITY);
    for (std::size_t i = 0; i < star.size(); i += 2) {
        // An odd star has its last tet twice.
        const auto x = link_face(i), y = link_face(std::min(i + 1, star.size() - 1));
        const TwoVec3 a = side_by_side(*x[0], *y[0]);
        // Outward normals of the link faces: v lies on their negative side.
        const TwoVec3 n = cross(difference(side_by_side(*x[1], *y[1]), a),
                                difference(side_by_side(*x[2], *y[2]), a));
        const Two rate = dot(n, way);
        first = (rate > 0.0).select(first.min(dot(n, difference(a, from)) / rate), first);
    }
    return first.minCoeff();
}

}  // namespace

bool has_arrived(const mesh::Complex& complex, const Limits& limits, VertexId v,
                 const Vec3& destination) {
    return (destination - complex.position(v)).norm() < arrival * limits.length;
}

Motion plan_move(const mesh::Complex& complex, const Limits& limits, VertexId v,
                 const Vec3& destination, double free_path, StarScratch& scratch) {
    const Vec3 p = complex.position(v);
    const double length = (destination - p).norm();
    const double least_step = arrival * limits.length;
    const auto floor = static_cast<float>(limits.quality_floor);
    double fraction =
        std::min(1.0, free_path * first_inversion(complex, scratch.star.tets, v, p, destination));
    mesh::StarTrial trial(complex, scratch.star.tets, v, scratch.copy);
    scratch.qualities.resize(scratch.star.tets.size());
    const auto good_enough = [&](std::size_t i, float q) {
        scratch.qualities[i] = q;
        return q >= std::min(floor, complex.quality(scratch.star.tets[i]));
    };
    for (int halving = 0; halving <= 8; ++halving, fraction *= 0.5) {
        if (fraction * length < least_step) break;
        scratch.place = fraction == 1.0 ? destination : Vec3(p + fraction * (destination - p));
        if (!trial.accepts(scratch.place, good_enough) ||
            !trial.positive(scratch.place, scratch.qualities))
            continue;
        return (destination - scratch.place).norm() < least_step ? Motion::arrived : Motion::moved;
    }
    return Motion::blocked;
}

Motion move_towards(Workbench& bench, VertexId v, const Vec3& destination, double free_path) {
    mesh::Complex& c = bench.complex;
    if (has_arrived(c, bench.limits, v, destination)) return Motion::arrived;
    StarScratch& scratch = bench.move.get().star;
    scratch.star = c.cached_star(v, scratch.walk);
    const Motion motion = plan_move(c, bench.limits, v, destination, free_path, scratch);
    if (motion != Motion::blocked) c.move(v, scratch.place, scratch.star.tets, scratch.qualities);
    return motion;
}

}  // namespace dsc::kernel
