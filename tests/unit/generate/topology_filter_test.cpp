#include <algorithm>
#include <cmath>
#include <random>

#include <doctest/doctest.h>

#include <dsc/generate/topology_filter.hpp>

#include "implicit.hpp"

using namespace dsc;
using namespace dsc::mesh;
using namespace dsc::generate;
using namespace dsc::generate::implicit;

namespace {

constexpr double tau = 0.2;

// The counts, after they were compared with those of the interface as it is built.
TopologyCounts counted(const Sampled& s) {
    const TopologyCounts counts = count_topology(s.lattice.points(), s.tets, s.values);
    bool closed = false;
    const Counted built = march(s.tets, s.values, &closed);
    CHECK(static_cast<long>(counts.shells) == built.shells);
    CHECK(counts.euler == built.euler);
    CHECK(counts.closed == closed);
    return counts;
}

TopologyFilterReport filtered(Sampled& s) {
    const TopologyCounts before = counted(s);
    const std::vector<double> old = s.values;
    const TopologyFilterReport report = filter_topology(s.lattice.points(), s.tets, s.values, tau);
    CHECK(report.before == before);
    CHECK(report.after == counted(s));
    std::size_t in_clusters = 0, changed = 0;
    for (const RefusedCluster& c : report.clusters) {
        in_clusters += c.vertices.size();
        CHECK(c.level < tau);
    }
    for (std::size_t v = 0; v < old.size(); ++v) {
        if (old[v] == s.values[v]) continue;
        ++changed;
        CHECK(std::abs(old[v]) < tau);
        CHECK(std::abs(s.values[v]) == 1e-3);
    }
    CHECK(in_clusters == report.refused);
    CHECK(changed <= report.refused);
    return report;
}

void check_counts(const TopologyCounts& c, std::size_t components, std::size_t cavities,
                  long genus) {
    CHECK(c.components == components);
    CHECK(c.cavities == cavities);
    CHECK(c.shells == components + cavities);
    CHECK(c.genus() == genus);
    CHECK(c.closed);
}

}  // namespace

TEST_CASE("components, cavities and genus of known solids, which the filter leaves as they are") {
    struct Solid {
        Function distance;
        std::size_t components, cavities;
        long genus;
    };
    const std::vector<Solid> solids = {
        {[](const Vec3& x) { return ball(x, Vec3(0.1, 0, 0), 0.6); }, 1, 0, 0},
        {[](const Vec3& x) { return torus(x, 0.6, 0.25); }, 1, 0, 1},
        {[](const Vec3& x) {
             return std::max(ball(x, Vec3(0.6, 0, 0), 0.4), ball(x, Vec3(-0.6, 0.1, 0), 0.3));
         },
         2, 0, 0},
        {[](const Vec3& x) { return 0.15 - std::abs((x - Vec3(0, 0, 0.1)).norm() - 0.6); }, 1, 1,
         0},
        {[](const Vec3& x) {
             return std::max(0.15 - std::abs(x.norm() - 0.9), torus(x, 0.4, 0.15));
         },
         2, 1, 1},
    };
    for (std::size_t i = 0; i < solids.size(); ++i) {
        CAPTURE(i);
        const Solid& solid = solids[i];
        Sampled s = sample(0.06, solid.distance,
                           [&](const Vec3& x) { return clipped(solid.distance(x) / 0.12); });
        const std::vector<double> old = s.values;
        const TopologyFilterReport report = filtered(s);
        check_counts(report.before, solid.components, solid.cavities, solid.genus);
        CHECK(report.refused == 0);
        CHECK(s.values == old);
        CHECK(report.attachments.empty());
    }
}

TEST_CASE("an inside that reaches the box is not closed") {
    const Function half = [](const Vec3& x) { return x[2] - 0.07; };
    const Sampled s = sample(0.2, half, half);
    const TopologyCounts c = counted(s);
    CHECK_FALSE(c.closed);
    CHECK(c.components == 1);
    CHECK(c.cavities == 0);
    CHECK(c.euler == 1);  // a disc
}

TEST_CASE("a tunnel goes if its values are weak and stays if they are certain") {
    for (const double level : {-0.05, -0.3}) {
        CAPTURE(level);
        const Function distance = [](const Vec3& x) { return ball(x, Vec3::Zero(), 0.6); };
        const auto tunnel = [](const Vec3& x) {
            return std::hypot(x[0] - 0.013, x[1] + 0.02) - 0.08;
        };
        Sampled s = sample(
            0.05,
            [&](const Vec3& x) { return std::min(std::abs(distance(x)), std::abs(tunnel(x))); },
            [&](const Vec3& x) {
                const double solid = clipped(distance(x) / 0.1);
                return tunnel(x) < 0 && solid > 0 ? level : solid;
            });
        const TopologyFilterReport report = filtered(s);
        check_counts(report.before, 1, 0, 1);
        if (level > -tau) {
            check_counts(report.after, 1, 0, 0);
            REQUIRE(report.clusters.size() == 1);
            CHECK_FALSE(report.clusters[0].was_inside);
            CHECK(report.clusters[0].level <= 0.2);
            CHECK(std::hypot(report.clusters[0].place[0], report.clusters[0].place[1]) < 0.1);
        } else {
            check_counts(report.after, 1, 0, 1);
        }
    }
}

TEST_CASE("a bridge that closes a ring goes if its values are weak and stays if they are certain") {
    for (const double level : {0.05, 0.3}) {
        CAPTURE(level);
        const Function ring = [](const Vec3& x) { return torus(x, 0.6, 0.2); };
        Sampled s = sample(0.06, ring, [&](const Vec3& x) {
            const double solid = clipped(ring(x) / 0.1);
            return x[0] > 0 && std::abs(x[1]) < 0.1 && solid > 0 ? std::min(level, solid) : solid;
        });
        const TopologyFilterReport report = filtered(s);
        check_counts(report.before, 1, 0, 1);
        check_counts(report.after, 1, 0, level < tau ? 0 : 1);
        if (level > tau) continue;
        REQUIRE(report.clusters.size() == 1);
        CHECK(report.clusters[0].was_inside);
        CHECK((report.clusters[0].place - Vec3(0.6, 0, 0)).norm() < 0.15);
        CHECK(report.clusters[0].level == doctest::Approx(level));
        CHECK(report.attachments.empty());
    }
}

TEST_CASE("a witness keeps a weak bridge and a weak tunnel, with their values") {
    const Function ring = [](const Vec3& x) { return torus(x, 0.6, 0.2); };
    const Function ball_shape = [](const Vec3& x) { return ball(x, Vec3::Zero(), 0.6); };
    const auto tunnel = [](const Vec3& x) { return std::hypot(x[0] - 0.013, x[1] + 0.02) - 0.08; };
    const Sampled bridge = sample(0.06, ring, [&](const Vec3& x) {
        const double solid = clipped(ring(x) / 0.1);
        return x[0] > 0 && std::abs(x[1]) < 0.1 && solid > 0 ? std::min(0.05, solid) : solid;
    });
    const Sampled drilled = sample(
        0.05, [&](const Vec3& x) { return std::min(std::abs(ball_shape(x)), std::abs(tunnel(x))); },
        [&](const Vec3& x) {
            const double solid = clipped(ball_shape(x) / 0.1);
            return tunnel(x) < 0 && solid > 0 ? -0.05 : solid;
        });
    for (const bool inside : {true, false}) {
        CAPTURE(inside);
        const Sampled& solid = inside ? bridge : drilled;
        std::vector<double> values = solid.values;
        std::size_t asked = 0;
        const auto keep = [&](const RefusedCluster& cluster) {
            ++asked;
            CHECK(cluster.was_inside == inside);
            CHECK_FALSE(cluster.vertices.empty());
            for (const std::uint32_t v : cluster.vertices) CHECK((solid.values[v] > 0) == inside);
            return true;
        };
        const TopologyFilterReport report =
            filter_topology(solid.lattice.points(), solid.tets, values, tau, keep);
        CHECK(asked == 1);
        CHECK(report.confirmed.size() == 1);
        CHECK(report.clusters.empty());
        CHECK(report.refused == 0);
        CHECK(values == solid.values);
        check_counts(report.after, 1, 0, 1);
    }
}

TEST_CASE(
    "a single bridge stays and is reported with its level, and so is an opening to a cavity") {
    for (const double sign : {1.0, -1.0}) {
        CAPTURE(sign);
        // Two balls and a rod between them, or a hollow in a ball and a channel out of it.
        const Vec3 a(-0.5, 0, 0), b(0.5, 0, 0);
        const auto rod = [&](const Vec3& x) {
            return x[0] > (sign > 0 ? -0.5 : 0) && x[0] < (sign > 0 ? 0.5 : 1)
                       ? 0.1 - std::hypot(x[1], x[2])
                       : -1;
        };
        const Function solid = [&](const Vec3& x) {
            return sign > 0 ? std::max(ball(x, a, 0.4), ball(x, b, 0.35))
                            : std::min(ball(x, Vec3::Zero(), 0.8), x.norm() - 0.4);
        };
        Sampled s = sample(
            0.05, [&](const Vec3& x) { return std::min(std::abs(solid(x)), std::abs(rod(x))); },
            [&](const Vec3& x) {
                const double f = clipped(solid(x) / 0.1);
                return rod(x) > 0 && sign * f < 0.12 ? sign * 0.12 : f;
            });
        const TopologyFilterReport report = filtered(s);
        check_counts(report.before, 1, 0, 0);
        check_counts(report.after, 1, 0, 0);
        REQUIRE(report.attachments.size() == 1);
        const Attachment& part = report.attachments[0];
        CHECK(part.inside == (sign > 0));
        CHECK(part.level == doctest::Approx(0.12));
        CHECK(std::hypot(part.place[1], part.place[2]) < 0.1);
        // The smaller ball, or the hollow.
        const auto points = s.lattice.points();
        std::size_t vertices = 0;
        for (std::size_t v = 0; v < points.size(); ++v) {
            const bool there = sign > 0 ? (points[v] - b).norm() < 0.35 : points[v].norm() < 0.5;
            vertices += there && sign * s.values[v] >= tau ? 1 : 0;
        }
        CHECK(part.vertices == vertices);
        CHECK(weakest_attachment(report, sign > 0, vertices)->level == part.level);
        CHECK(report.inside.has_value() == (sign > 0));
        CHECK(report.outside.has_value() == (sign < 0));
        CHECK_FALSE(weakest_attachment(report, sign > 0, vertices + 1));
        CHECK_FALSE(weakest_attachment(report, sign < 0, 0));
    }
}

TEST_CASE("handles that noise makes go, those of the solid stay; the order of the tets has no "
          "influence") {
    for (const unsigned seed : {1U, 2U, 3U}) {
        CAPTURE(seed);
        const Function ring = [](const Vec3& x) { return torus(x, 0.6, 0.25); };
        std::mt19937 random(seed);
        std::uniform_real_distribution<double> noise(-0.18, 0.18);
        // Weak values in a broad layer, in which the noise decides.
        Sampled s = sample(0.06, ring, [&](const Vec3& x) {
            const double d = ring(x);
            return std::abs(d) < 0.12 ? noise(random) : clipped(d / 0.2);
        });
        Sampled shuffled{GradedLattice({}, {}, ""), s.tets, s.values, {}};
        std::shuffle(shuffled.tets.begin(), shuffled.tets.end(), random);
        const TopologyFilterReport report = filtered(s);
        CHECK(report.before.genus() > 5);
        CHECK(report.after.genus() == 1);
        CHECK(report.refused > 5);
        filter_topology(s.lattice.points(), shuffled.tets, shuffled.values, tau);
        CHECK(shuffled.values == s.values);
    }
}
