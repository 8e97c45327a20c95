#include "strategy.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <dsc/geometry/predicates.hpp>
#include <dsc/geometry/quality.hpp>
#include <dsc/host/host.hpp>
#include <dsc/mesh/adopt.hpp>
#include <dsc/mesh/validate.hpp>
#include <map>

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
ConfigNode only(const ConfigNode& shape, int cells, double growth = 2.0, int layers = 2, const char* finest = "parity") {
    return ConfigNode::map({{"shape", "none"},
                            {"shapes", ConfigNode::list({shape})},
                            {"cells", cells},
                            {"growth", growth},
                            {"layers", layers},
                            {"finest", finest}});
}

double quality(const TetMesh& m, std::size_t t) {
    const auto& v = m.tets[t];
    return dsc::geometry::tet_quality(m.points[v[0]], m.points[v[1]], m.points[v[2]], m.points[v[3]]);
}
[[maybe_unused]] double longest_edge(const TetMesh& m, std::size_t t) {
    double longest = 0;
    for (const auto& e : dsc::mesh::edge_vertices) {
        longest = std::max(longest, (m.points[m.tets[t][e[0]]] - m.points[m.tets[t][e[1]]]).norm());
    }
    return longest;
}
[[maybe_unused]] Vec3 barycentre(const TetMesh& m, std::size_t t) {
    const auto& v = m.tets[t];
    return 0.25 * (m.points[v[0]] + m.points[v[1]] + m.points[v[2]] + m.points[v[3]]);
}

struct Adopted {
    dsc::mesh::Complex complex;
    dsc::mesh::AdoptReport report;
    dsc::mesh::InterfaceCounts interface;
};

// Positive as it comes, conforming, filling the box, every vertex of the interface regular, none on the box.
[[maybe_unused]] Adopted check_sound(const TetMesh& m) {
    Adopted out;
    out.complex = dsc::mesh::adopt(m, "lattice", &out.report);
    CHECK(out.report.reoriented_tets == 0);
    CHECK(out.report.dropped_vertices == 0);
    CHECK(out.report.unpinched_vertices == 0);
    CHECK(out.report.vanished_components == 0);
    CHECK(out.complex.tet_count() == m.tets.size());
    const auto found = dsc::mesh::validate(out.complex);
    CHECK(found.valid());
    CHECK(found.irregular_vertices == 0);
    for (const auto v : out.complex.interface_vertices()) REQUIRE_FALSE(out.complex.on_box(v));
    out.interface = dsc::mesh::count_interface(out.complex);
    return out;
}

}  // namespace

TEST_CASE("measure") {
    for (const char* finest : {"parity", "bcc"}) {
        for (const int cells : {30, 60, 90, 196}) {
            for (const bool cube : {true, false}) {
                const TetMesh m = build(cube ? ConfigNode::map({{"cells", cells}, {"finest", finest}}) : only(sphere(1.0), cells, 2.0, 2, finest));
                std::vector<double> q;
                for (std::size_t t = 0; t < m.tets.size(); ++t) q.push_back(quality(m, t));
                std::sort(q.begin(), q.end());
                dsc::mesh::AdoptReport report;
                const auto complex = dsc::mesh::adopt(m, "lattice", &report);
                const double n = static_cast<double>(complex.interface_vertices().size());
                const auto counts = dsc::mesh::count_interface(complex);
                MESSAGE(finest, " ", cells, cube ? " cube " : " sphere ", "N ", n, " tets/N ", static_cast<double>(m.tets.size()) / n, " min ", q.front(), " median ",
                        q[q.size() / 2], " unpinched ", report.unpinched_vertices, " reoriented ", report.reoriented_tets, " euler ", counts.euler(), " shells ", counts.shells,
                        " volume ", dsc::mesh::labelled_volume(complex), " valid ", dsc::mesh::validate(complex).valid());
            }
        }
    }
}
