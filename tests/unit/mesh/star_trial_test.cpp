// Places tried for a vertex: the same bits as the quality of single tets, in the order of the star.
#include <cmath>
#include <cstring>

#include <doctest/doctest.h>

#include <dsc/base/random.hpp>
#include <dsc/mesh/adopt.hpp>
#include <dsc/mesh/star_trial.hpp>

#include "meshes.hpp"

using namespace dsc;
using mesh::TetId;
using mesh::VertexId;

namespace {

// A grid whose inner vertices are displaced at random; `scale` is the length of a cell.
mesh::Complex displaced_grid(double scale) {
    mesh::TetMesh m = test::grid(6, 3.0 * scale, [](const Vec3&) { return 0; });
    RandomStream random(RandomKey{7, 1, 0, 0});
    for (Vec3& p : m.points) {
        if (p.cwiseAbs().maxCoeff() > 2.9 * scale) continue;
        for (unsigned k = 0; k < 3; ++k) p[k] += 0.3 * scale * (random.uniform() - 0.5);
    }
    return mesh::adopt(m, "grid");
}

template <class Real>
bool same_bits(Real x, Real y) {
    return std::memcmp(&x, &y, sizeof x) == 0;
}

float plain_quality(const mesh::Complex& c, TetId t, VertexId v, const Vec3& place) {
    return static_cast<float>(mesh::quality_of(mesh::corners_at(c, t, v, place)));
}

}  // namespace

TEST_CASE("a copied star gives the bits of single tets, for any number of tets") {
    for (const double scale : {1.0, 1e-7, 1e9}) {
        CAPTURE(scale);
        const mesh::Complex c = displaced_grid(scale);
        RandomStream random(RandomKey{11, 2, 0, 0});
        mesh::StarCopy copy;
        std::size_t compared = 0, inverted = 0;
        std::vector<TetId> star;
        for (VertexId v = 0; v < c.vertex_slots(); ++v) {
            if (c.on_box(v)) continue;
            c.star(v, star);
            const std::size_t count = 1 + v % star.size();  // odd and even
            copy.gather(c, std::span(star).first(count), v);
            for (int n = 0; n < 4; ++n) {
                Vec3 place = c.position(v);
                for (unsigned k = 0; k < 3; ++k) place[k] += 1.5 * scale * (random.uniform() - 0.5);
                copy.move(place);
                std::size_t next = 0;
                double least = INFINITY;
                CHECK(copy.qualities([&](std::size_t i, double q) {
                    REQUIRE(i == next++);
                    const auto p = mesh::corners_at(c, star[i], v, place);
                    const geometry::TetShape tet = geometry::tet_shape(*p[0], *p[1], *p[2], *p[3]);
                    CHECK(same_bits(q, tet.quality));
                    least = std::min(least, tet.mean_square);
                    inverted += q < 0.0 ? 1 : 0;
                    ++compared;
                    return true;
                }));
                CHECK(next == count);
                CHECK(same_bits(copy.least_mean_square(), least));
            }
        }
        CHECK(compared > 1000);
        CHECK(inverted > 10);
    }
}

TEST_CASE("a trial accepts what every tet accepts, also the second and third place") {
    const mesh::Complex c = displaced_grid(1.0);
    RandomStream random(RandomKey{13, 3, 0, 0});
    mesh::StarCopy copy;
    std::vector<TetId> star;
    std::size_t accepted = 0, refused = 0;
    for (VertexId v = 0; v < c.vertex_slots(); ++v) {
        if (c.on_box(v)) continue;
        c.star(v, star);
        mesh::StarTrial trial(c, star, v, copy);
        std::vector<float> qualities(star.size());
        for (int n = 0; n < 5; ++n) {
            Vec3 place = c.position(v);
            for (unsigned k = 0; k < 3; ++k) place[k] += 1.6 * (random.uniform() - 0.5);
            const float bound = 0.1F;
            const bool all = trial.accepts(place, [&](std::size_t i, float q) {
                qualities[i] = q;
                return q > bound;
            });
            bool expected = true, positive = true;
            for (std::size_t i = 0; i < star.size(); ++i) {
                expected = expected && plain_quality(c, star[i], v, place) > bound;
                positive =
                    positive && mesh::exactly_positive(mesh::corners_at(c, star[i], v, place));
            }
            CHECK(all == expected);
            ++(all ? accepted : refused);
            if (!all) continue;
            CHECK(trial.positive(place, qualities) == positive);
            for (std::size_t i = 0; i < star.size(); ++i)
                CHECK(same_bits(qualities[i], plain_quality(c, star[i], v, place)));
        }
    }
    CHECK(accepted > 100);
    CHECK(refused > 100);
}

TEST_CASE("a flat tet is not positive, whatever the others are") {
    const mesh::Complex c = displaced_grid(1.0);
    mesh::StarCopy copy;
    std::vector<TetId> star;
    for (VertexId v = 0; v < c.vertex_slots(); ++v) {
        if (c.on_box(v)) continue;
        c.star(v, star);
        // Onto a neighbour: the tets that contain both have no volume.
        const auto& corners = c.tet(star.front()).v;
        const Vec3 place = c.position(corners[0] == v ? corners[1] : corners[0]);
        mesh::StarTrial trial(c, star, v, copy);
        std::vector<float> qualities(star.size());
        CHECK(trial.accepts(place, [&](std::size_t i, float q) {
            qualities[i] = q;
            return true;
        }));
        CHECK_FALSE(trial.positive(place, qualities));
    }
}
