// The classes on single tets, in any position and numbering.
#include "tet_shape.hpp"

#include <algorithm>
#include <cmath>

#include <doctest/doctest.h>

#include <dsc/base/random.hpp>

using dsc::RandomStream;
using dsc::Vec3;
using dsc::improvement::classify;
using dsc::improvement::FlatClass;
using dsc::improvement::ShapeLimits;
using dsc::improvement::TetShape;

namespace {

using Points = std::array<Vec3, 4>;
constexpr double huge_length = 1e9;  // L does not matter: the tet is smaller

RandomStream stream(std::uint64_t n) {
    return RandomStream(dsc::RandomKey{7, dsc::stream_id("tet shapes"), 0, n});
}

Eigen::Matrix3d rotation(RandomStream& random) {
    Eigen::Vector4d q;
    for (int i = 0; i < 4; ++i) q[i] = random.normal();
    q.normalize();
    return Eigen::Quaterniond(q[0], q[1], q[2], q[3]).toRotationMatrix();
}

// The same tet rotated, moved, scaled and renumbered: `order[i]` is the new index of vertex i.
struct Disguise {
    Points points;
    std::array<std::uint8_t, 4> order{0, 1, 2, 3};
};
Disguise disguise(const Points& p, RandomStream& random, double scale) {
    Disguise out;
    for (std::uint8_t i = 3; i > 0; --i) std::swap(out.order[i], out.order[random.index(i + 1U)]);
    const Eigen::Matrix3d turn = rotation(random);
    const Vec3 shift(random.normal(), random.normal(), random.normal());
    for (std::size_t i = 0; i < 4; ++i) out.points[out.order[i]] = scale * (turn * p[i]) + shift;
    return out;
}

std::array<std::uint8_t, 2> sorted(std::uint8_t a, std::uint8_t b) {
    return {std::min(a, b), std::max(a, b)};
}
std::array<std::uint8_t, 2> sorted(const std::array<std::uint8_t, 2>& e) {
    return sorted(e[0], e[1]);
}

// A flat tet in the plane z = 0 except its vertex 3, which is `height` above the plane.
Points flat(double x, double y, double height) {
    return {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0.4, 0.8, 0), Vec3(x, y, height)};
}

template <class Check>
void in_every_disguise(const Points& p, Check check) {
    for (std::uint64_t n = 0; n < 200; ++n) {
        RandomStream random = stream(n);
        const double scale = std::pow(10.0, 4.0 * random.uniform() - 2.0);
        const Disguise d = disguise(p, random, scale);
        check(classify(d.points, huge_length, {}), d.order);
    }
}

}  // namespace

TEST_CASE("wedge: the short edge is found") {
    in_every_disguise(flat(0.02, 0.01, 0.02), [](const TetShape& shape, const auto& order) {
        REQUIRE(shape.flat_class == FlatClass::wedge);
        REQUIRE(sorted(shape.edge) == sorted(order[0], order[3]));
    });
}

TEST_CASE("tee: the vertex and the edge that it lies on are found") {
    // On the edge (0, 1), a little inside, on it, a little outside the face.
    for (const double y : {0.03, 0.0, -0.03}) {
        in_every_disguise(flat(0.5, y, 0.02), [](const TetShape& shape, const auto& order) {
            REQUIRE(shape.flat_class == FlatClass::tee);
            REQUIRE(sorted(shape.edge) == sorted(order[0], order[1]));
            REQUIRE(shape.vertex == order[3]);
            REQUIRE(shape.opposite == order[2]);
        });
    }
}

TEST_CASE("cap: the vertex that lies in the face of the others is found") {
    in_every_disguise(flat(0.45, 0.28, 0.03), [](const TetShape& shape, const auto& order) {
        REQUIRE(shape.flat_class == FlatClass::cap);
        REQUIRE(shape.vertex == order[3]);
        REQUIRE(shape.altitude == doctest::Approx(0.03 / 1.0).epsilon(1e-6));
    });
}

TEST_CASE("sliver: the two edges that cross are found") {
    in_every_disguise(flat(0.5, -0.4, 0.03), [](const TetShape& shape, const auto& order) {
        REQUIRE(shape.flat_class == FlatClass::sliver);
        const auto one = sorted(shape.edge), other = sorted(shape.vertex, shape.opposite);
        const auto first = sorted(order[0], order[1]), second = sorted(order[2], order[3]);
        REQUIRE(((one == first && other == second) || (one == second && other == first)));
    });
}

TEST_CASE("a kite's diagonals are found though they are not its two longest edges") {
    // The diagonals are 2 and 0.6 long, two of the sides 1.65.
    const Points kite = {Vec3(-1, 0, 0), Vec3(1, 0, 0), Vec3(-0.6, 0.3, 0.02),
                         Vec3(-0.6, -0.3, 0.02)};
    in_every_disguise(kite, [](const TetShape& shape, const auto& order) {
        REQUIRE(shape.flat_class == FlatClass::sliver);
        const auto one = sorted(shape.edge), other = sorted(shape.vertex, shape.opposite);
        const auto first = sorted(order[0], order[1]), second = sorted(order[2], order[3]);
        REQUIRE(((one == first && other == second) || (one == second && other == first)));
    });
}

TEST_CASE("the borders are at the limits") {
    const double longest = 1.0;
    const auto class_of = [&](const Points& p) { return classify(p, huge_length, {}).flat_class; };
    const ShapeLimits limits;
    CHECK(class_of(flat(0.99 * limits.wedge * longest, 0.0, 0.0)) == FlatClass::wedge);
    CHECK(class_of(flat(1.01 * limits.wedge * longest, 0.0, 0.0)) == FlatClass::tee);
    CHECK(class_of(flat(0.45, 0.99 * limits.tee * longest, 0.0)) == FlatClass::tee);
    CHECK(class_of(flat(0.45, 1.01 * limits.tee * longest, 0.0)) == FlatClass::cap);
    CHECK(class_of(flat(0.45, -1.01 * limits.tee * longest, 0.0)) == FlatClass::sliver);
    CHECK(classify(flat(0.5, 0.3, 0.0), huge_length, {0.0, 0.0}).flat_class == FlatClass::cap);
}

TEST_CASE("a tet that extends far is classified by L, not by its length") {
    // Three vertices of a fine interface, and the fourth at a corner of the box, ten edges away; L
    // is 0.1.
    const Points spike = {Vec3(0, 0, 0), Vec3(0.1, 0, 0), Vec3(0.05, 0.087, 0),
                          Vec3(0.05, 0.03, 1)};
    const TetShape shape = classify(spike, 0.1, {});
    CHECK(shape.flat_class != FlatClass::wedge);
    CHECK(shape.altitude > 0.7);
    CHECK(classify(spike, huge_length, {}).flat_class == FlatClass::wedge);
    // Pressed flat, its class follows from its shape in the plane: the far vertex sees one edge or
    // two.
    const Points quad = {Vec3(0, 0, 0), Vec3(0.1, 0, 0), Vec3(0.05, 0.087, 0.001),
                         Vec3(0.05, -1, 0)};
    CHECK(classify(quad, 0.1, {}).flat_class == FlatClass::sliver);
    CHECK(classify(quad, 0.1, {}).altitude < 0.05);
    const Points triangle = {Vec3(0, 0, 0), Vec3(0.1, 0, 0), Vec3(0.05, 0.087, 0.001),
                             Vec3(0.05, 1, 0)};
    CHECK(classify(triangle, 0.1, {}).flat_class == FlatClass::cap);
}

TEST_CASE("coinciding points give finite answers") {
    const Points one = {Vec3(1, 2, 3), Vec3(1, 2, 3), Vec3(1, 2, 3), Vec3(1, 2, 3)};
    CHECK(classify(one, 1.0, {}).flat_class == FlatClass::wedge);
    CHECK(classify(one, 1.0, {}).altitude == 0.0);
    const Points line = {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(2, 0, 0), Vec3(3, 0, 0)};
    CHECK(classify(line, 1.0, {}).altitude == 0.0);
    CHECK(classify(line, 1.0, {}).flat_class == FlatClass::tee);
}

TEST_CASE("random flat tets: the class agrees with the shape in the plane") {
    std::array<int, 4> seen{};
    for (std::uint64_t n = 0; n < 5000; ++n) {
        RandomStream random = stream(n + 1000);
        Points p;
        for (Vec3& x : p) x = Vec3(random.uniform(), random.uniform(), 1e-9 * random.uniform());
        const TetShape shape = classify(p, huge_length, {});
        ++seen[static_cast<std::size_t>(shape.flat_class)];
        if (shape.flat_class != FlatClass::cap && shape.flat_class != FlatClass::sliver) continue;
        // Convex position: a segment between two of the points crosses the one between the others.
        const auto side = [&](std::size_t a, std::size_t b, std::size_t c) {
            return (p[b] - p[a]).head<2>().x() * (p[c] - p[a]).y() -
                   (p[b] - p[a]).y() * (p[c] - p[a]).x();
        };
        bool crossing = false;
        for (const auto& [a, b, c, d] :
             {std::array<std::size_t, 4>{0, 1, 2, 3}, {0, 2, 1, 3}, {0, 3, 1, 2}}) {
            crossing = crossing ||
                       (side(a, b, c) * side(a, b, d) < 0 && side(c, d, a) * side(c, d, b) < 0);
        }
        REQUIRE(crossing == (shape.flat_class == FlatClass::sliver));
    }
    for (const int count : seen) CHECK(count > 100);
}
