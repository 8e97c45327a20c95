// Target lengths and attributes per vertex: how they follow the edits, what they decide, and that
// they outlive a checkpoint.
#include <algorithm>
#include <cmath>

#include <doctest/doctest.h>

#include <dsc/base/random.hpp>
#include <dsc/base/state.hpp>
#include <dsc/geometry/quality.hpp>
#include <dsc/kernel/deformer.hpp>
#include <dsc/mesh/validate.hpp>
#include <dsc/surface/surface_view.hpp>

#include "policy.hpp"
#include "shapes.hpp"

using namespace dsc;
using namespace dsc::kernel;
using mesh::VertexId;

namespace {

mesh::Complex start_ball(int cells = 14, double radius = 0.8) {
    return mesh::adopt(test::ball_grid(cells, radius), "ball");
}

surface::SurfaceView surface_of(const Deformer& d) {
    surface::SurfaceView view;
    surface::build_view(d.complex(), view);
    return view;
}

// A linear function of the place: its value at the middle of an edge is the mean of its values at
// the ends.
double slope(const Vec3& p) { return 2.0 + p.x() + 0.5 * p.y() - 0.25 * p.z(); }

std::vector<double> slopes(const surface::SurfaceView& view) {
    std::vector<double> values;
    for (const Vec3& p : view.positions) values.push_back(slope(p));
    return values;
}

// A step in which the vertices wander a third of a mean edge, so that edits are needed.
void shake(Deformer& d, std::uint64_t seed, const RepairPolicy& policy) {
    const surface::SurfaceView view = surface_of(d);
    RandomStream random(RandomKey{seed, 0, 0, 0});
    std::vector<Vec3> displacements;
    for (std::size_t i = 0; i < view.vertex_count(); ++i) {
        displacements.emplace_back(
            0.33 * view.mean_edge *
            Vec3(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)));
    }
    d.step(view.vertex_ids, displacements, policy);
}

std::string bytes(const Deformer& d) {
    StateWriter out;
    d.save(out);
    return out.take();
}

}  // namespace

TEST_CASE("splits give the mean of the edge's ends, to lengths and attributes") {
    Deformer d(start_ball(10));
    surface::SurfaceView view = surface_of(d);
    const std::vector<double> before = slopes(view);
    d.set_target_lengths(view.vertex_ids, before);
    d.set_attribute("tilt", view.vertex_ids, before);
    CHECK(d.attributes() == std::vector<std::string>{"tilt"});
    RefineRequests requests;
    requests.owns_sizing = true;
    for (const auto& face : view.faces) {
        requests.split_faces.push_back(
            {view.vertex_ids[face[0]], view.vertex_ids[face[1]], view.vertex_ids[face[2]]});
    }
    const double length = d.target_length();
    CHECK(d.refine(requests).committed > view.face_count() / 4);
    CHECK(d.target_length() == length);
    view = surface_of(d);
    REQUIRE(view.vertex_count() > before.size());
    const std::vector<double> expected = slopes(view), lengths = d.target_lengths(view.vertex_ids),
                              tilt = d.attribute("tilt", view.vertex_ids);
    REQUIRE(lengths.size() == view.vertex_count());
    for (std::size_t i = 0; i < view.vertex_count(); ++i) {
        CHECK(lengths[i] == doctest::Approx(expected[i]).epsilon(1e-12));
        CHECK(tilt[i] == lengths[i]);
    }
}

TEST_CASE("a collapse leaves the kept end its length and puts it where it is wanted") {
    Deformer d(start_ball(12));
    surface::SurfaceView view = surface_of(d);
    d.set_attribute("tilt", view.vertex_ids, slopes(view));
    std::vector<surface::ViewEdge> edges;
    surface::build_edges(view, edges);
    const std::size_t vertices = view.vertex_count();
    std::size_t done = 0;
    for (std::size_t i = 0; i < edges.size() && done < 5; i += 5) {
        const auto [a, b] = edges[i].vertices;
        const VertexId kept = view.vertex_ids[a], removed = view.vertex_ids[b];
        if (!d.complex().vertex_alive(kept) || !d.complex().vertex_alive(removed)) continue;
        // Not at one of the places that a collapse would choose by itself.
        const Vec3 place = 0.7 * d.complex().position(kept) + 0.3 * d.complex().position(removed);
        RefineRequests requests;
        requests.owns_sizing = true;
        requests.collapses.push_back({kept, removed, place});
        const std::uint32_t birth = d.complex().birth(kept);
        const double value = slope(d.complex().position(kept));
        if (d.refine(requests).committed == 0) continue;
        ++done;
        CHECK(d.complex().birth(kept) == birth);
        CHECK(d.complex().position(kept) == place);
        CHECK(d.attribute("tilt", std::vector<VertexId>{kept})[0] == value);
    }
    CHECK(done >= 3);
    view = surface_of(d);
    CHECK(view.vertex_count() == vertices - done);
    CHECK(mesh::validate(d.complex()).faults == std::vector<std::string>{});
    CHECK(mesh::count_interface(d.complex()).euler() == 2);
}

TEST_CASE("a flip swaps the diagonal of flat faces only") {
    Deformer d(start_ball(12));
    const surface::SurfaceView view = surface_of(d);
    std::vector<surface::ViewEdge> edges;
    surface::build_edges(view, edges);
    const auto opposite = [&](const surface::ViewEdge& e, int side) {
        for (const std::uint32_t v : view.faces[e.faces[static_cast<std::size_t>(side)]]) {
            if (v != e.vertices[0] && v != e.vertices[1]) return view.vertex_ids[v];
        }
        return mesh::none;
    };
    std::size_t flipped = 0;
    for (std::size_t i = 0; i < edges.size() && flipped == 0; ++i) {
        const auto& e = edges[i];
        const double cosine = view.face_normals[e.faces[0]].dot(view.face_normals[e.faces[1]]);
        const VertexId a = view.vertex_ids[e.vertices[0]], b = view.vertex_ids[e.vertices[1]];
        RefineRequests requests;
        requests.flips.push_back({a, b, cosine + 1e-9});
        CHECK(d.refine(requests).committed == 0);
        requests.flips[0].flatness = -1.0;
        if (d.refine(requests).committed == 0) continue;
        ++flipped;
        CHECK(d.complex().find_edge(opposite(e, 0), opposite(e, 1)) != mesh::none);
        CHECK(surface_of(d).face_count() == view.face_count());
        std::vector<surface::ViewEdge> after;
        const surface::SurfaceView now = surface_of(d);
        surface::build_edges(now, after);
        CHECK(after.size() == edges.size());
        CHECK(std::none_of(after.begin(), after.end(),
                           [&](const auto& x) { return x.vertices == e.vertices; }));
    }
    CHECK(flipped == 1);
    CHECK(mesh::validate(d.complex()).faults == std::vector<std::string>{});
}

TEST_CASE(
    "a vertex goes where it is wanted if nothing is in its way, and as far as it can otherwise") {
    Deformer d(start_ball(12));
    const surface::SurfaceView view = surface_of(d);
    const VertexId near = view.vertex_ids[3], far = view.vertex_ids[view.vertex_count() - 3];
    const Vec3 close = d.complex().position(near) + 0.01 * view.normals[3],
               start = d.complex().position(far);
    RefineRequests requests;
    requests.moves = {{near, close}, {far, Vec3(0.9, 0.9, 0.9)}};
    CHECK(d.refine(requests).committed == 2);
    CHECK((d.complex().position(near) - close).norm() < 1e-3 * d.target_length());
    CHECK((d.complex().position(far) - start).norm() > 0.01 * d.target_length());
    CHECK(mesh::validate(d.complex()).faults == std::vector<std::string>{});
    for (mesh::TetId t = 0; t < d.complex().tet_slots(); ++t) {
        if (d.complex().tet_alive(t) && mesh::has_vertex(d.complex().tet(t), far))
            CHECK(static_cast<double>(d.complex().quality(t)) >= 0.019);
    }
}

TEST_CASE(
    "vertices that come to the interface without a split have the values of their neighbours") {
    Deformer d(start_ball(12));
    const surface::SurfaceView view = surface_of(d);
    const std::vector<double> ones(view.vertex_count(), 3.0);
    d.set_attribute("three", view.vertex_ids, ones);
    // A tet of the inside with all its corners there becomes outside: a bubble, joined to nothing.
    std::vector<mesh::TetId> inside;
    for (mesh::TetId t = 0; t < d.complex().tet_slots() && inside.empty(); ++t) {
        const auto& v = d.complex().tet(t).v;
        const bool free = std::none_of(v.begin(), v.end(),
                                       [&](VertexId x) { return d.complex().on_interface(x); });
        if (d.complex().tet_alive(t) && d.complex().label(t) == 1 && free) inside.push_back(t);
    }
    REQUIRE(inside.size() == 1);
    // And one at the surface.
    const mesh::TetId rim = view.face_tets[0];
    std::vector<mesh::TetId> tets = {inside[0], rim};
    std::vector<Event> events;
    CHECK(d.relabel(tets, std::vector<mesh::Label>(2, 0), {}, events) == 2);
    const surface::SurfaceView now = surface_of(d);
    const std::vector<double> values = d.attribute("three", now.vertex_ids);
    std::size_t threes = 0, zeros = 0;
    for (std::size_t i = 0; i < values.size(); ++i) {
        threes += values[i] == 3.0 ? 1 : 0;
        zeros += values[i] == 0.0 ? 1 : 0;
    }
    CHECK(zeros == 4);
    CHECK(threes == now.vertex_count() - 4);
    const VertexId deep = d.complex().tet(inside[0]).v[0];
    CHECK_FALSE(std::isnan(d.attribute("three", std::vector<VertexId>{deep})[0]));
}

TEST_CASE("bounds of edits read the local length") {
    // With a tiny target length no collapse may move the interface; with the ordinary one it may.
    std::array<std::size_t, 2> committed{};
    for (const bool tiny : {false, true}) {
        Deformer d(start_ball(12));
        const surface::SurfaceView view = surface_of(d);
        if (tiny) {
            std::vector<double> lengths(view.vertex_count(), d.target_length());
            // L, the mean, stays what it is: half of the surface is fine, half is coarse.
            for (std::size_t i = 0; i < lengths.size(); ++i)
                lengths[i] *= view.positions[i].x() > 0.0 ? 1.98 : 0.02;
            d.set_target_lengths(view.vertex_ids, lengths);
        }
        RefineRequests requests;
        requests.owns_sizing = true;
        std::vector<surface::ViewEdge> edges;
        surface::build_edges(view, edges);
        for (const auto& e : edges) {
            const Vec3 middle =
                0.5 * (view.positions[e.vertices[0]] + view.positions[e.vertices[1]]);
            if (middle.x() > -0.3) continue;
            requests.collapses.push_back(
                {view.vertex_ids[e.vertices[0]], view.vertex_ids[e.vertices[1]], middle});
        }
        committed[tiny ? 1 : 0] = d.refine(requests).committed;
    }
    CHECK(committed[0] > 20);
    CHECK(committed[1] < committed[0] / 4);  // where the interface is flat nothing moves
}

TEST_CASE(
    "a refinement that does not own the sizing makes L the mean edge, one that owns it does not") {
    for (const bool owns : {false, true}) {
        Deformer d(start_ball(10));
        const surface::SurfaceView view = surface_of(d);
        d.set_target_lengths(view.vertex_ids, std::vector<double>(view.vertex_count(), 0.5));
        CHECK(d.target_length() == doctest::Approx(0.5));
        RefineRequests requests;
        requests.owns_sizing = owns;
        const auto& face = view.faces[0];
        requests.split_faces.push_back(
            {view.vertex_ids[face[0]], view.vertex_ids[face[1]], view.vertex_ids[face[2]]});
        const RefineReport report = d.refine(requests);
        CHECK(report.committed == 1);
        CHECK(report.length_changed == !owns);
        CHECK(d.target_lengths(view.vertex_ids).empty() == !owns);
        CHECK(d.target_length() == doctest::Approx(owns ? 0.5 : surface_of(d).mean_edge));
    }
    Deformer d(start_ball(10));
    d.set_target_length(0.25);
    CHECK(d.target_length() == 0.25);
}

TEST_CASE("the improvement sees the lengths and whether it may edit for size") {
    Deformer d(start_ball(10));
    const surface::SurfaceView view = surface_of(d);
    RepairPolicy policy;
    policy.topology.thickness = 0.0;
    bool told = false, size_edits = true;
    double seen = 0.0;
    policy.propose = [&](const repair::RepairRound& round, std::vector<repair::Request>&) {
        told = !round.lengths.empty();
        size_edits = round.size_edits;
        seen = round.length_at(view.vertex_ids[7]);
        CHECK(round.length_of(view.face_tets[0]) > 0.0);
    };
    shake(d, 1, policy);
    CHECK_FALSE(told);
    CHECK(size_edits);
    CHECK(seen == d.target_length());
    std::vector<double> lengths(view.vertex_count(), 0.1);
    lengths[7] = 0.3;
    d.set_target_lengths(view.vertex_ids, lengths);
    policy.size_edits = false;
    shake(d, 2, policy);
    CHECK(told);
    CHECK_FALSE(size_edits);
    CHECK(seen == 0.3);
}

TEST_CASE("with lengths and attributes a saved deformer goes on to the same bytes, and edits keep "
          "every value within its range") {
    Deformer d(start_ball(12, 0.6));
    const surface::SurfaceView view = surface_of(d);
    std::vector<double> lengths;
    for (const Vec3& p : view.positions) lengths.push_back(d.target_length() * (1.0 + 0.4 * p.x()));
    d.set_target_lengths(view.vertex_ids, lengths);
    d.set_attribute("tilt", view.vertex_ids, slopes(view));
    const auto [low, high] = std::minmax_element(lengths.begin(), lengths.end());
    const RepairPolicy policy = test::quality_policy();
    for (std::uint64_t step = 0; step < 4; ++step) shake(d, step, policy);
    const std::string state = bytes(d);
    StateReader in(state);
    Deformer resumed = Deformer::load(in);
    CHECK(in.at_end());
    CHECK(bytes(resumed) == state);
    for (std::uint64_t step = 4; step < 8; ++step) {
        shake(d, step, policy);
        shake(resumed, step, policy);
    }
    CHECK(bytes(resumed) == bytes(d));
    const surface::SurfaceView now = surface_of(d);
    for (const double length : d.target_lengths(now.vertex_ids)) {
        CHECK(length >= *low);
        CHECK(length <= *high);
    }
    CHECK(d.attribute("tilt", now.vertex_ids).size() == now.vertex_count());
}
