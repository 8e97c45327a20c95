// Operations on one vertex or one tet: smoothing, vertex split, relabelling (method.md, sections 4.2, 4.6, 4.8).
#include <cmath>

#include <dsc/geometry/predicates.hpp>
#include <dsc/geometry/quality.hpp>
#include <dsc/mesh/vertex_split.hpp>

#include "kernel/creases.hpp"
#include "kernel/operations.hpp"

namespace dsc::kernel {
namespace {

// Least quality of the star with v at `place`; `qualities` receives all of them. Returns -1 as soon as one is not above
// `bound`.
float star_quality(const mesh::Complex& c, std::span<const TetId> star, VertexId v, const Vec3& place, float bound,
                   std::vector<float>& qualities) {
    float least = 2.0F;
    qualities.clear();
    for (const TetId t : star) {
        const auto& x = c.tet(t).v;
        std::array<const Vec3*, 4> p{};
        for (unsigned i = 0; i < 4; ++i) p[i] = x[i] == v ? &place : &c.position(x[i]);
        const auto q = static_cast<float>(geometry::tet_quality(*p[0], *p[1], *p[2], *p[3]));
        if (!(q > bound)) return -1.0F;
        qualities.push_back(q);
        least = std::min(least, q);
    }
    return least;
}

bool star_positive(const mesh::Complex& c, std::span<const TetId> star, VertexId v, const Vec3& place) {
    return std::all_of(star.begin(), star.end(), [&](TetId t) {
        const auto& x = c.tet(t).v;
        std::array<const Vec3*, 4> p{};
        for (unsigned i = 0; i < 4; ++i) p[i] = x[i] == v ? &place : &c.position(x[i]);
        return geometry::orient3d(*p[0], *p[1], *p[2], *p[3]) == 1;
    });
}

float star_old(const mesh::Complex& c, std::span<const TetId> star) {
    float least = 1.0F;
    for (const TetId t : star) least = std::min(least, c.quality(t));
    return least;
}

Refusal smoothable(const mesh::Complex& c, VertexId v) {
    if (c.on_box(v)) return Refusal::box;
    return c.on_interface(v) ? Refusal::not_applicable : Refusal::committed;
}

// Gradient of the signed quality of tet (v, b, c, d) by v; q = sqrt(2) det / m^(3/2), m the mean squared edge.
Vec3 quality_gradient(const Vec3& v, const Vec3& b, const Vec3& c, const Vec3& d) {
    const Vec3 u = b - v, s = c - v, w = d - v;
    const double det = u.cross(s).dot(w);
    const double m = (u.squaredNorm() + s.squaredNorm() + w.squaredNorm() + (c - b).squaredNorm() + (d - b).squaredNorm() +
                      (d - c).squaredNorm()) /
                     6.0;
    const Vec3 det_gradient = -(c - b).cross(d - b);
    const Vec3 m_gradient = -(u + s + w) / 3.0;
    const double root = std::sqrt(m);
    return std::sqrt(2.0) * (det_gradient / (m * root) - 1.5 * det / (m * m * root) * m_gradient);
}

}  // namespace

Refusal may_smooth(const Workbench& bench, VertexId v, float accept_above) {
    const Refusal r = smoothable(bench.complex, v);
    return r != Refusal::committed ? r : bench.known_refusal(v, Workbench::Trial::laplacian, accept_above);
}

Refusal plan_laplacian(const mesh::Complex& complex, const Limits& limits, VertexId v, float accept_above, StarScratch& scratch) {
    find_neighbours(complex, v, scratch);
    Vec3 mean = Vec3::Zero();
    for (const VertexId w : scratch.neighbours) mean += complex.position(w);
    mean /= static_cast<double>(scratch.neighbours.size());
    // A vertex that is already there is not moved: the move would only mark its star as changed.
    if ((mean - complex.position(v)).norm() < 0.02 * limits.length) return Refusal::no_gain;
    const float bound = std::min(star_old(complex, scratch.star), accept_above);
    if (star_quality(complex, scratch.star, v, mean, bound, scratch.qualities) < 0.0F) return Refusal::quality;
    if (!star_positive(complex, scratch.star, v, mean)) return Refusal::quality;
    scratch.place = mean;
    return Refusal::committed;
}

Refusal smooth_laplacian(Workbench& bench, VertexId v, float accept_above) {
    if (const Refusal r = may_smooth(bench, v, accept_above); r != Refusal::committed) return r;
    StarScratch& scratch = bench.scratch;
    bench.complex.star(v, scratch.star, scratch.places);
    const Refusal r = plan_laplacian(bench.complex, bench.limits, v, accept_above, scratch);
    if (r != Refusal::committed) return bench.remember(v, Workbench::Trial::laplacian, accept_above, r);
    bench.complex.move(v, scratch.place, scratch.star, scratch.qualities);
    return Refusal::committed;
}

Refusal smooth_optimise(Workbench& bench, VertexId v) {
    constexpr auto trial = Workbench::Trial::optimise;
    mesh::Complex& c = bench.complex;
    if (const Refusal r = smoothable(c, v); r != Refusal::committed) return r;
    if (const Refusal known = bench.known_refusal(v, trial, 0.0F); known != Refusal::committed) return known;
    c.star(v, bench.star_a);
    const float old = star_old(c, bench.star_a);
    float best = old;
    Vec3 place = c.position(v);
    double step = 0.25 * bench.limits.length;
    for (int iteration = 0; iteration < 6; ++iteration) {
        // Uphill for the tet that is worst at the present place.
        float worst = 2.0F;
        Vec3 uphill = Vec3::Zero();
        for (const TetId t : bench.star_a) {
            auto x = c.tet(t).v;
            const unsigned i = mesh::index_of(c.tet(t), v);
            // (v, rest) in positive order: moving v to the front by i exchanges keeps the sign for even i.
            for (unsigned k = i; k > 0; --k) std::swap(x[k], x[k - 1]);
            if (i % 2 == 1) std::swap(x[2], x[3]);
            const Vec3 &p1 = c.position(x[1]), &p2 = c.position(x[2]), &p3 = c.position(x[3]);
            const auto q = static_cast<float>(geometry::tet_quality(place, p1, p2, p3));
            if (q >= worst) continue;
            worst = q;
            uphill = quality_gradient(place, p1, p2, p3);
        }
        const double slope = uphill.norm();
        if (!(slope > 0.0)) break;
        bool better = false;
        for (int halving = 0; halving < 6 && !better; ++halving, step *= 0.5) {
            const Vec3 there = place + (step / slope) * uphill;
            const float least = star_quality(c, bench.star_a, v, there, best, bench.edit.qualities);
            if (least < 0.0F) continue;
            best = least;
            place = there;
            better = true;
        }
        if (!better) break;
    }
    if (!(best > old * 1.01F)) return bench.remember(v, trial, 0.0F, Refusal::no_gain);
    if (!star_positive(c, bench.star_a, v, place)) return bench.remember(v, trial, 0.0F, Refusal::quality);
    c.move(v, place, bench.star_a);
    return Refusal::committed;
}

Refusal split_vertex(Workbench& bench, VertexId v, VertexId w) {
    mesh::Complex& c = bench.complex;
    if (c.on_box(v)) return Refusal::box;
    c.star(v, bench.star_a);
    const Vec3 direction = c.position(w) - c.position(v);
    mesh::Label label = 0;
    bool found = false;
    for (const TetId t : bench.star_a) {
        if (!mesh::has_vertex(c.tet(t), w)) continue;
        label = c.label(t);
        found = true;
        break;
    }
    if (!found) return Refusal::not_applicable;
    // The half of the star towards w, inside one label, so the interface does not change.
    bench.star_b.clear();
    for (const TetId t : bench.star_a) {
        Vec3 centroid = -3.0 * c.position(v);
        for (const VertexId x : c.tet(t).v) {
            if (x != v) centroid += c.position(x);
        }
        if (c.label(t) == label && centroid.dot(direction) > 0.0) bench.star_b.push_back(t);
    }
    if (bench.star_b.empty()) return Refusal::not_applicable;
    const std::vector<mesh::RimFace> rim = mesh::rim_of(c, v, bench.star_b);
    if (rim.empty()) return Refusal::not_applicable;
    if (!mesh::plan_vertex_split(c, v, bench.star_b, rim, mesh::RimLabel::own, bench.limits.quality_floor, bench.edit)) {
        return Refusal::quality;
    }
    if (const Refusal r = bench.check_shape(0.0F, bench.old_quality()); r != Refusal::committed) return r;
    if (!c.link(bench.edit)) return Refusal::irregular;
    // If the star's interface corner is in the group, the new vertex would take over the corner and the geometry would change.
    if (c.on_interface(v)) {
        const double volume = bench.phase_change();
        const EditBounds bounds = bench.bounds_at(v, v);
        if (volume > bounds.volume) return Refusal::bound;
        bench.vertices.clear();
        for (const TetId t : bench.edit.removed) {
            for (const VertexId x : c.tet(t).v) {
                if (c.on_interface(x)) bench.vertices.push_back(x);
            }
        }
        std::sort(bench.vertices.begin(), bench.vertices.end());
        bench.vertices.erase(std::unique(bench.vertices.begin(), bench.vertices.end()), bench.vertices.end());
        bench.vertices.push_back(mesh::created_vertex);
        const double distance = (bench.edit.created_at - c.position(v)).norm();
        if (distance > bounds.distance) return Refusal::bound;
        if (const Refusal r = bench.check_topology(bench.vertices); r != Refusal::committed) return r;
        if (const Refusal r = check_creases(bench); r != Refusal::committed) return r;
        const VertexId created = bench.commit(volume > 0.0 ? distance : 0.0, volume);
        if (bench.listener != nullptr) bench.listener->on_split(created, v, v, 0.0);
        return Refusal::committed;
    }
    const VertexId created = bench.commit(0.0, 0.0);
    if (bench.listener != nullptr) bench.listener->on_split(created, v, v, 0.0);
    return Refusal::committed;
}

}  // namespace dsc::kernel
