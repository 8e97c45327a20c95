// Tests of the requests on a mesh with a known fault; the plugin is loaded as in a run.
#include <algorithm>

#include <doctest/doctest.h>

#include <dsc/host/host.hpp>
#include <dsc/mesh/adopt.hpp>

namespace {

using namespace dsc;

// One cube of 5 tets in a box of 27 cells, the centre vertex of the inner cube pulled towards a
// face.
mesh::Complex cells(double squeeze) {
    mesh::TetMesh m;
    constexpr int n = 3;
    const auto at = [](int i, int j, int k) {
        return static_cast<std::uint32_t>(i + 4 * (j + 4 * k));
    };
    for (int k = 0; k <= n; ++k) {
        for (int j = 0; j <= n; ++j) {
            for (int i = 0; i <= n; ++i) m.points.push_back(Vec3(i == 2 ? 1.0 + squeeze : i, j, k));
        }
    }
    constexpr int even[5][4] = {
        {4, 0, 5, 6}, {2, 0, 6, 3}, {1, 0, 3, 5}, {7, 5, 6, 3}, {0, 6, 3, 5}};
    constexpr int odd[5][4] = {
        {0, 4, 1, 2}, {3, 2, 1, 7}, {6, 2, 7, 4}, {5, 4, 7, 1}, {4, 1, 2, 7}};
    for (int k = 0; k < n; ++k) {
        for (int j = 0; j < n; ++j) {
            for (int i = 0; i < n; ++i) {
                for (int t = 0; t < 5; ++t) {
                    const auto& row = (i + j + k) % 2 == 0 ? even[t] : odd[t];
                    std::array<std::uint32_t, 4> tet{};
                    for (unsigned c = 0; c < 4; ++c)
                        tet[c] =
                            at(i + (row[c] & 1), j + ((row[c] >> 1) & 1), k + ((row[c] >> 2) & 1));
                    m.tets.push_back(tet);
                    m.labels.push_back(i == 1 && j == 1 && k == 1 ? 1 : 0);
                }
            }
        }
    }
    return mesh::adopt(m, "cells", nullptr, 0.0);
}

std::vector<repair::Request> proposals(const mesh::Complex& c, const config::ConfigNode& params) {
    host::Host host;
    host.load(DSC_TEST_PLUGIN);
    const auto strategy = host.create<hooks::Improvement>({"dsc", params}, "improvement");
    std::vector<mesh::TetId> dirty;
    for (mesh::TetId t = 0; t < c.tet_slots(); ++t) dirty.push_back(t);
    const surface::SurfaceView view;
    const hooks::StepContext step{.surface = view, .box = {}, .to_normalised = {}};
    const repair::RepairRound round{c, dirty, {}, {}, {}, 1.0, strategy->flatness(), 0, true};
    std::vector<repair::Request> out;
    strategy->propose(step, round, out);
    return out;
}

}  // namespace

TEST_CASE("a mesh of good tets needs no repair") {
    CHECK(proposals(cells(1.0), config::ConfigNode::map()).empty());
}

TEST_CASE("bad tets are requested worst first, each with edges, interface, faces") {
    const mesh::Complex c = cells(0.02);
    const auto requests = proposals(c, config::ConfigNode::map());
    REQUIRE_FALSE(requests.empty());
    float last = 0.0F;
    std::size_t removals = 0;
    for (const auto& r : requests) {
        if (r.operation != repair::Operation::edge_removal) continue;
        ++removals;
        CHECK(c.quality(r.tet) < 0.2F);
        CHECK(c.quality(r.tet) >= last - 1e-4F);
        last = c.quality(r.tet);
        CHECK(r.birth_date == c.birth_date(r.tet));
    }
    std::size_t bad = 0;
    for (mesh::TetId t = 0; t < c.tet_slots(); ++t) bad += c.quality(t) < 0.2F ? 1 : 0;
    CHECK(removals == bad);
    CHECK(bad > 0);
}

TEST_CASE(
    "short interface edges are collapsed within the bounds, unless the threshold says otherwise") {
    const auto shorts = [](const config::ConfigNode& params) {
        const mesh::Complex c = cells(0.3);
        const auto requests = proposals(c, params);
        return std::count_if(requests.begin(), requests.end(), [](const repair::Request& r) {
            return r.operation == repair::Operation::edge_collapse &&
                   r.mode == repair::CollapseMode::bounded && r.vertices[1] != mesh::none;
        });
    };
    // The cube between x = 1 and x = 1.3 has four edges of 0.3 along x.
    CHECK(shorts(config::ConfigNode::map()) == 4);
    CHECK(shorts(config::ConfigNode::map({{"min_edge_length", 0.2}})) == 0);
}

TEST_CASE("long edges from the interface into a phase are split on request, longest first") {
    const auto splits = [](const mesh::Complex& c, double longest) {
        auto requests = proposals(c, config::ConfigNode::map({{"max_free_edge", longest},
                                                              {"min_edge_length", 0.0},
                                                              {"max_edge_length", 100.0}}));
        requests.erase(std::remove_if(requests.begin(), requests.end(),
                                      [](const repair::Request& r) {
                                          return r.operation != repair::Operation::edge_split;
                                      }),
                       requests.end());
        return requests;
    };
    const auto length = [](const mesh::Complex& c, const repair::Request& r) {
        return (c.position(r.vertices[0]) - c.position(r.vertices[1])).norm();
    };
    const mesh::Complex c = cells(0.6);
    CHECK(splits(c, 0.0).empty());
    CHECK(splits(c, 3.0).empty());
    for (const double longest : {1.1, 1.5}) {
        std::size_t expected = 0;  // counted from the edges themselves
        std::vector<std::array<mesh::VertexId, 2>> seen;
        for (mesh::TetId t = 0; t < c.tet_slots(); ++t) {
            for (const auto& e : mesh::edge_vertices) {
                const mesh::VertexId a = std::min(c.tet(t).v[e[0]], c.tet(t).v[e[1]]),
                                     b = std::max(c.tet(t).v[e[0]], c.tet(t).v[e[1]]);
                if (c.on_interface(a) == c.on_interface(b) ||
                    std::find(seen.begin(), seen.end(), std::array{a, b}) != seen.end())
                    continue;
                seen.push_back({a, b});
                expected += (c.position(a) - c.position(b)).norm() > longest ? 1 : 0;
            }
        }
        const auto requests = splits(c, longest);
        CHECK(expected > 0);
        CHECK(requests.size() == expected);
        for (std::size_t i = 1; i < requests.size(); ++i)
            CHECK(length(c, requests[i - 1]) > length(c, requests[i]) - 1e-3);
    }
}

TEST_CASE("the topology policy follows its parameters") {
    host::Host host;
    host.load(DSC_TEST_PLUGIN);
    const auto off = host.create<hooks::Improvement>(
        {"dsc",
         config::ConfigNode::map(
             {{"topology", config::ConfigNode::map({{"thickness", 0.0}, {"merge", false}})}})},
        "improvement");
    CHECK(off->topology_limits().thickness == 0.0);
    CHECK_FALSE(off->topology_limits().merge);
    CHECK(off->topology_limits().open);
    const auto on =
        host.create<hooks::Improvement>({"dsc", config::ConfigNode::map()}, "improvement");
    CHECK(on->topology_limits().min_component == 2.0);
    // A cloud point within half a target length of the first candidate, none near the second.
    cloud::Cloud cloud;
    for (const double s : {-1.0, 1.0})
        cloud.points.insert(cloud.points.end(), {Vec3(s, 0, 0), Vec3(0, s, 0), Vec3(0, 0, s)});
    const cloud::TargetCloud target(cloud::normalize(cloud, 1.0));
    const surface::SurfaceView view;
    const hooks::StepContext step{
        .surface = view, .cloud = &target, .target_length = 0.1, .box = {}, .to_normalised = {}};
    std::vector<repair::TopologyCandidate> candidates(2);
    candidates[0].centroid = Vec3(0.96, 0, 0);
    candidates[1].centroid = Vec3(0.94, 0, 0);
    for (auto& candidate : candidates) candidate.kind = repair::TopologyCandidate::Kind::merge;
    std::vector<std::uint8_t> accept(2, 7);
    on->select(step, candidates, accept);
    CHECK(accept == std::vector<std::uint8_t>{0, 1});
    // The octahedron's points are sqrt(2) apart: such a sparse cloud forbids cuts of necks
    // everywhere near it.
    for (auto& candidate : candidates) candidate.kind = repair::TopologyCandidate::Kind::cut;
    on->select(step, candidates, accept);
    CHECK(accept == std::vector<std::uint8_t>{0, 0});
    candidates[1].centroid = Vec3(2.8, 0, 0);
    on->select(step, candidates, accept);
    CHECK(accept == std::vector<std::uint8_t>{0, 1});
}
