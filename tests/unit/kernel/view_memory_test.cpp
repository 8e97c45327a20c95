// A view that remembers the last one is the view that walks round every vertex, whatever happened
// in between.
#include <algorithm>
#include <map>
#include <set>
#include <string>

#include <doctest/doctest.h>

#include <dsc/base/random.hpp>
#include <dsc/kernel/deformer.hpp>
#include <dsc/mesh/adopt.hpp>
#include <dsc/surface/surface_view.hpp>

#include "policy.hpp"
#include "shapes.hpp"

using namespace dsc;
using namespace dsc::kernel;

namespace {

void check_same(const surface::SurfaceView& a, const surface::SurfaceView& b) {
    CHECK(a.vertex_ids == b.vertex_ids);
    CHECK(a.births == b.births);
    CHECK(a.positions == b.positions);
    CHECK(a.normals == b.normals);
    CHECK(a.movable == b.movable);
    CHECK(a.faces == b.faces);
    CHECK(a.face_tets == b.face_tets);
    CHECK(a.face_labels == b.face_labels);
    CHECK(a.face_normals == b.face_normals);
    CHECK(a.face_areas == b.face_areas);
    CHECK(a.face_offsets == b.face_offsets);
    CHECK(a.vertex_faces == b.vertex_faces);
    CHECK(a.mean_edge == b.mean_edge);
}

}  // namespace

TEST_CASE("a view with memory is the same as one without, after steps, splits, collapses and "
          "relabelling") {
    for (const std::uint64_t seed : {3U, 4U}) {
        Deformer d(mesh::adopt(test::ball_grid(12, 0.8), "ball"));
        RandomStream random(RandomKey{seed, 0, 0, 0});
        surface::ViewMemory memory;
        surface::SurfaceView view, whole;
        Workers two(2);
        for (int round = 0; round < 8; ++round) {
            surface::build_view(d.complex(), view, round % 2 == 0 ? nullptr : &two, &memory);
            surface::build_view(d.complex(), whole);
            check_same(view, whole);
            // A few vertices wander and a few edges change: most stars stay as they were.
            std::vector<Vec3> displacements(view.vertex_count(), Vec3::Zero());
            for (int k = 0; k < 12; ++k) {
                const auto i = static_cast<std::size_t>(
                    random.uniform(0, static_cast<double>(view.vertex_count())));
                displacements[i] =
                    0.4 * view.mean_edge *
                    Vec3(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
            }
            if (round % 2 == 0) d.step(view.vertex_ids, displacements, test::quality_policy());
            RefineRequests requests;
            requests.owns_sizing = true;
            for (int k = 0; k < 12; ++k) {
                const auto f = static_cast<std::size_t>(
                    random.uniform(0, static_cast<double>(view.face_count())));
                const auto& [a, b, c] = view.faces[f];
                const auto id = [&](std::uint32_t v) { return view.vertex_ids[v]; };
                if (k % 3 == 0) requests.split_edges.push_back({id(a), id(b)});
                if (k % 3 == 1)
                    requests.collapses.push_back(
                        {id(a), id(b), 0.5 * (view.positions[a] + view.positions[b])});
                if (k % 3 == 2) requests.flips.push_back({id(a), id(c), 0.0});
            }
            CHECK(d.refine(requests).committed > 0);
            if (round == 5) {
                std::vector<Event> events;
                const mesh::TetId tet = view.face_tets[view.face_count() / 2];
                const std::vector<mesh::TetId> tets = {tet};
                const std::vector<mesh::Label> labels = {2};
                if (d.complex().tet_alive(tet))
                    d.relabel(tets, labels, test::quality_policy(), events);
            }
        }
    }
}

TEST_CASE("memory of unchanged stars is used, and one changed star is walked again") {
    Deformer d(mesh::adopt(test::ball_grid(10, 0.8), "ball"));
    surface::ViewMemory memory;
    surface::SurfaceView view;
    surface::build_view(d.complex(), view, nullptr, &memory);
    const auto known = [&](std::uint32_t i) {
        bool is_known = false;
        memory.faces_led_by(d.complex(), view.vertex_ids[i], i, is_known);
        return is_known;
    };
    std::size_t before = 0, after = 0;
    for (std::uint32_t i = 0; i < view.vertex_count(); ++i) before += known(i) ? 1 : 0;
    CHECK(before == view.vertex_count());
    RefineRequests requests;
    requests.owns_sizing = true;
    const auto& [a, b, c] = view.faces[0];
    requests.split_edges.push_back({view.vertex_ids[a], view.vertex_ids[b]});
    REQUIRE(d.refine(requests).committed == 1);
    CHECK(!known(a));
    CHECK(!known(b));
    for (std::uint32_t i = 0; i < view.vertex_count(); ++i) after += known(i) ? 1 : 0;
    CHECK(after > view.vertex_count() / 2);
    CHECK(after < view.vertex_count());
}

TEST_CASE(
    "if only positions change, a view keeps its connectivity and gets new positions and normals") {
    Deformer d(mesh::adopt(test::ball_grid(10, 0.8), "ball"));
    RandomStream random(RandomKey{5, 0, 0, 0});
    surface::ViewMemory memory;
    surface::SurfaceView view, whole, other;
    CHECK_FALSE(memory.only_moved(d.complex(), view));
    surface::build_view(d.complex(), view, nullptr, &memory);
    RepairPolicy moves_only;
    moves_only.topology.thickness = 0.0;
    for (int step = 0; step < 3; ++step) {
        std::vector<Vec3> displacements(view.vertex_count());
        for (Vec3& way : displacements)
            way = 0.1 * view.mean_edge *
                  Vec3(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
        const std::vector<Vec3> before = view.positions;
        d.step(view.vertex_ids, displacements, moves_only);
        REQUIRE(memory.only_moved(d.complex(), view));
        surface::build_view(d.complex(), view, nullptr, &memory);
        surface::build_view(d.complex(), whole);
        check_same(view, whole);
        CHECK(view.positions != before);
        CHECK(view.previous_positions == whole.previous_positions);
    }
    // The arrays of another view are not taken for those of the last one.
    CHECK_FALSE(memory.only_moved(d.complex(), other));
    other = view;
    std::swap(other.faces[0], other.faces[1]);
    CHECK_FALSE(memory.only_moved(d.complex(), other));
    surface::build_view(d.complex(), other, nullptr, &memory);
    check_same(other, whole);
    RefineRequests requests;
    requests.owns_sizing = true;
    const auto& [a, b, c] = view.faces[0];
    requests.split_edges.push_back({view.vertex_ids[a], view.vertex_ids[b]});
    REQUIRE(d.refine(requests).committed == 1);
    CHECK_FALSE(memory.only_moved(d.complex(), view));
}

TEST_CASE("the labels of a face are those of its two tets, the smaller one first") {
    for (const test::LabelledMesh& mesh : test::labelled_meshes()) {
        CAPTURE(mesh.name);
        const mesh::Complex& c = mesh.complex;
        // All interface faces by their vertices, without the view.
        std::map<std::array<mesh::VertexId, 3>, std::array<mesh::Label, 2>> expected;
        for (mesh::TetId t = 0; t < c.tet_slots(); ++t) {
            if (!c.tet_alive(t)) continue;
            for (unsigned f = 0; f < 4; ++f) {
                if (!c.interface_face(t, f)) continue;
                std::array<mesh::VertexId, 3> key{};
                for (unsigned k = 0; k < 3; ++k) key[k] = c.tet(t).v[mesh::face_vertices[f][k]];
                std::sort(key.begin(), key.end());
                expected[key] = {std::min(c.label(t), c.label_across(t, f)),
                                 std::max(c.label(t), c.label_across(t, f))};
            }
        }
        surface::SurfaceView view;
        surface::build_view(c, view);
        REQUIRE(view.face_labels.size() == expected.size());
        std::set<mesh::Label> seen;
        for (std::size_t f = 0; f < view.face_count(); ++f) {
            std::array<mesh::VertexId, 3> key{};
            for (unsigned k = 0; k < 3; ++k) key[k] = view.vertex_ids[view.faces[f][k]];
            std::sort(key.begin(), key.end());
            CHECK(view.face_labels[f] == expected.at(key));
            CHECK(view.face_labels[f][1] == c.label(view.face_tets[f]));
            seen.insert(view.face_labels[f].begin(), view.face_labels[f].end());
        }
        CHECK(seen.size() == (std::string(mesh.name) == "two phases" ? 3 : 2));
    }
}
