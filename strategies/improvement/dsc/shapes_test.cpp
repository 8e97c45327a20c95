// The thresholds of edges, faces and large tets: the requests, counted again from positions.
#include "shapes.hpp"

#include <cmath>
#include <vector>

#include <doctest/doctest.h>

#include <dsc/geometry/quality.hpp>

namespace {

using namespace dsc;
using repair::Operation;

// Two tets of two labels: their common face, the given triangle, is the interface. They do not fill
// a box, which the code under test does not need.
mesh::Complex two_tets(const Vec3& a, const Vec3& b, const Vec3& c) {
    const Vec3 middle = (a + b + c) / 3.0, up = (b - a).cross(c - a).normalized();
    // The face that two tets share lies opposite corner 3 of both.
    const LargeVector<mesh::TetCorners> tets = {{0, 1, 2, 3}, {0, 2, 1, 4}};
    const LargeVector<mesh::TetNeighbours> neighbours = {
        {mesh::none, mesh::none, mesh::none, 1U << 2U | 3U},
        {mesh::none, mesh::none, mesh::none, 0U << 2U | 3U}};
    const std::array<mesh::Label, 2> labels = {1, 0};
    const mesh::Complex complex =
        mesh::Complex::assemble({a, b, c, middle + up, middle - up}, tets, neighbours, labels);
    REQUIRE(complex.volume(0) > 0.0);
    return complex;
}

std::vector<repair::Request> shape_proposals(const mesh::Complex& c,
                                             const improvement::ShapeLimits& limits,
                                             double target_length = 1.0) {
    std::vector<mesh::TetId> dirty;
    for (mesh::TetId t = 0; t < c.tet_slots(); ++t) dirty.push_back(t);
    const repair::RepairRound round{c, dirty, {}, {}, {}, target_length, 0.995, 0, true};
    std::vector<repair::Request> out;
    improvement::ShapeProposals(limits).write(round, {0.03F, 0.2F}, out);
    return out;
}

double length(const mesh::Complex& c, const repair::Request& r) {
    return (c.position(r.vertices[0]) - c.position(r.vertices[1])).norm();
}

const Vec3 left(0, 0, 0), right(1, 0, 0), top(0.5, std::sqrt(0.75), 0);

}  // namespace

TEST_CASE("without thresholds nothing is requested") {
    CHECK_FALSE(improvement::ShapeLimits{}.any());
    CHECK(shape_proposals(two_tets(left, Vec3(1e-3, 0, 0), top), {}).empty());
}

TEST_CASE(
    "short edges are collapsed, shortest first, each once, the degenerate ones within the bounds") {
    const mesh::Complex c = two_tets(left, Vec3(0.05, 0, 0), Vec3(0.0, 0.3, 0));
    improvement::ShapeLimits limits;
    limits.degenerate_edge_quality = 0.1;
    limits.min_edge_quality = 0.5;
    const auto requests = shape_proposals(c, limits);
    REQUIRE(requests.size() == 3);  // the triangle's edges: 0.05, 0.3 and a little more
    for (const repair::Request& r : requests) CHECK(r.operation == Operation::edge_collapse);
    CHECK(requests[0].mode == repair::CollapseMode::bounded);
    CHECK(length(c, requests[0]) == doctest::Approx(0.05));
    CHECK(requests[1].mode == repair::CollapseMode::safe);
    CHECK(length(c, requests[1]) == doctest::Approx(0.3));
    CHECK(length(c, requests[2]) == doctest::Approx(std::hypot(0.05, 0.3)));
    // Lengths are in target lengths.
    CHECK(shape_proposals(c, limits, 0.01).empty());
}

TEST_CASE("a needle loses its shortest edge, a cap its longest") {
    improvement::ShapeLimits limits;
    limits.degenerate_face_quality = 0.01;
    const mesh::Complex needle = two_tets(left, Vec3(0.05, 0, 0), Vec3(0.025, 1, 0));
    auto requests = shape_proposals(needle, limits);
    REQUIRE(requests.size() == 3);  // the triangle and its neighbours at the short edge
    for (const repair::Request& r : requests) {
        CHECK(r.operation == Operation::edge_collapse);
        CHECK(r.mode == repair::CollapseMode::bounded);
        CHECK(length(needle, r) == doctest::Approx(0.05));
    }

    const mesh::Complex cap = two_tets(left, right, Vec3(0.5, 0.03, 0));
    requests = shape_proposals(cap, limits);
    REQUIRE(requests.size() == 2);
    CHECK(requests[0].operation == Operation::edge_removal);
    CHECK(requests[1].operation == Operation::interface_flip);
    for (const repair::Request& r : requests) CHECK(length(cap, r) == doctest::Approx(1.0));

    // 1 - cos of the sharpest angle, 0.5 for a regular triangle.
    limits.degenerate_face_quality = 0.0;
    limits.min_face_quality = 0.499;
    // the faces at the apexes are not regular
    CHECK(shape_proposals(two_tets(left, right, top), limits).size() == 6);
    limits.degenerate_face_quality = 0.4999;
    CHECK(shape_proposals(two_tets(left, right, top), limits).size() == 6);
    limits.degenerate_face_quality = 0.5;
    CHECK(shape_proposals(two_tets(left, right, 0.999 * top), limits).size() == 7);
    limits.degenerate_face_quality = 0.0;
    limits.min_face_quality = 0.01;
    requests = shape_proposals(needle, limits);
    REQUIRE(requests.size() == 3);
    for (const repair::Request& r : requests) CHECK(r.mode == repair::CollapseMode::safe);
}

TEST_CASE("interface faces are kept between two areas") {
    // The faces of the tet with label 1, in regular triangles of edge `unit`: faces at the hull
    // count as interface.
    const auto beyond = [](const mesh::Complex& c, double least, double most, double unit) {
        std::ptrdiff_t count = 0;
        for (const auto& f : mesh::face_vertices) {
            const auto& v = c.tet(0).v;
            const Vec3 a = c.position(v[f[0]]);
            const double area = 0.5 *
                                (c.position(v[f[1]]) - a).cross(c.position(v[f[2]]) - a).norm() /
                                (std::sqrt(3.0) / 4.0 * unit * unit);
            count += area < least || area > most ? 1 : 0;
        }
        return count;
    };
    improvement::ShapeLimits limits;
    limits.min_face_area = 0.5;
    limits.max_face_area = 2.0;
    CHECK(shape_proposals(two_tets(left, right, top), limits).empty());
    for (const double size : {0.1, 0.5, 0.8, 2.0, 5.0}) {
        CAPTURE(size);
        const mesh::Complex c = two_tets(size * left, size * right, size * top);
        const auto requests = shape_proposals(c, limits);
        CHECK(static_cast<std::ptrdiff_t>(requests.size()) == beyond(c, 0.5, 2.0, 1.0));
        double last = size < 1.0 ? 0.0 : INFINITY;
        for (const repair::Request& r : requests) {
            CHECK(r.operation == (size < 1.0 ? Operation::edge_collapse : Operation::edge_split));
            if (size > 1.0) CHECK(length(c, r) <= last + 1e-3);
            last = length(c, r);
        }
        CHECK(static_cast<std::ptrdiff_t>(shape_proposals(c, limits, 0.5).size()) ==
              beyond(c, 0.5, 2.0, 0.5));
    }
}

TEST_CASE("large tets are split at their longest edge, the largest first") {
    const mesh::Complex c = two_tets(left, right, top);
    const double regular = geometry::regular_tet_volume(1.0);
    improvement::ShapeLimits limits;
    limits.max_tet_volume = 1.01 * c.volume(0) / regular;
    CHECK(shape_proposals(c, limits).empty());
    limits.max_tet_volume = 0.99 * c.volume(0) / regular;
    const auto requests = shape_proposals(c, limits);
    REQUIRE(requests.size() == 2);
    for (const repair::Request& r : requests) {
        CHECK(r.operation == Operation::edge_split);
        for (const auto& e : mesh::edge_vertices) {
            const auto& v = c.tet(r.tet).v;
            CHECK(length(c, r) >= (c.position(v[e[0]]) - c.position(v[e[1]])).norm() - 1e-12);
        }
    }
}
