// Moves one vertex towards its destination without inverting a tet (method.md, section 5.2).
#include "kernel/movement.hpp"

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
    double first = INFINITY;
    for (const TetId t : star) {
        const auto& x = c.tet(t).v;
        const unsigned i = mesh::index_of(c.tet(t), v);
        const auto& f = mesh::face_vertices[i];
        const Vec3& a = c.position(x[f[0]]);
        // Outward normal of the link face: v lies on its negative side.
        const Vec3 n = (c.position(x[f[1]]) - a).cross(c.position(x[f[2]]) - a);
        const double rate = n.dot(d - p);
        if (rate <= 0.0) continue;
        first = std::min(first, n.dot(a - p) / rate);
    }
    return first;
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
        std::min(1.0, free_path * first_inversion(complex, scratch.star, v, p, destination));
    mesh::StarTrial trial(complex, scratch.star, v, scratch.copy);
    scratch.qualities.resize(scratch.star.size());
    const auto good_enough = [&](std::size_t i, float q) {
        scratch.qualities[i] = q;
        return q >= std::min(floor, complex.quality(scratch.star[i]));
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
    c.cached_star(v, scratch.star, scratch.walk);
    const Motion motion = plan_move(c, bench.limits, v, destination, free_path, scratch);
    if (motion != Motion::blocked) c.move(v, scratch.place, scratch.star, scratch.qualities);
    return motion;
}

}  // namespace dsc::kernel
