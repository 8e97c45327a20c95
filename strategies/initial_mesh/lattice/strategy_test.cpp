// Tests of the mesh; the plugin is loaded as in a run.
#include <algorithm>
#include <cmath>
#include <map>

#include <doctest/doctest.h>

#include <dsc/base/error.hpp>
#include <dsc/geometry/quality.hpp>
#include <dsc/host/host.hpp>
#include <dsc/mesh/adopt.hpp>
#include <dsc/mesh/validate.hpp>

namespace {

using dsc::Vec3;
using dsc::config::ConfigNode;
using dsc::mesh::TetMesh;
constexpr double pi = 3.14159265358979;

TetMesh build(const ConfigNode& params) {
    dsc::host::Host host;
    host.load(DSC_TEST_PLUGIN);
    return host.create<dsc::hooks::InitialMesh>({"lattice", params}, "initial_mesh")->build({});
}

ConfigNode sphere(double radius, const char* rule = "barycentre", Vec3 centre = Vec3::Zero()) {
    return ConfigNode::map({{"shape", "sphere"},
                            {"radius", radius},
                            {"rule", rule},
                            {"centre", ConfigNode::list({centre.x(), centre.y(), centre.z()})}});
}
ConfigNode only(const ConfigNode& shape, int cells, double growth = 2.0, int layers = 2,
                const char* finest = "parity") {
    return ConfigNode::map({{"shape", "none"},
                            {"shapes", ConfigNode::list({shape})},
                            {"cells", cells},
                            {"growth", growth},
                            {"layers", layers},
                            {"finest", finest}});
}

double quality(const TetMesh& m, std::size_t t) {
    const auto& v = m.tets[t];
    return dsc::geometry::tet_quality(m.points[v[0]], m.points[v[1]], m.points[v[2]],
                                      m.points[v[3]]);
}
double longest_edge(const TetMesh& m, std::size_t t) {
    double longest = 0;
    for (const auto& e : dsc::mesh::edge_vertices) {
        longest = std::max(longest, (m.points[m.tets[t][e[0]]] - m.points[m.tets[t][e[1]]]).norm());
    }
    return longest;
}

struct Adopted {
    dsc::mesh::Complex complex;
    dsc::mesh::AdoptReport report;
    dsc::mesh::InterfaceCounts interface;
};

// Requires positive tets that are conforming and fill the box; every vertex of the interface is
// regular, none is on the box. The stairs of a slanting wall may pinch, in any lattice: adopt()
// makes these vertices regular; `smooth`: there are none.
Adopted check_sound(const TetMesh& m, bool smooth = true) {
    Adopted out;
    out.complex = dsc::mesh::adopt(m, "lattice", &out.report);
    CHECK(out.report.reoriented_tets == 0);
    CHECK(out.report.dropped_vertices == 0);
    if (smooth) {
        CHECK(out.report.unpinched_vertices == 0);
        CHECK(out.report.vanished_components == 0);
        CHECK(out.complex.tet_count() == m.tets.size());
    }
    const auto found = dsc::mesh::validate(out.complex);
    CHECK(found.valid());
    CHECK(found.irregular_vertices == 0);
    for (const auto v : out.complex.interface_vertices()) REQUIRE_FALSE(out.complex.on_box(v));
    out.interface = dsc::mesh::count_interface(out.complex);
    return out;
}

}  // namespace

TEST_CASE("the defaults are the grid's cube in a graded box") {
    const TetMesh m = build(ConfigNode::map());
    const Adopted a = check_sound(m);
    CHECK(a.interface.vertices == 2402);
    CHECK(a.interface.faces == 4800);
    CHECK(a.interface.shells == 1);
    CHECK(a.interface.genus() == 0);
    CHECK(dsc::mesh::labelled_volume(a.complex) == doctest::Approx(8.0).epsilon(1e-12));
    // Thirty cells of 0.1 become thirty-two, a multiple of the coarsest.
    CHECK(a.complex.box().high == Vec3::Constant(1.6));
    CHECK(a.complex.box().low == Vec3::Constant(-1.6));
    CHECK(m.tets.size() < 40 * a.interface.vertices);
}

TEST_CASE("valid for every pattern, shape, growth and number of layers") {
    const ConfigNode tunnel = ConfigNode::map({{"shape", "cylinder"},
                                               {"action", "cut"},
                                               {"radius", 0.45},
                                               {"axis", ConfigNode::list({0.3, 0.1, 1.0})},
                                               {"half_length", 1.4}});
    for (const char* finest : {"parity", "bcc"}) {
        for (const double growth : {1.0, 1.3, 2.0}) {
            for (const int layers : {2, 3}) {
                CAPTURE(finest);
                CAPTURE(growth);
                CAPTURE(layers);
                const Adopted ball = check_sound(build(only(
                    sphere(0.83, "barycentre", {0.1, 0.2, 0.05}), 24, growth, layers, finest)));
                CHECK(ball.interface.genus() == 0);
                CHECK(ball.interface.shells == 1);
                const Adopted ring =
                    check_sound(build(ConfigNode::map({{"cells", 33},
                                                       {"growth", growth},
                                                       {"layers", layers},
                                                       {"finest", finest},
                                                       {"half_width", 0.9},
                                                       {"shapes", ConfigNode::list({tunnel})}})),
                                false);
                CHECK(ring.interface.genus() == 1);
                CHECK(ring.interface.shells == 1);
            }
        }
    }
}

TEST_CASE("tets are of the stated kinds and no others") {
    std::map<long, std::size_t> kinds;
    for (const char* finest : {"parity", "bcc"}) {
        const TetMesh m = build(only(sphere(1.0), 48, 2.0, 2, finest));
        for (std::size_t t = 0; t < m.tets.size(); ++t) ++kinds[std::lround(1e4 * quality(m, t))];
    }
    // Quarter of a bcc tet, half a pyramid, half a bcc tet, corner of a cell, bcc tet, middle of a
    // cell.
    const std::vector<long> known = {6573, 6651, 7155, 7698, 9295, 10000};
    for (const long kind : known) CHECK(kinds[kind] > 0);
    CHECK(kinds.size() == known.size());
}

TEST_CASE("the median tet is that of the finest cells") {
    const auto median = [](const char* finest) {
        const TetMesh m = build(only(sphere(1.0), 60, 2.0, 2, finest));
        std::vector<double> q;
        for (std::size_t t = 0; t < m.tets.size(); ++t) q.push_back(quality(m, t));
        std::nth_element(q.begin(), q.begin() + static_cast<std::ptrdiff_t>(q.size() / 2), q.end());
        return q[q.size() / 2];
    };
    CHECK(median("parity") == doctest::Approx(0.7698).epsilon(1e-3));
    CHECK(median("bcc") == doctest::Approx(0.9295).epsilon(1e-3));
}

TEST_CASE("tets at the interface are of the finest cells, all that touch it") {
    for (const std::string finest : {"parity", "bcc"}) {
        for (const int layers : {2, 3}) {
            CAPTURE(finest);
            CAPTURE(layers);
            const int cells = 48;
            const TetMesh m = build(only(sphere(0.97, "barycentre", {0.02, 0.01, 0.03}), cells, 2.0,
                                         layers, finest.c_str()));
            // The diagonal of a face in cells of five tets, the edge of a cell in the others; twice
            // that in larger cells.
            const double largest = 3.0 / cells * (finest == "bcc" ? 1.001 : 1.415);
            const dsc::mesh::Complex c = dsc::mesh::adopt(m, "lattice");
            REQUIRE(c.vertex_slots() == m.points.size());
            std::vector<char> near(m.points.size(), 0);
            for (const auto v : c.interface_vertices()) near[v] = 1;
            std::vector<std::size_t> coarse;
            for (int ring = 0; ring < 3; ++ring) {
                std::vector<char> next = near;
                coarse.push_back(0);
                for (std::size_t t = 0; t < m.tets.size(); ++t) {
                    const auto& tet = m.tets[t];
                    if (std::none_of(tet.begin(), tet.end(), [&](auto v) { return near[v] != 0; }))
                        continue;
                    for (const auto v : tet) next[v] = 1;
                    if (longest_edge(m, t) > largest) ++coarse.back();
                }
                near = std::move(next);
            }
            CHECK(coarse[0] == 0);
            // Where stairs are diagonal, a ring of tets is thinner than a layer of cells.
            if (layers >= 3) CHECK(coarse[1] < c.interface_vertices().size() / 10);
            CHECK(coarse[2] > 0);
        }
    }
}

TEST_CASE("sizes grow with the distance as set") {
    std::size_t tets = 0;
    double last_nearest = 0;
    for (const int per_size : {1, 2, 3}) {
        CAPTURE(per_size);
        const int cells = 96, layers = 2;
        const double radius = 0.6, cell = 3.0 / cells, growth = std::pow(2.0, 1.0 / per_size);
        const TetMesh m = build(only(sphere(radius), cells, growth, layers));
        double fastest = 0, nearest = 1e9;
        for (std::size_t t = 0; t < m.tets.size(); ++t) {
            const double size = longest_edge(m, t) / cell;
            double least = 1e9, farthest = 0;  // distances of the vertices to the sphere, in cells
            for (const auto v : m.tets[t]) {
                const double distance = std::abs(m.points[v].norm() - radius) / cell;
                least = std::min(least, distance);
                farthest = std::max(farthest, distance);
            }
            fastest = std::max(fastest, (size - std::sqrt(2.0)) / farthest);
            if (size > 7.9) nearest = std::min(nearest, least);
        }
        CHECK(fastest < (per_size == 1 ? 0.45 : 0.28));
        // Between the finest cells and cells of size 8 there are this many layers of sizes 2 and 4;
        // along a diagonal they are thinner by the square root of two.
        CHECK(nearest > 1 + per_size * (2 + 4) / std::sqrt(2.0));
        if (per_size < 3) CHECK(nearest > last_nearest + 4);
        CHECK(m.tets.size() > tets);
        last_nearest = nearest;
        tets = m.tets.size();
    }
}

TEST_CASE("growth 1 is a uniform grid") {
    const TetMesh m = build(ConfigNode::map({{"growth", 1.0}, {"cells", 12}}));
    CHECK(m.tets.size() == 5 * 12 * 12 * 12);
    CHECK(m.points.size() == 13 * 13 * 13);
    const TetMesh bcc = build(
        ConfigNode::map({{"growth", 1.0}, {"cells", 12}, {"half_width", 0.5}, {"finest", "bcc"}}));
    CHECK(bcc.tets.size() == 4 * (3 * 11 * 12 * 12 + 6 * 12 * 12));
}

TEST_CASE("the labelled volume is the shape's, up to the tets that its surface crosses") {
    const double exact = 4.0 / 3.0 * pi;
    for (const char* finest : {"parity", "bcc"}) {
        for (const int cells : {30, 60, 120}) {
            CAPTURE(cells);
            const auto complex =
                dsc::mesh::adopt(build(only(sphere(1.0), cells, 2.0, 2, finest)), "lattice");
            // The errors of barycentres cancel: a hundredth of the surface's layer of cells
            // remains.
            const double layer = 4 * pi * 3.0 / cells;
            CHECK(std::abs(dsc::mesh::labelled_volume(complex) - exact) < 0.03 * layer);
            // With whole tets inside, the solid loses about half a cell everywhere.
            const auto inner = dsc::mesh::adopt(
                build(only(sphere(1.0, "vertices"), cells, 2.0, 2, finest)), "lattice");
            const double lost = exact - dsc::mesh::labelled_volume(inner);
            CHECK(lost > 0.3 * layer);
            CHECK(lost < 0.8 * layer);
        }
    }
}

TEST_CASE("tets per interface vertex stay bounded") {
    for (const int cells : {30, 60, 120, 200}) {
        CAPTURE(cells);
        const TetMesh m = build(only(sphere(1.0), cells));
        const auto complex = dsc::mesh::adopt(m, "lattice");
        const double per_vertex = static_cast<double>(m.tets.size()) /
                                  static_cast<double>(complex.interface_vertices().size());
        CHECK(per_vertex < 45);
        CHECK(per_vertex > 25);
    }
}

TEST_CASE("surfaces that change no label are not refined") {
    const ConfigNode inner = ConfigNode::map({{"shape", "sphere"}, {"radius", 0.4}});
    const ConfigNode outer =
        ConfigNode::map({{"shape", "sphere"}, {"radius", 1.3}, {"action", "cut"}});
    const auto with = [](const std::vector<ConfigNode>& list, const char* first) {
        return build(ConfigNode::map(
                         {{"shape", first}, {"cells", 48}, {"shapes", ConfigNode::list(list)}}))
            .tets.size();
    };
    const std::size_t cube = with({}, "cube");
    CHECK(with({inner}, "cube") == cube);
    CHECK(with({inner, outer}, "none") == with({}, "none"));
    const ConfigNode hole =
        ConfigNode::map({{"shape", "sphere"}, {"radius", 0.4}, {"action", "cut"}});
    CHECK(with({hole}, "cube") > cube);
}

TEST_CASE("the same parameters give the same arrays") {
    const ConfigNode params = only(sphere(0.9, "barycentre", {0.1, 0, 0}), 40);
    const TetMesh a = build(params), b = build(params);
    CHECK(a.tets == b.tets);
    CHECK(a.labels == b.labels);
    CHECK(a.points == b.points);
}

TEST_CASE("coordinates are the grid's, symmetric to the last bit") {
    const TetMesh m = build(ConfigNode::map({{"cells", 30}, {"half_width", 0.5}}));
    std::map<std::array<double, 3>, int> points;
    for (const Vec3& p : m.points) points[{p.x(), p.y(), p.z()}] = 1;
    for (const Vec3& p : m.points)
        REQUIRE(points.count({-p.x() + 0.0, -p.y() + 0.0, -p.z() + 0.0}) == 1);
    // On the surface x = 1/2 the numbers are those of the grid: half * (2 i - N) / N.
    for (int i = 10; i <= 20; ++i)
        CHECK(points.count({0.5, 1.5 * (2.0 * i - 30.0) / 30.0, 0.5}) == 1);
}

TEST_CASE("a cell's edge may be given instead of the number of cells") {
    const TetMesh by_number = build(ConfigNode::map({{"cells", 60}, {"half_width", 0.5}}));
    const TetMesh by_length = build(ConfigNode::map({{"cell", 0.05}, {"half_width", 0.5}}));
    REQUIRE(by_number.tets == by_length.tets);
    CHECK(by_number.labels == by_length.labels);
    for (std::size_t i = 0; i < by_number.points.size(); ++i) {
        REQUIRE((by_number.points[i] - by_length.points[i]).norm() < 1e-14);
    }
}

TEST_CASE("bad parameters are refused with their cause") {
    const auto refused = [](const ConfigNode& params, const char* text) {
        CHECK_THROWS_WITH_AS(build(params), doctest::Contains(text), dsc::ConfigError);
    };
    refused(ConfigNode::map({{"cells", 3}}), "cells");
    refused(ConfigNode::map({{"growth", 0.9}}), "growth");
    refused(ConfigNode::map({{"layers", 1}}), "layers");
    refused(ConfigNode::map({{"finest", "kuhn"}}), "finest");
    refused(ConfigNode::map({{"cell", 0.001}}),
            "cell must fit at least 4 and at most 1024 times into twice the box");
    refused(ConfigNode::map({{"half_width", 1.6}}),
            "a shape reaches the faces of the box; make the shape smaller or `box` larger");
    refused(ConfigNode::map({{"growth", 1.0}, {"cells", 400}}),
            "64000000 cells, but the limit is 12000000");
    const ConfigNode flat =
        ConfigNode::map({{"shape", "cylinder"}, {"axis", ConfigNode::list({0.0, 0.0, 0.0})}});
    refused(ConfigNode::map({{"shapes", ConfigNode::list({flat})}}),
            "axis must not be the zero vector");
}

TEST_CASE("a cancelled run gets no mesh") {
    dsc::host::Host host;
    host.load(DSC_TEST_PLUGIN);
    const auto lattice =
        host.create<dsc::hooks::InitialMesh>({"lattice", ConfigNode::map()}, "initial_mesh");
    dsc::CancelToken token;
    token.cancel();
    dsc::hooks::InitialMeshContext context;
    context.cancel = &token;
    CHECK_THROWS_AS(lattice->build(context), dsc::CancelledError);
}

TEST_CASE("projected, in a box that lies elsewhere: the sphere's vertices are on the radius") {
    const Vec3 centre(0.35, 0.4, 0.5);
    const ConfigNode at = ConfigNode::list({centre.x(), centre.y(), centre.z()});
    const TetMesh mesh = build(ConfigNode::map({{"cells", 32},
                                                {"box", 0.5},
                                                {"box_centre", ConfigNode::list({0.5, 0.5, 0.5})},
                                                {"shape", "sphere"},
                                                {"centre", at},
                                                {"radius", 0.2},
                                                {"layers", 3},
                                                {"project", true}}));
    const auto complex = dsc::mesh::adopt(mesh, "lattice");
    CHECK(dsc::mesh::validate(complex).faults == std::vector<std::string>{});
    CHECK((complex.box().low - Vec3::Zero()).norm() < 1e-15);
    CHECK((complex.box().high - Vec3::Ones()).norm() < 1e-15);
    std::size_t off = 0;
    for (const dsc::mesh::VertexId v : complex.interface_vertices()) {
        const double away = std::abs((complex.position(v) - centre).norm() - 0.2);
        CHECK(away < 0.1 / 32);
        off += away > 1e-11;
    }
    CHECK(complex.interface_vertices().size() > 200);
    CHECK(off * 50 < complex.interface_vertices().size());
}
