// Tests of the mesh; the plugin is loaded as in a run.
#include <array>
#include <map>
#include <set>

#include <doctest/doctest.h>

#include <dsc/base/error.hpp>
#include <dsc/geometry/predicates.hpp>
#include <dsc/geometry/quality.hpp>
#include <dsc/host/host.hpp>
#include <dsc/surface/surface_view.hpp>

namespace {

using dsc::Vec3;
using dsc::config::ConfigNode;

dsc::mesh::TetMesh build(const ConfigNode& params) {
    dsc::host::Host host;
    host.load(DSC_TEST_PLUGIN);
    const auto grid = host.create<dsc::hooks::InitialMesh>({"grid", params}, "initial_mesh");
    return grid->build({});
}

struct Census {
    std::size_t interface_vertices = 0;
    std::size_t interface_faces = 0;
    double object_volume = 0;
    double box_volume = 0;
    std::size_t labelled = 0;
    bool positive = true;
    std::size_t overfull_faces = 0;  // with more than two tets
    std::size_t edges = 0;
    std::size_t faces = 0;
};

// Counts everything using only the arrays.
Census count(const dsc::mesh::TetMesh& mesh) {
    Census census;
    std::map<std::array<std::uint32_t, 3>, std::vector<dsc::mesh::Label>> faces;
    std::set<std::array<std::uint32_t, 2>> edges;
    for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
        auto v = mesh.tets[t];
        const auto& p = mesh.points;
        const double volume = dsc::geometry::tet_volume(p[v[0]], p[v[1]], p[v[2]], p[v[3]]);
        census.positive =
            census.positive && dsc::geometry::orient3d(p[v[0]], p[v[1]], p[v[2]], p[v[3]]) == 1;
        census.box_volume += volume;
        if (mesh.labels[t] != 0) {
            census.object_volume += volume;
            ++census.labelled;
        }
        std::sort(v.begin(), v.end());
        for (std::size_t i = 0; i < 4; ++i) {
            std::array<std::uint32_t, 3> face{};
            for (std::size_t k = 0, n = 0; k < 4; ++k) {
                if (k != i) face[n++] = v[k];
            }
            faces[face].push_back(mesh.labels[t]);
            for (std::size_t k = i + 1; k < 4; ++k) edges.insert({v[i], v[k]});
        }
    }
    std::set<std::uint32_t> on_interface;
    for (const auto& [face, labels] : faces) {
        census.overfull_faces += labels.size() > 2;
        const dsc::mesh::Label other = labels.size() > 1 ? labels[1] : 0;
        if (labels[0] == other) continue;
        ++census.interface_faces;
        on_interface.insert(face.begin(), face.end());
    }
    census.interface_vertices = on_interface.size();
    census.edges = edges.size();
    census.faces = faces.size();
    return census;
}

void check_sound(const Census& census, const dsc::mesh::TetMesh& mesh, double box_volume) {
    CHECK(census.positive);
    CHECK(census.overfull_faces == 0);
    CHECK(census.box_volume == doctest::Approx(box_volume).epsilon(1e-10));
    // Euler number of a ball: V - E + F - T = 1.
    CHECK(mesh.points.size() + census.faces == census.edges + mesh.tets.size() + 1);
}

}  // namespace

TEST_CASE("the defaults are the original's cube") {
    const auto mesh = build(ConfigNode::map());
    const Census census = count(mesh);
    check_sound(census, mesh, 27.0);
    CHECK(mesh.points.size() == 29791);
    CHECK(mesh.tets.size() == 135000);
    CHECK(census.edges == 170190);
    CHECK(census.faces == 275400);
    CHECK(census.labelled == 40000);
    CHECK(census.interface_vertices == 2402);
    CHECK(census.interface_faces == 4800);
    CHECK(census.object_volume == doctest::Approx(8.0).epsilon(1e-12));
}

TEST_CASE("shape sphere is the original's sphere") {
    const auto mesh = build(ConfigNode::map({{"shape", "sphere"}}));
    const Census census = count(mesh);
    check_sound(census, mesh, 27.0);
    CHECK(census.labelled == 17032);
    CHECK(census.interface_vertices == 1266);
    CHECK(census.interface_faces == 2528);
    CHECK(census.object_volume == doctest::Approx(3.390667).epsilon(1e-6));
}

TEST_CASE("six cells are the original's cube_simple") {
    const auto mesh = build(ConfigNode::map({{"cells", 6}}));
    const Census census = count(mesh);
    check_sound(census, mesh, 27.0);
    CHECK(mesh.points.size() == 343);
    CHECK(mesh.tets.size() == 1080);
    CHECK(census.edges == 1638);
    CHECK(census.faces == 2376);
    CHECK(census.labelled == 320);
    CHECK(census.interface_vertices == 98);
    CHECK(census.interface_faces == 192);
    CHECK(census.object_volume == doctest::Approx(8.0).epsilon(1e-12));
}

TEST_CASE("the rows of the two cell patterns are those of the original's files") {
    const auto mesh = build(ConfigNode::map({{"cells", 2}, {"box", 1.0}, {"shape", "none"}}));
    // Cell (0,0,0) is even, cell (1,0,0) odd; vertex index = i + 3 j + 9 k.
    const std::vector<std::array<std::uint32_t, 4>> expected = {
        {0, 9, 10, 12}, {0, 12, 4, 3}, {0, 1, 4, 10},   {13, 10, 12, 4}, {0, 4, 12, 10},
        {1, 10, 2, 4},  {4, 5, 14, 2}, {13, 4, 14, 10}, {11, 2, 10, 14}, {10, 2, 4, 14}};
    for (std::size_t i = 0; i < expected.size(); ++i) CHECK(mesh.tets[i] == expected[i]);
    CHECK(mesh.points.front() == Vec3(-1, -1, -1));
    CHECK(mesh.points[13] == Vec3(0, 0, 0));
    CHECK(mesh.points.back() == Vec3(1, 1, 1));
    CHECK(count(mesh).interface_faces == 0);
}

TEST_CASE("coordinates are symmetric to the last bit") {
    const auto mesh = build(ConfigNode::map({{"cells", 7}, {"box", 1.3}, {"shape", "none"}}));
    for (std::size_t i = 0; i < mesh.points.size(); ++i) {
        REQUIRE(mesh.points[i] == -mesh.points[mesh.points.size() - 1 - i]);
    }
}

TEST_CASE("shapes add and cut in their order") {
    const ConfigNode tunnel = ConfigNode::map({{"shape", "cylinder"},
                                               {"action", "cut"},
                                               {"radius", 0.45},
                                               {"axis", ConfigNode::list({0.0, 0.0, 3.0})},
                                               {"half_length", 1.2}});
    const auto mesh = build(ConfigNode::map({{"shapes", ConfigNode::list({tunnel})}}));
    const auto surface = dsc::surface::extract_interface(mesh);
    std::set<std::array<std::uint32_t, 2>> edges;
    for (const auto& f : surface.faces) {
        for (std::size_t k = 0; k < 3; ++k) {
            edges.insert({std::min(f[k], f[(k + 1) % 3]), std::max(f[k], f[(k + 1) % 3])});
        }
    }
    CHECK(static_cast<long>(surface.points.size() + surface.faces.size()) -
              static_cast<long>(edges.size()) ==
          0);
    const double expected = 8.0 - 2 * 3.14159265 * 0.45 * 0.45;
    CHECK(count(mesh).object_volume == doctest::Approx(expected).epsilon(0.02));

    // The later shape wins: added after the cut, a box of label 2 fills the middle of the tunnel.
    const ConfigNode plug = ConfigNode::map(
        {{"shape", "box"}, {"half_size", ConfigNode::list({0.6, 0.6, 0.2})}, {"label", 2}});
    const auto plugged = build(ConfigNode::map({{"shapes", ConfigNode::list({tunnel, plug})}}));
    double plug_volume = 0;
    for (std::size_t t = 0; t < plugged.tets.size(); ++t) {
        const auto& v = plugged.tets[t];
        const auto& p = plugged.points;
        if (plugged.labels[t] == 2)
            plug_volume += dsc::geometry::tet_volume(p[v[0]], p[v[1]], p[v[2]], p[v[3]]);
    }
    CHECK(plug_volume == doctest::Approx(8 * 0.6 * 0.6 * 0.2).epsilon(1e-9));
}

TEST_CASE("the rule decides about tets that a shape crosses") {
    const auto sphere = [](const char* rule) {
        const ConfigNode shape =
            ConfigNode::map({{"shape", "sphere"}, {"radius", 1.0}, {"rule", rule}});
        return count(build(ConfigNode::map(
                         {{"shape", "none"}, {"shapes", ConfigNode::list({shape})}})))
            .object_volume;
    };
    const double exact = 4.0 / 3.0 * 3.14159265;
    CHECK(sphere("vertices") == doctest::Approx(3.390667).epsilon(1e-6));
    CHECK(sphere("barycentre") == doctest::Approx(exact).epsilon(0.01));
}

TEST_CASE("a cancelled run gets no mesh") {
    dsc::host::Host host;
    host.load(DSC_TEST_PLUGIN);
    const auto grid =
        host.create<dsc::hooks::InitialMesh>({"grid", ConfigNode::map()}, "initial_mesh");
    dsc::CancelToken token;
    token.cancel();
    dsc::hooks::InitialMeshContext context;
    context.cancel = &token;
    CHECK_THROWS_AS(grid->build(context), dsc::CancelledError);
}

TEST_CASE("a shape without a direction is refused") {
    const ConfigNode shape =
        ConfigNode::map({{"shape", "cylinder"}, {"axis", ConfigNode::list({0.0, 0.0, 0.0})}});
    CHECK_THROWS_WITH_AS(build(ConfigNode::map({{"shapes", ConfigNode::list({shape})}})),
                         doctest::Contains("axis must not be the zero vector"), dsc::ConfigError);
}

TEST_CASE("the box may lie anywhere") {
    const auto mesh = build(ConfigNode::map({{"cells", 4},
                                             {"box", 0.5},
                                             {"box_centre", ConfigNode::list({0.5, 0.5, 0.5})},
                                             {"shape", "sphere"},
                                             {"centre", ConfigNode::list({0.5, 0.5, 0.5})},
                                             {"radius", 0.45}}));
    check_sound(count(mesh), mesh, 1.0);
    CHECK(mesh.points.front() == Vec3(0, 0, 0));
    CHECK(mesh.points.back() == Vec3(1, 1, 1));
    CHECK(count(mesh).labelled > 0);
}

TEST_CASE("projected, the sphere's vertices are on the radius and the box is as before") {
    const ConfigNode shape =
        ConfigNode::map({{"shape", "sphere"}, {"radius", 0.9}, {"rule", "barycentre"}});
    for (const ConfigNode& params :
         {ConfigNode::map({{"cells", 16}, {"shape", "sphere"}, {"radius", 0.9}, {"project", true}}),
          ConfigNode::map({{"cells", 16},
                           {"shape", "none"},
                           {"shapes", ConfigNode::list({shape})},
                           {"project", true}})}) {
        const auto mesh = build(params);
        check_sound(count(mesh), mesh, 27.0);
        CHECK(mesh.points.size() == 17 * 17 * 17);
        const auto surface = dsc::surface::extract_interface(mesh);
        CHECK(surface.points.size() > 200);
        for (const Vec3& p : surface.points) CHECK(p.norm() == doctest::Approx(0.9).epsilon(1e-11));
    }
}
