// Regions of the topology stage against recounts of the whole mesh.
#include <algorithm>
#include <array>
#include <cmath>

#include <doctest/doctest.h>

#include <dsc/base/random.hpp>
#include <dsc/mesh/validate.hpp>

#include "kernel/topology.hpp"
#include "shapes.hpp"

using namespace dsc;
using namespace dsc::kernel;

namespace {

std::size_t irregular_vertices(const mesh::Complex& c) {
    mesh::LocalStar star(c);
    std::size_t count = 0;
    for (const VertexId v : c.interface_vertices()) {
        star.build(v);
        count += star.regular() ? 0 : 1;
    }
    return count;
}

// A random set of tets of one label: round an edge or a vertex, or a tet and some neighbours. Empty
// when unlucky.
void random_region(const mesh::Complex& c, RandomStream& random, Region& region) {
    region.tets.clear();
    auto t = static_cast<TetId>(random.index(c.tet_slots()));
    // Half of the time at the interface, where something can happen.
    if (random.index(2) == 0)
        t = c.seed(c.interface_vertices()[random.index(c.interface_vertices().size())]);
    if (!c.tet_alive(t)) return;
    region.from = c.label(t);
    const auto shape = random.index(8);
    if (shape >= 5) {
        // What of the label lies in one cell of the grid: the thickness of the meshes' thin parts.
        const auto cell = [&c](TetId s) {
            Vec3 centroid = Vec3::Zero();
            for (const VertexId v : c.tet(s).v) centroid += 0.25 * c.position(v);
            return std::array<double, 3>{std::floor(centroid.x() / 0.375),
                                         std::floor(centroid.y() / 0.375),
                                         std::floor(centroid.z() / 0.375)};
        };
        const auto place = cell(t);
        std::vector<TetId> queue = {t};
        for (std::size_t i = 0; i < queue.size(); ++i) {
            region.tets.push_back(queue[i]);
            for (unsigned f = 0; f < 4; ++f) {
                const std::uint32_t code = c.across(queue[i], f);
                if (code == mesh::none) continue;
                const TetId next = mesh::neighbour_tet(code);
                if (cell(next) == place &&
                    std::find(queue.begin(), queue.end(), next) == queue.end())
                    queue.push_back(next);
            }
        }
    } else if (shape == 4) {
        // A whole component, if it is small enough.
        region.tets.push_back(t);
        for (std::size_t i = 0; i < region.tets.size() && region.tets.size() < 200; ++i) {
            for (unsigned f = 0; f < 4; ++f) {
                const std::uint32_t code = c.across(region.tets[i], f);
                if (code == mesh::none) continue;
                const TetId next = mesh::neighbour_tet(code);
                if (c.label(next) == region.from &&
                    std::find(region.tets.begin(), region.tets.end(), next) == region.tets.end()) {
                    region.tets.push_back(next);
                }
            }
        }
    } else if (shape <= 1) {
        const auto& e = mesh::edge_vertices[random.index(6)];
        mesh::EdgeRing ring;
        c.ring(t, c.tet(t).v[e[0]], c.tet(t).v[e[1]], ring);
        region.tets = ring.tets;
    } else if (shape == 2) {
        c.star(c.tet(t).v[random.index(4)], region.tets);
    } else {
        region.tets.push_back(t);
        const auto size = 1 + random.index(8);
        while (region.tets.size() < size) {
            const TetId s = region.tets[random.index(region.tets.size())];
            const std::uint32_t code = c.across(s, static_cast<unsigned>(random.index(4)));
            if (code == mesh::none) break;
            const TetId next = mesh::neighbour_tet(code);
            if (std::find(region.tets.begin(), region.tets.end(), next) == region.tets.end())
                region.tets.push_back(next);
        }
    }
    region.tets.erase(
        std::remove_if(region.tets.begin(), region.tets.end(),
                       [&](TetId s) { return c.label(s) != region.from || touches_box(c, s); }),
        region.tets.end());
    if (region.tets.empty()) return;
    // Towards a label that the region touches, now and then a new one.
    region.to = region.from;
    for (int attempt = 0; attempt < 8 && region.to == region.from; ++attempt) {
        const TetId s = region.tets[random.index(region.tets.size())];
        const std::uint32_t code = c.across(s, static_cast<unsigned>(random.index(4)));
        if (code != mesh::none) region.to = c.label(mesh::neighbour_tet(code));
    }
    if (region.to == region.from) region.to = region.from == 0 ? 1 : 0;
}

}  // namespace

TEST_CASE("random regions: accepted exactly when a recount says regular, and the kind is what the "
          "recount says") {
    constexpr int wanted = 26000;
    std::vector<test::LabelledMesh> meshes = test::labelled_meshes();
    REQUIRE(meshes.size() == 8);
    RandomStream random(RandomKey{2024, 0, 0, 0});
    std::array<int, 7> kinds{};
    std::array<int, 7> faults{};
    int tried = 0, regular_count = 0, irregular_count = 0, shifts = 0;
    for (auto& m : meshes) {
        CAPTURE(m.name);
        mesh::Complex& c = m.complex;
        const mesh::Complex start = c;
        Workbench bench(c);
        bench.limits = {1.0, 1e-3, 0.5, 0.1, 0.995};
        TopologyStage stage(bench);
        Region region;
        REQUIRE(irregular_vertices(c) == 0);
        for (int round = 0; round < wanted / 8; ++tried) {
            if (round % 50 == 0) c = start;
            random_region(c, random, region);
            if (region.tets.empty()) continue;
            ++round;
            if (round % 2 == 0) {
                const RegionFault fault = grow(bench, region);
                ++faults[static_cast<std::size_t>(fault)];
                if (fault != RegionFault::none) continue;
            }
            const mesh::InterfaceCounts before = mesh::count_interface(c);
            const bool accepted = regular(bench, region);
            const RegionFault shape = measure(bench, region);
            c.relabel(region.tets, region.to);
            const bool truth = irregular_vertices(c) == 0;
            REQUIRE(accepted == truth);
            const mesh::InterfaceCounts after = mesh::count_interface(c);
            c.relabel(region.tets, region.from);
            (truth ? regular_count : irregular_count) += 1;
            if (!truth || shape != RegionFault::none) continue;
            const unsigned s = region.patches_from, o = region.patches_to;
            // With three labels the interface is not a surface, and patches towards the third are
            // not of these two sides.
            if (m.name == "two phases") continue;
            CAPTURE(s);
            CAPTURE(o);
            CAPTURE(region.tets.size());
            CAPTURE(region.from);

            REQUIRE(after.euler() - before.euler() ==
                    2 * (static_cast<long>(s) - static_cast<long>(o)));
            if (s == 1 && o == 1) {
                ++shifts;
                REQUIRE(after.shells == before.shells);
                continue;
            }
            const bool event = (s == 1 && o == 2) || (s == 2 && o == 1) || (s == 0 && o == 1) ||
                               (s == 1 && o == 0);
            if (!event) continue;
            const Event result = stage.commit(region, 1);
            ++kinds[static_cast<std::size_t>(result.kind)];
            const long shells = static_cast<long>(after.shells) - static_cast<long>(before.shells);
            const long genus = after.genus() - before.genus();
            switch (result.kind) {
                case Event::Kind::merge: REQUIRE((shells == -1 && genus == 0)); break;
                case Event::Kind::split: REQUIRE((shells == 1 && genus == 0)); break;
                case Event::Kind::handle_opened: REQUIRE((shells == 0 && genus == 1)); break;
                case Event::Kind::handle_closed: REQUIRE((shells == 0 && genus == -1)); break;
                case Event::Kind::vanished: REQUIRE((shells == -1 && genus == 0)); break;
                case Event::Kind::born: REQUIRE((shells == 1 && genus == 0)); break;
                case Event::Kind::unpinched: REQUIRE(false); break;
            }
            if (round % 3 != 0) c.relabel(region.tets, region.from);
        }
        const mesh::ComplexReport report = mesh::validate(c);
        CHECK(report.faults == std::vector<std::string>{});
    }
    MESSAGE("regular " << regular_count << ", irregular " << irregular_count << ", shifts "
                       << shifts << "; merge " << kinds[0] << ", split " << kinds[1]
                       << ", handle_opened " << kinds[2] << ", handle_closed " << kinds[3]
                       << ", vanished " << kinds[4] << ", born " << kinds[5] << "; grown: ok "
                       << faults[0] << ", irregular " << faults[1] << ", too large " << faults[2]
                       << ", box " << faults[5]);
    for (std::size_t k = 0; k < 6; ++k) {
        CAPTURE(k);
        CHECK(kinds[k] >= 100);
    }
    CHECK(regular_count > 1000);
    CHECK(irregular_count > 1000);
    CHECK(shifts > 100);
}
