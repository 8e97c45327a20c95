// Each operation on its own, against geometry that is known.
#include "kernel/operations.hpp"

#include <algorithm>
#include <cmath>

#include <doctest/doctest.h>

#include <dsc/geometry/quality.hpp>
#include <dsc/mesh/validate.hpp>

#include "kernel/triangulations.hpp"
#include "shapes.hpp"

using namespace dsc;
using namespace dsc::kernel;
using mesh::Complex;

namespace {

Workbench& prepare(Workbench& bench, double length = 0.4) {
    bench.limits = {length, 1e-3, 0.5 * length, geometry::regular_tet_volume(length), 0.995};
    return bench;
}

bool valid(const Complex& c) {
    const mesh::ComplexReport report = mesh::validate(c);
    for (const auto& fault : report.faults) MESSAGE(fault);
    return report.valid();
}

// The inner vertex of a 2-cell patch of the block's face x = high whose faces are exactly planar.
VertexId flat_vertex(const Complex& c) {
    for (const VertexId v : c.interface_vertices()) {
        const Vec3& p = c.position(v);
        if (std::abs(p.x() - 0.75) < 1e-9 && p.tail<2>().cwiseAbs().maxCoeff() < 0.4) return v;
    }
    return mesh::none;
}

}  // namespace

TEST_CASE("triangulations of polygons: each has n - 2 triangles and covers the polygon") {
    for (std::size_t n = 3; n <= max_polygon; ++n) {
        const Triangulations& table = triangulations(n);
        for (std::size_t m = 0; m < table.count; ++m) {
            double area = 0.0;
            std::size_t triangles = 0;
            for (std::size_t k = 0; k < table.triangle_count; ++k) {
                if ((table.masks[m] >> k & 1U) == 0) continue;
                ++triangles;
                const auto corner = [&](std::size_t i) {
                    const double a =
                        2 * 3.14159265358979 * static_cast<double>(i) / static_cast<double>(n);
                    return Vec3(std::cos(a), std::sin(a), 0.0);
                };
                area += geometry::triangle_area(corner(table.triangles[k].i),
                                                corner(table.triangles[k].j),
                                                corner(table.triangles[k].k));
            }
            CHECK(triangles == n - 2);
            const double whole = 0.5 * static_cast<double>(n) *
                                 std::sin(2 * 3.14159265358979 / static_cast<double>(n));
            CHECK(area == doctest::Approx(whole));
            for (std::size_t other = 0; other < m; ++other)
                CHECK(table.masks[other] != table.masks[m]);
        }
    }
}

TEST_CASE("edge removal undoes an edge split of a ring, 3-2 flips undo 2-3 flips") {
    Complex c = test::labelled_meshes().front().complex;
    Workbench bench(c);
    prepare(bench);
    const std::size_t tets = c.tet_count();
    std::size_t done = 0;
    for (TetId t = 0; t < 400 && done < 20; ++t) {
        // After the two operations the slot of t may be empty.
        for (unsigned f = 0; f < 4 && done < 20 && c.tet_alive(t); ++f) {
            const std::uint32_t code = c.across(t, f);
            if (code == mesh::none) continue;
            const VertexId a = c.tet(t).v[f],
                           b = c.tet(mesh::neighbour_tet(code)).v[mesh::neighbour_face(code)];
            if (remove_faces(bench, t, f, 0.0F).refused()) continue;
            REQUIRE(valid(c));
            const TetId edge = c.find_edge(a, b);
            REQUIRE(edge != mesh::none);
            REQUIRE_FALSE(remove_edge(bench, edge, a, b, 0.0F).refused());
            REQUIRE(c.find_edge(a, b) == mesh::none);
            ++done;
        }
    }
    CHECK(done >= 10);
    CHECK(c.tet_count() == tets);
    CHECK(valid(c));
}

TEST_CASE("face removal takes the named face and no other") {
    Complex c = test::labelled_meshes().front().complex;
    Workbench bench(c);
    prepare(bench);
    std::size_t done = 0, refused = 0;
    for (TetId t = 0; t < 400 && done < 20; ++t) {
        for (unsigned f = 0; f < 4; ++f) {
            if (!c.tet_alive(t) || c.across(t, f) == mesh::none) continue;
            repair::Request request;
            request.operation = repair::Operation::face_removal;
            request.tet = t;
            request.birth_date = c.birth_date(t);
            request.accept_above = 0.0F;
            for (unsigned k = 0; k < 3; ++k)
                request.vertices[k] = c.tet(t).v[mesh::face_vertices[f][k]];
            const VertexId a = c.tet(t).v[f], b = c.tet(mesh::neighbour_tet(c.across(t, f)))
                                                      .v[mesh::neighbour_face(c.across(t, f))];
            if (execute(bench, request).refused()) {
                ++refused;
                continue;
            }
            REQUIRE(c.find_edge(a, b) != mesh::none);
            REQUIRE(valid(c));
            ++done;
        }
    }
    CHECK(done >= 10);
    CHECK(refused > 0);
    repair::Request elsewhere;
    elsewhere.operation = repair::Operation::face_removal;
    elsewhere.tet = c.seed(0);
    elsewhere.birth_date = c.birth_date(elsewhere.tet);
    const auto far = static_cast<VertexId>(c.vertex_slots() - 1);
    elsewhere.vertices = {0, far, far};
    CHECK(execute(bench, elsewhere) == Refusal::stale);
}

TEST_CASE("a compound with a named vertex or edge repairs that; its gain and least edge are kept") {
    const Complex start = test::labelled_meshes().front().complex;
    // A free vertex almost in a face of its link, and two edges of a tet that almost cross.
    const auto flatten = [](Complex& c, VertexId v, const Vec3& target, double part) {
        std::vector<TetId> star;
        c.star(v, star);
        c.move(v, c.position(v) + part * (target - c.position(v)), star);
    };
    const auto request_of = [](const Complex& c, TetId t, std::array<VertexId, 3> vertices) {
        repair::Request request;
        request.operation = repair::Operation::compound;
        request.tet = t;
        request.birth_date = c.birth_date(t);
        request.vertices = vertices;
        return request;
    };
    std::size_t caps = 0;
    for (TetId t = 0; t < start.tet_slots() && caps < 10; ++t) {
        for (unsigned f = 0; f < 4; ++f) {
            Complex c = start;
            Workbench bench(c);
            prepare(bench);
            const VertexId v = c.tet(t).v[f];
            if (c.on_interface(v) || c.on_box(v) || c.across(t, f) == mesh::none) continue;
            Vec3 centroid = Vec3::Zero();
            for (unsigned k = 0; k < 3; ++k)
                centroid += c.position(c.tet(t).v[mesh::face_vertices[f][k]]) / 3.0;
            flatten(c, v, centroid, 0.97);
            const float old = c.quality(t);
            repair::Request request = request_of(c, t, {v, mesh::none, mesh::none});
            request.gain = 2.0F / old;  // no tet is twice as good as a regular one
            CHECK(execute(bench, request) == Refusal::quality);
            request.gain = 2.0F;
            request.least_edge = 10.0F;
            CHECK(execute(bench, request) == Refusal::bound);
            request.least_edge = 0.01F;
            const std::size_t vertices = c.vertex_count();
            if (execute(bench, request).refused()) continue;
            ++caps;
            const bool there = c.vertex_alive(v) && c.birth(v) == start.birth(v);
            CHECK_FALSE(there);
            CHECK(c.vertex_count() == vertices);
            for (const TetId added : c.last_added()) CHECK(c.quality(added) > 2.0F * old);
            CHECK(valid(c));
        }
    }
    CHECK(caps >= 10);

    std::size_t slivers = 0;
    for (TetId t = 0; t < start.tet_slots() && slivers < 10; ++t) {
        Complex c = start;
        Workbench bench(c);
        prepare(bench);
        const auto v = c.tet(t).v;
        if (std::any_of(v.begin(), v.end(), [&](VertexId x) { return c.on_box(x); }) ||
            c.quality(t) < 0.9F)
            continue;
        // The regular tet: its first two vertices towards the others, so that the two edges almost
        // meet.
        const Vec3 across =
            0.5 * (c.position(v[2]) + c.position(v[3]) - c.position(v[0]) - c.position(v[1]));
        flatten(c, v[0], c.position(v[0]) + across, 0.48);
        flatten(c, v[1], c.position(v[1]) + across, 0.48);
        flatten(c, v[2], c.position(v[2]) - across, 0.48);
        flatten(c, v[3], c.position(v[3]) - across, 0.48);
        REQUIRE(valid(c));
        // Another pair of opposite edges is as far apart as before: its common vertex would invert
        // tets.
        CHECK(execute(bench, request_of(c, t, {v[0], v[2], mesh::none})) == Refusal::quality);
        repair::Request request = request_of(c, t, {v[2], v[3], mesh::none});
        const std::size_t vertices = c.vertex_count();
        if (execute(bench, request).refused()) continue;
        ++slivers;
        CHECK(c.vertex_count() == vertices + 1);
        CHECK(c.find_edge(v[0], v[1]) == mesh::none);
        CHECK(c.find_edge(v[2], v[3]) == mesh::none);
        CHECK(valid(c));
    }
    CHECK(slivers >= 10);
}

TEST_CASE("the box never changes: its edges and faces are refused") {
    Complex c = test::labelled_meshes().front().complex;
    Workbench bench(c);
    prepare(bench);
    const TetId corner = c.seed(0);
    VertexId along = mesh::none;
    for (const VertexId v : c.tet(corner).v) {
        if (v != 0 && c.on_box(v)) along = v;
    }
    REQUIRE(along != mesh::none);
    CHECK(split_edge(bench, corner, 0, along, 0.5) == Refusal::box);
    CHECK(collapse_edge(bench, corner, 0, along, repair::CollapseMode::bounded, 0.0F) ==
          Refusal::box);
    CHECK(remove_edge(bench, corner, 0, along, 0.0F) == Refusal::box);
    CHECK(flip_interface_edge(bench, corner, 0, along, 0.0F) == Refusal::box);
    CHECK(smooth_laplacian(bench, 0, 0.0F) == Refusal::box);
    CHECK(smooth_optimise(bench, 0) == Refusal::box);
    CHECK(split_vertex(bench, 0, along) == Refusal::box);
    for (unsigned f = 0; f < 4; ++f) {
        if (c.across(corner, f) != mesh::none) continue;
        CHECK(remove_faces(bench, corner, f, 0.0F) == Refusal::box);
        CHECK(split_face(bench, corner, f, Vec3::Zero()) == Refusal::box);
    }
    CHECK(valid(c));
}

TEST_CASE("collapse of an exactly flat interface vertex keeps the volume; a corner is kept in safe "
          "mode") {
    Complex c = test::labelled_meshes().front().complex;
    Workbench bench(c);
    prepare(bench);
    const double volume = mesh::labelled_volume(c);
    const VertexId v = flat_vertex(c);
    REQUIRE(v != mesh::none);
    const auto before = mesh::count_interface(c);
    Outcome result = Refusal::not_applicable;
    std::vector<TetId> star;
    c.star(v, star);
    for (const TetId t : star) {
        if (!result.refused()) break;
        const auto corners = c.tet(t).v;
        for (const VertexId w : corners) {
            if (w == v || !c.on_interface(w) || !result.refused()) continue;
            result = collapse_edge(bench, t, v, w, repair::CollapseMode::safe, 0.0F);
        }
    }
    CHECK_FALSE(result.refused());
    CHECK(mesh::count_interface(c).vertices == before.vertices - 1);
    CHECK(mesh::labelled_volume(c) == doctest::Approx(volume).epsilon(1e-12));
    CHECK(valid(c));
    // A corner of the block: its three planes meet at right angles.
    VertexId corner = mesh::none;
    for (const VertexId w : c.interface_vertices()) {
        if ((c.position(w).cwiseAbs() - Vec3::Constant(0.75)).cwiseAbs().maxCoeff() < 1e-9)
            corner = w;
    }
    REQUIRE(corner != mesh::none);
    CHECK_FALSE(bench.flat(corner));
}

TEST_CASE("the remembered flatness of a vertex ends when its star changes") {
    Complex c = test::labelled_meshes().front().complex;
    Workbench bench(c);
    prepare(bench);
    const VertexId v = flat_vertex(c);
    REQUIRE(v != mesh::none);
    CHECK(bench.flat(v));
    CHECK(bench.flat(v));
    // A little out of the plane.
    std::vector<TetId> star;
    c.star(v, star);
    const Vec3 place = c.position(v);
    c.move(v, place + Vec3(0.05, 0.0, 0.0), star);
    CHECK_FALSE(bench.flat(v));
    // The same vertex, with a rule that permits it.
    bench.limits.flatness = 0.5;
    CHECK(bench.flat(v));
    bench.limits.flatness = repair::default_flatness;
    CHECK_FALSE(bench.flat(v));
    c.move(v, place, star);
    CHECK(bench.flat(v));
}

TEST_CASE("interface flip of an exactly planar convex quadrilateral") {
    Complex c = test::labelled_meshes().front().complex;
    Workbench bench(c);
    prepare(bench);
    const double volume = mesh::labelled_volume(c);
    std::size_t flips = 0;
    for (TetId t = 0; t < c.tet_slots(); ++t) {
        if (!c.tet_alive(t)) continue;
        for (const auto& e : mesh::edge_vertices) {
            const VertexId a = c.tet(t).v[e[0]], b = c.tet(t).v[e[1]];
            if (flip_interface_edge(bench, t, a, b, 0.0F).refused()) continue;
            ++flips;
            REQUIRE(c.find_edge(a, b) == mesh::none);
            break;
        }
    }
    CHECK(flips > 10);
    CHECK(mesh::labelled_volume(c) == doctest::Approx(volume).epsilon(1e-12));
    CHECK(valid(c));
    CHECK(mesh::count_interface(c).euler() == 2);
}

TEST_CASE("a relabelled tet shifts the interface by its volume and no topology") {
    Complex c = test::labelled_meshes().front().complex;
    Workbench bench(c);
    prepare(bench, 0.8);
    const double before = mesh::labelled_volume(c);
    const auto counts = mesh::count_interface(c);
    std::size_t done = 0;
    for (TetId t = 0; t < c.tet_slots() && done == 0; ++t) {
        if (c.label(t) == 1 && !relabel_tet(bench, t).refused()) ++done;
    }
    REQUIRE(done == 1);
    CHECK(mesh::labelled_volume(c) == doctest::Approx(before - bench.sums.relabelled));
    CHECK(bench.sums.relabelled > 0.0);
    CHECK(mesh::count_interface(c).euler() == counts.euler());
    CHECK(mesh::count_interface(c).shells == counts.shells);
    CHECK(valid(c));
}

TEST_CASE("a plate is not pinched: collapses across it are refused") {
    auto meshes = test::labelled_meshes();
    Complex& c = meshes[3].complex;
    REQUIRE(meshes[3].name == "plate");
    Workbench bench(c);
    prepare(bench, 2.0);
    std::size_t irregular = 0;
    for (TetId t = 0; t < c.tet_slots(); ++t) {
        if (!c.tet_alive(t) || c.label(t) != 1) continue;
        for (const auto& e : mesh::edge_vertices) {
            if (!c.tet_alive(t) || c.label(t) != 1) break;
            const Outcome r = collapse_edge(bench, t, c.tet(t).v[e[0]], c.tet(t).v[e[1]],
                                            repair::CollapseMode::bounded, 0.0F);
            irregular += r == Refusal::irregular ? 1 : 0;
            REQUIRE(mesh::count_interface(c).euler() == 2);
        }
    }
    CHECK(irregular > 0);
    CHECK(valid(c));
}

TEST_CASE("edit bounds: what would move the interface too far is refused") {
    Complex c = test::labelled_meshes().front().complex;
    Workbench bench(c);
    bench.limits = {0.01, 1e-3, 0.005, geometry::regular_tet_volume(0.01), 0.995};
    std::size_t bound = 0;
    for (TetId t = 0; t < c.tet_slots(); ++t) {
        if (c.label(t) != 1) continue;
        bound += relabel_tet(bench, t) == Refusal::bound ? 1 : 0;
    }
    CHECK(bound > 0);
    CHECK(mesh::labelled_volume(c) == doctest::Approx(std::pow(1.5, 3)));
}
