// Tests of the mesh; the plugin is loaded as in a run.
#include <set>

#include <doctest/doctest.h>

#include <dsc/base/error.hpp>
#include <dsc/geometry/predicates.hpp>
#include <dsc/geometry/quality.hpp>
#include <dsc/host/host.hpp>
#include <dsc/mesh/adopt.hpp>
#include <dsc/mesh/validate.hpp>

namespace {

using dsc::Vec3;
using dsc::config::ConfigNode;
using dsc::mesh::Complex;
using dsc::mesh::TetMesh;
constexpr double pi = 3.14159265358979;

TetMesh build(const ConfigNode& params) {
    dsc::host::Host host;
    host.load(DSC_TEST_PLUGIN);
    return host.create<dsc::hooks::InitialMesh>({"corner_box", params}, "initial_mesh")->build({});
}
ConfigNode vector(double x, double y, double z) { return ConfigNode::list({x, y, z}); }

double volume(const TetMesh& m, dsc::mesh::Label label) {
    double sum = 0;
    for (std::size_t t = 0; t < m.tets.size(); ++t) {
        const auto& v = m.tets[t];
        if (m.labels[t] == label)
            sum += dsc::geometry::tet_volume(m.points[v[0]], m.points[v[1]], m.points[v[2]],
                                             m.points[v[3]]);
    }
    return sum;
}

// Requires that every tet is positive and that the mesh is adopted as a conforming mesh of the
// whole box with one sphere as its interface.
void check_sound(const TetMesh& m, double half) {
    for (const auto& v : m.tets)
        REQUIRE(dsc::geometry::orient3d(m.points[v[0]], m.points[v[1]], m.points[v[2]],
                                        m.points[v[3]]) == 1);
    dsc::mesh::AdoptReport report;
    const Complex complex = dsc::mesh::adopt(m, "corner_box", &report, 0.0);
    CHECK(report.reoriented_tets == 0);
    CHECK(report.dropped_vertices == 0);
    CHECK(report.unpinched_vertices == 0);
    CHECK(dsc::mesh::validate(complex).valid());
    CHECK(complex.box().low == Vec3::Constant(-half));
    CHECK(complex.box().high == Vec3::Constant(half));
    const dsc::mesh::InterfaceCounts counts = dsc::mesh::count_interface(complex);
    CHECK(counts.shells == 1);
    CHECK(counts.genus() == 0);
    CHECK(volume(m, 0) + volume(m, 1) == doctest::Approx(8 * half * half * half).epsilon(1e-12));
    std::size_t outside = 0;
    for (dsc::mesh::VertexId v = 0; v < complex.vertex_slots(); ++v)
        outside += complex.on_box(v) ? 1 : 0;
    CHECK(outside == 8);
}

}  // namespace

TEST_CASE("sphere: counts, volume, every vertex of the interface on the radius") {
    for (const int n : {1, 2, 3, 12}) {
        CAPTURE(n);
        const TetMesh m = build(ConfigNode::map({{"divisions", n}, {"radius", 0.9}}));
        check_sound(m, 1.5);
        const Complex complex = dsc::mesh::adopt(m, "corner_box", nullptr, 0.0);
        const auto on_surface = complex.interface_vertices();
        CHECK(on_surface.size() == static_cast<std::size_t>(4 * n * n + 2));
        for (const auto v : on_surface)
            REQUIRE(complex.position(v).norm() == doctest::Approx(0.9).epsilon(1e-14));
        std::size_t inside = 0;
        for (const auto label : m.labels) inside += label == 1 ? 1 : 0;
        CHECK(inside == static_cast<std::size_t>(8 * n * n * n));
        // One tet per face, one per edge on the three great circles, two per side of the box.
        CHECK(m.tets.size() - inside == static_cast<std::size_t>(8 * n * n + 12 * n + 12));
    }
    const TetMesh fine = build(ConfigNode::map({{"divisions", 24}, {"radius", 0.9}}));
    CHECK(volume(fine, 1) == doctest::Approx(4.0 / 3.0 * pi * 0.729).epsilon(0.005));
}

TEST_CASE("sphere: the inside is well shaped, the outside has no vertex of its own") {
    const TetMesh m = build(ConfigNode::map({{"divisions", 12}}));
    double least = 1;
    std::set<std::uint32_t> outside;
    std::set<std::uint32_t> inside;
    for (std::size_t t = 0; t < m.tets.size(); ++t) {
        const auto& v = m.tets[t];
        (m.labels[t] == 0 ? outside : inside).insert(v.begin(), v.end());
        if (m.labels[t] == 1)
            least = std::min(least, dsc::geometry::tet_quality(m.points[v[0]], m.points[v[1]],
                                                               m.points[v[2]], m.points[v[3]]));
    }
    CHECK(least > 0.3);
    std::size_t only_outside = 0;
    for (const auto v : outside) only_outside += inside.count(v) == 0 ? 1 : 0;
    CHECK(only_outside == 8);
}

TEST_CASE("sphere: each vertex is joined to its nearest corner") {
    const TetMesh m = build(ConfigNode::map({{"divisions", 6}, {"radius", 1.2}}));
    std::set<std::array<std::uint32_t, 2>> edges;
    std::set<std::uint32_t> on_surface;
    for (std::size_t t = 0; t < m.tets.size(); ++t) {
        if (m.labels[t] != 0) continue;
        for (const auto a : m.tets[t]) {
            if (m.points[a].cwiseAbs().minCoeff() < 1.5) on_surface.insert(a);
            for (const auto b : m.tets[t]) edges.insert({a, b});
        }
    }
    for (const auto v : on_surface) {
        for (std::uint32_t corner = 0; corner < m.points.size(); ++corner) {
            const Vec3& c = m.points[corner];
            if (c.cwiseAbs().minCoeff() < 1.5) continue;
            const bool nearest = (c.array() * m.points[v].array() >= -1e-9).all();
            const bool joined = edges.count({v, corner}) > 0;
            // At a pole, the side may be cut along its other diagonal.
            const bool pole = (m.points[v].cwiseAbs().array() < 1e-9).count() == 2;
            if (!pole || !nearest) REQUIRE(joined == nearest);
        }
    }
}

TEST_CASE("box: counts and exact volume, also off centre and not a cube") {
    for (const int n : {1, 2, 5}) {
        CAPTURE(n);
        const TetMesh m = build(ConfigNode::map({{"shape", "box"},
                                                 {"divisions", n},
                                                 {"half_size", vector(0.5, 0.7, 0.9)},
                                                 {"centre", vector(0.4, -0.3, 0.1)}}));
        check_sound(m, 1.5);
        CHECK(volume(m, 1) == doctest::Approx(8 * 0.5 * 0.7 * 0.9).epsilon(1e-12));
        const Complex complex = dsc::mesh::adopt(m, "corner_box", nullptr, 0.0);
        CHECK(complex.interface_vertices().size() == static_cast<std::size_t>(24 * n * n + 2));
    }
}

TEST_CASE("any solid that fits is joined correctly: near the walls, small, large, in another box") {
    check_sound(build(ConfigNode::map({{"radius", 1.49}, {"divisions", 5}})), 1.5);
    check_sound(build(ConfigNode::map(
                    {{"radius", 0.01}, {"divisions", 4}, {"centre", vector(-1.4, 1.3, 1.45)}})),
                1.5);
    check_sound(build(ConfigNode::map(
                    {{"radius", 0.6}, {"divisions", 7}, {"centre", vector(0.8, 0.2, -0.85)}})),
                1.5);
    check_sound(build(ConfigNode::map({{"radius", 2.0}, {"box", 3.0}, {"divisions", 9}})), 3.0);
    check_sound(build(ConfigNode::map(
                    {{"shape", "box"}, {"half_size", vector(1.4, 0.1, 0.02)}, {"divisions", 3}})),
                1.5);
}

TEST_CASE("a solid that does not fit is refused") {
    const auto refused = [](const ConfigNode& params, const char* text) {
        CHECK_THROWS_WITH_AS(build(params), doctest::Contains(text), dsc::ConfigError);
    };
    refused(ConfigNode::map({{"radius", 1.5}}), "must lie inside the box");
    refused(ConfigNode::map({{"radius", 0.9}, {"centre", vector(0, 0, 0.7)}}),
            "must lie inside the box");
    refused(ConfigNode::map({{"shape", "box"}, {"half_size", vector(1, 1, 1.6)}}),
            "must lie inside the box");
    refused(ConfigNode::map({{"shape", "box"}, {"half_size", vector(1, 0, 1)}}),
            "half_size must be above 0");
}
