// Operations on one vertex or one tet: smoothing, vertex split, relabelling (method.md,
// sections 4.2, 4.6, 4.8).
#include <cmath>

#include <dsc/mesh/star_trial.hpp>
#include <dsc/mesh/vertex_split.hpp>

#include "kernel/creases.hpp"
#include "kernel/operations.hpp"

namespace dsc::kernel {

struct SmoothScratch {
    StarScratch star;
    std::vector<float> tried;  // of the optimising form: the qualities at the tried place; those in
                               // `star` are at the best place
};

struct VertexSplitScratch {
    std::vector<TetId> star, group;
    std::vector<VertexId> concerned;  // vertices whose topology is tested
};

namespace {

// The tet of least quality.
struct Worst {
    std::size_t place = 0;  // in the star
    float quality = 1.0F;
};

Worst worst_of(const mesh::Complex& c, std::span<const TetId> star) {
    Worst worst;
    for (std::size_t i = 0; i < star.size(); ++i) {
        const float q = c.quality(star[i]);
        worst.place = q < worst.quality ? i : worst.place;
        worst.quality = std::min(worst.quality, q);
    }
    return worst;
}

Outcome smoothable(const mesh::Complex& c, VertexId v) {
    if (c.on_box(v)) return Refusal::box;
    return c.on_interface(v) ? Refusal::not_applicable : success;
}

// The least quality of the star with its vertex at `place`, or -1 if a tet is not above `bound`.
// `qualities` receives those of the tets, and must have their number.
float least_above(float bound, mesh::StarTrial& trial, const Vec3& place,
                  std::vector<float>& qualities) {
    float least = 2.0F;
    const bool all = trial.accepts(place, [&](std::size_t i, float q) {
        qualities[i] = q;
        least = std::min(least, q);
        return q > bound;
    });
    return all ? least : -1.0F;
}

// Gradient of the signed quality of tet (v, b, c, d) by v; q = sqrt(2) det / m^(3/2), m the mean
// squared edge.
Vec3 quality_gradient(const Vec3& v, const Vec3& b, const Vec3& c, const Vec3& d) {
    const Vec3 u = b - v, s = c - v, w = d - v;
    const double det = u.cross(s).dot(w);
    const double m = (u.squaredNorm() + s.squaredNorm() + w.squaredNorm() + (c - b).squaredNorm() +
                      (d - b).squaredNorm() + (d - c).squaredNorm()) /
                     6.0;
    const Vec3 det_gradient = -(c - b).cross(d - b);
    const Vec3 m_gradient = -(u + s + w) / 3.0;
    const double root = std::sqrt(m);
    return std::sqrt(2.0) * (det_gradient / (m * root) - 1.5 * det / (m * m * root) * m_gradient);
}

}  // namespace

Outcome may_smooth(const Workbench& bench, VertexId v, float accept_above) {
    if (const Outcome o = smoothable(bench.complex, v); o.refused()) return o;
    if (const auto known = bench.known_refusal(v, Workbench::Smoother::laplacian, accept_above))
        return *known;
    return success;
}

Outcome plan_laplacian(const mesh::Complex& complex, const Limits& limits, VertexId v,
                       float accept_above, StarScratch& scratch) {
    const auto& [star, neighbours] = scratch.star;
    Vec3 mean = Vec3::Zero();
    for (const VertexId w : neighbours) mean += complex.position(w);
    mean /= static_cast<double>(neighbours.size());
    // A vertex that is already there is not moved: the move would only mark its star as changed.
    if ((mean - complex.position(v)).norm() < 0.02 * limits.length) return Refusal::no_gain;
    const Worst worst = worst_of(complex, star);
    const float bound = std::min(worst.quality, accept_above);
    mesh::StarTrial trial(complex, star, v, scratch.copy);
    trial.suspect_too(worst.place);
    scratch.qualities.resize(star.size());
    if (least_above(bound, trial, mean, scratch.qualities) < 0.0F ||
        !trial.positive(mean, scratch.qualities))
        return Refusal::quality;
    scratch.place = mean;
    return success;
}

Outcome smooth_laplacian(Workbench& bench, VertexId v, float accept_above) {
    if (const Outcome o = may_smooth(bench, v, accept_above); o.refused()) return o;
    StarScratch& scratch = bench.smooth.get().star;
    scratch.star = bench.complex.cached_star(v, scratch.walk);
    const Outcome o = plan_laplacian(bench.complex, bench.limits, v, accept_above, scratch);
    if (o.refused())
        return bench.remember(v, Workbench::Smoother::laplacian, accept_above, o.reason());
    bench.complex.move(v, scratch.place, scratch.star.tets, scratch.qualities);
    return success;
}

Outcome smooth_optimise(Workbench& bench, VertexId v) {
    constexpr auto smoother = Workbench::Smoother::optimise;
    mesh::Complex& c = bench.complex;
    if (const Outcome o = smoothable(c, v); o.refused()) return o;
    if (const auto known = bench.known_refusal(v, smoother, 0.0F)) return *known;
    auto& [scratch, tried] = bench.smooth.get();
    const std::span<const TetId> star = c.cached_star(v, scratch.walk).tets;
    std::vector<float>& qualities = scratch.qualities;
    mesh::StarTrial trial(c, star, v, scratch.copy);
    qualities.resize(star.size());
    tried.resize(star.size());
    const float old = worst_of(c, star).quality;
    float best = old;
    Vec3 place = c.position(v);
    double step = 0.25 * bench.limits.length;
    for (int iteration = 0; iteration < 6; ++iteration) {
        // Uphill for the tet that is worst at the present place. The qualities there are known, up
        // to the order of the corners; the margin is far above its rounding.
        float worst = 2.0F;
        Vec3 uphill = Vec3::Zero();
        for (std::size_t place_in_star = 0; place_in_star < star.size(); ++place_in_star) {
            const TetId t = star[place_in_star];
            const float known = iteration == 0 ? c.quality(t) : qualities[place_in_star];
            if (known > best + 1e-3F) continue;
            auto x = c.tet(t).v;
            const unsigned i = mesh::index_of(c.tet(t), v);
            // (v, rest) in positive order: moving v to the front by i exchanges keeps the sign for
            // even i.
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
            const float least = least_above(best, trial, there, tried);
            if (least < 0.0F) continue;
            std::swap(qualities, tried);
            best = least;
            place = there;
            better = true;
        }
        if (!better) break;
    }
    if (!(best > old * 1.01F)) return bench.remember(v, smoother, 0.0F, Refusal::no_gain);
    if (!trial.positive(place, qualities))
        return bench.remember(v, smoother, 0.0F, Refusal::quality);
    c.move(v, place, star, qualities);
    return success;
}

Outcome split_vertex(Workbench& bench, VertexId v, VertexId w) {
    mesh::Complex& c = bench.complex;
    if (c.on_box(v)) return Refusal::box;
    auto& [star, group, concerned] = bench.vertex_split.get();
    c.star(v, star);
    const Vec3 direction = c.position(w) - c.position(v);
    mesh::Label label = 0;
    bool found = false;
    for (const TetId t : star) {
        if (!mesh::has_vertex(c.tet(t), w)) continue;
        label = c.label(t);
        found = true;
        break;
    }
    if (!found) return Refusal::not_applicable;
    // The half of the star towards w, inside one label, so the interface does not change.
    group.clear();
    for (const TetId t : star) {
        Vec3 centroid = -3.0 * c.position(v);
        for (const VertexId x : c.tet(t).v) {
            if (x != v) centroid += c.position(x);
        }
        if (c.label(t) == label && centroid.dot(direction) > 0.0) group.push_back(t);
    }
    if (group.empty()) return Refusal::not_applicable;
    const std::vector<mesh::RimFace> rim = mesh::rim_of(c, v, group);
    if (rim.empty()) return Refusal::not_applicable;
    if (!mesh::plan_vertex_split(c, v, group, rim, mesh::RimLabel::own, bench.limits.quality_floor,
                                 bench.edit)) {
        return Refusal::quality;
    }
    if (const Outcome o = bench.check_shape(0.0F, bench.old_quality()); o.refused()) return o;
    if (!c.link(bench.edit)) return Refusal::irregular;
    InterfaceChange change;
    // If the star's interface corner is in the group, the new vertex would take over the corner and
    // the geometry would change.
    if (c.on_interface(v)) {
        change = {(bench.edit.created_at - c.position(v)).norm(), bench.phase_change()};
        if (change.exceeds(bench.bounds_at(v, v))) return Refusal::bound;
        bench.cavity_interface_vertices(concerned);
        if (const Outcome o = bench.check_topology(concerned); o.refused()) return o;
        if (const Outcome o = check_creases(bench); o.refused()) return o;
        if (!(change.volume > 0.0)) change.distance = 0.0;
    }
    const VertexId created = bench.commit(change);
    if (bench.listener != nullptr) bench.listener->on_split(created, v, v, 0.0);
    return success;
}

}  // namespace dsc::kernel
