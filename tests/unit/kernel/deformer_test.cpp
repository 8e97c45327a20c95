// The Deformer as a whole: motion, books, ends.
#include <algorithm>
#include <cmath>

#include <doctest/doctest.h>

#include <dsc/base/random.hpp>
#include <dsc/geometry/quality.hpp>
#include <dsc/kernel/deformer.hpp>
#include <dsc/mesh/validate.hpp>

#include "policy.hpp"
#include "shapes.hpp"

using namespace dsc;
using namespace dsc::kernel;
using mesh::VertexId;

namespace {

std::vector<VertexId> by_birth(const mesh::Complex& c) {
    std::vector<VertexId> v(c.interface_vertices().begin(), c.interface_vertices().end());
    std::sort(v.begin(), v.end(), [&c](VertexId a, VertexId b) { return c.birth(a) < c.birth(b); });
    return v;
}

// Which of the two balls each vertex belongs to, by walking the interface from a vertex far left: 1
// for that shell.
std::vector<char> left_shell(const mesh::Complex& c) {
    std::vector<char> in(c.vertex_slots(), 0);
    std::vector<VertexId> queue;
    for (const VertexId v : c.interface_vertices()) {
        if (queue.empty() || c.position(v).x() < c.position(queue.front()).x()) queue.assign(1, v);
    }
    in[queue.front()] = 1;
    std::vector<mesh::TetId> star;
    for (std::size_t i = 0; i < queue.size(); ++i) {
        c.star(queue[i], star);
        for (const mesh::TetId t : star) {
            for (unsigned f = 0; f < 4; ++f) {
                if (c.tet(t).v[f] == queue[i] || !c.interface_face(t, f)) continue;
                for (const auto k : mesh::face_vertices[f]) {
                    const VertexId w = c.tet(t).v[k];
                    if (in[w] == 0) queue.push_back(w);
                    in[w] = 1;
                }
            }
        }
    }
    return in;
}

template <class Field>
StepReport drive(Deformer& d, const RepairPolicy& policy, Field&& field) {
    const std::vector<VertexId> vertices = by_birth(d.complex());
    std::vector<Vec3> displacements;
    for (const VertexId v : vertices) displacements.push_back(field(d.complex().position(v)));
    return d.step(vertices, displacements, policy);
}

mesh::Complex ball(int cells = 14, double radius = 0.8) {
    return mesh::adopt(test::ball_grid(cells, radius), "ball");
}

}  // namespace

TEST_CASE("an idle step changes nothing") {
    Deformer d(ball());
    const RepairPolicy policy = test::quality_policy();
    for (int i = 0; i < 5; ++i) drive(d, policy, [](const Vec3&) { return Vec3(Vec3::Zero()); });
    const auto before = d.complex().to_mesh();
    const std::uint32_t clock = d.complex().clock();
    const StepReport report = drive(d, policy, [](const Vec3&) { return Vec3(Vec3::Zero()); });
    CHECK(report.requested == 0);
    CHECK(report.rounds == 1);
    CHECK(d.complex().clock() == clock);
    CHECK(d.complex().to_mesh().points == before.points);
}

TEST_CASE("a translation there and back arrives, keeps the volume and stays valid") {
    Deformer d(ball(14, 0.6));
    const RepairPolicy policy = test::quality_policy();
    const double volume = mesh::labelled_volume(d.complex());
    double edits = 0.0;
    std::uint64_t committed = 0;
    for (int i = 0; i < 16; ++i) {
        const double sign = i < 8 ? 1.0 : -1.0;
        const StepReport report =
            drive(d, policy, [&](const Vec3&) { return Vec3(sign * Vec3(0.03, 0.03, 0.03)); });
        CHECK(report.clamped == 0);
        CHECK(report.dropped_motion < 0.05);
        CHECK(report.rounds <= 50);
        edits += report.edit_volume + report.relabelled_volume +
                 report.dropped_motion * d.target_length() * d.target_length();
        committed +=
            report.operations[static_cast<std::size_t>(repair::Operation::edge_removal)].committed;
    }
    CHECK(mesh::validate(d.complex()).faults == std::vector<std::string>{});
    CHECK(committed > 0);
    // A translation keeps the volume exactly: whatever changed was an edit, and the books hold it.
    CHECK(std::abs(mesh::labelled_volume(d.complex()) - volume) <= edits + 1e-9);
    CHECK(mesh::labelled_volume(d.complex()) == doctest::Approx(volume).epsilon(0.05));
    CHECK(mesh::count_interface(d.complex()).euler() == 2);
    Vec3 centre = Vec3::Zero();
    for (const VertexId v : d.complex().interface_vertices()) centre += d.complex().position(v);
    CHECK((centre / static_cast<double>(d.complex().interface_vertices().size())).norm() < 0.03);
}

TEST_CASE("destinations are clamped to the box shrunk by 2 L") {
    Deformer d(ball());
    const double margin = 1.5 - 2.0 * d.target_length();
    std::size_t clamped = 0;
    for (int i = 0; i < 12; ++i) {
        clamped += drive(d, test::quality_policy(), [](const Vec3& p) {
                       return Vec3(0.3 * p.normalized());
                   }).clamped;
    }
    CHECK(clamped > 0);
    for (const VertexId v : d.complex().interface_vertices()) {
        CHECK(d.complex().position(v).cwiseAbs().maxCoeff() <= margin + 1e-12);
        CHECK_FALSE(d.complex().on_box(v));
    }
    CHECK(mesh::validate(d.complex()).faults == std::vector<std::string>{});
}

TEST_CASE("a vertex that is sent twice goes to its last destination, with any number of threads") {
    const auto run = [](Workers* workers, bool twice) {
        Deformer d(ball(), {}, workers);
        std::vector<VertexId> vertices = by_birth(d.complex());
        // Blocks of vertices are sent together, so the doubles lie far apart and close together.
        std::vector<Vec3> displacements(vertices.size(), Vec3(0.01, 0.0, 0.0));
        const std::size_t count = vertices.size();
        for (std::size_t i = 0; twice && i < count; i += 7) {
            vertices.insert(vertices.begin(), vertices[count - 1 - i / 7]);
            displacements.insert(displacements.begin(), Vec3(0.0, 0.02, -0.01));
        }
        RepairPolicy moves_only;
        moves_only.topology.thickness = 0.0;
        const StepReport report = d.step(vertices, displacements, moves_only);
        CHECK(report.requested == vertices.size());
        return d.complex().to_mesh().points;
    };
    Workers workers(3);
    const std::vector<Vec3> once = run(nullptr, false);
    CHECK(run(nullptr, true) == once);
    CHECK(run(&workers, true) == once);
}

TEST_CASE("a shrinking sphere vanishes as one counted event") {
    Deformer d(ball(12, 0.7));
    kernel::EventCounts counts;
    for (int i = 0; i < 60 && !d.complex().interface_vertices().empty(); ++i) {
        const StepReport report = drive(d, test::quality_policy(),
                                        [](const Vec3& p) { return Vec3(-0.05 * p.normalized()); });
        counts.vanished += report.event_counts.vanished;
        REQUIRE(mesh::validate(d.complex()).faults == std::vector<std::string>{});
    }
    CHECK(d.complex().interface_vertices().empty());
    CHECK(counts.vanished == 1);
    CHECK(mesh::labelled_volume(d.complex()) == 0.0);
}

TEST_CASE(
    "events off: two spheres driven together stall without an event and without an inversion") {
    Deformer d(mesh::adopt(test::two_balls_grid(14), "two balls"));
    RepairPolicy policy = test::quality_policy();
    policy.topology.thickness = 0.0;
    double dropped = 0.0;
    std::size_t events = 0;
    for (int i = 0; i < 100; ++i) {
        const std::vector<char> left = left_shell(d.complex());
        const std::vector<VertexId> vertices = by_birth(d.complex());
        std::vector<Vec3> displacements;
        for (const VertexId v : vertices)
            displacements.push_back(Vec3(left[v] != 0 ? 0.03 : -0.03, 0, 0));
        const StepReport report = d.step(vertices, displacements, policy);
        events += report.events.size();
        CHECK(report.rounds <= 50);
        dropped = report.dropped_motion;
    }
    CHECK(events == 0);
    CHECK(dropped > 0.0);
    const mesh::ComplexReport report = mesh::validate(d.complex());
    CHECK(report.faults == std::vector<std::string>{});
    CHECK(report.inverted_tets == 0);
    CHECK(mesh::count_interface(d.complex()).shells == 2);
}

TEST_CASE("two spheres driven together merge, and the books balance at every step") {
    Deformer d(mesh::adopt(test::two_balls_grid(14), "two balls"));
    const RepairPolicy policy = test::quality_policy();
    mesh::InterfaceCounts before = mesh::count_interface(d.complex());
    REQUIRE(before.shells == 2);
    std::size_t merges = 0;
    for (int i = 0; i < 30; ++i) {
        const StepReport report =
            drive(d, policy, [](const Vec3& p) { return Vec3(p.x() < 0 ? 0.02 : -0.02, 0, 0); });
        const mesh::InterfaceCounts now = mesh::count_interface(d.complex());
        const auto& e = report.event_counts;
        REQUIRE(static_cast<long>(now.shells) - static_cast<long>(before.shells) ==
                static_cast<long>(e.split + e.born) - static_cast<long>(e.merge + e.vanished));
        REQUIRE(now.genus() - before.genus() ==
                static_cast<long>(e.handle_opened) - static_cast<long>(e.handle_closed));
        merges += e.merge;
        before = now;
    }
    CHECK(merges >= 1);
    CHECK(mesh::validate(d.complex()).faults == std::vector<std::string>{});
}

TEST_CASE("adversarial destinations end within the budgets and leave a valid complex") {
    for (const int kind : {0, 1, 2, 3}) {
        CAPTURE(kind);
        Deformer d(ball(10, 0.8));
        for (int step = 0; step < 10; ++step) {
            RandomStream random(RandomKey{99, 0, static_cast<std::uint64_t>(step), 0});
            const double length = d.target_length();
            const StepReport report = drive(d, test::quality_policy(), [&](const Vec3& p) {
                switch (kind) {
                    case 0:
                        return Vec3(2 * length *
                                    Vec3(random.uniform(-1, 1), random.uniform(-1, 1),
                                         random.uniform(-1, 1)));
                    case 1: return Vec3(-2.0 * p);                 // swapped through the centre
                    case 2: return Vec3(Vec3(0.1, 0.2, 0.3) - p);  // all to one point
                    default: return Vec3(10.0 * p);                // through the wall of the box
                }
            });
            CHECK(report.rounds <= 50);
            REQUIRE(mesh::validate(d.complex()).faults == std::vector<std::string>{});
        }
    }
}

TEST_CASE("refine splits the longest edges of faces and sets L anew") {
    Deformer d(ball());
    const double length = d.target_length();
    const std::size_t before = d.complex().interface_vertices().size();
    std::vector<std::array<VertexId, 3>> faces;
    const mesh::Complex& c = d.complex();
    for (mesh::TetId t = 0; t < c.tet_slots(); ++t) {
        for (unsigned f = 0; f < 4; ++f) {
            if (c.label(t) != 1 || !c.interface_face(t, f)) continue;
            const auto& k = mesh::face_vertices[f];
            faces.push_back({c.tet(t).v[k[0]], c.tet(t).v[k[1]], c.tet(t).v[k[2]]});
        }
    }
    const double volume = mesh::labelled_volume(c);
    const RefineReport report = d.refine(faces, {});
    CHECK(report.requested == faces.size());
    CHECK(report.committed > 0);
    CHECK(c.interface_vertices().size() == before + report.committed);
    CHECK(d.target_length() < length);
    CHECK(mesh::labelled_volume(c) == doctest::Approx(volume).epsilon(1e-12));
    CHECK(mesh::validate(c).faults == std::vector<std::string>{});
    const double same = d.target_length();
    CHECK(d.refine({}, {}).committed == 0);
    CHECK(d.target_length() == same);
}

TEST_CASE("relabelling at a plugin's request: birth of a component, unpinched where it touches") {
    Deformer d(ball(12, 0.6));
    const mesh::Complex& c = d.complex();
    std::vector<mesh::TetId> tets;
    for (mesh::TetId t = 0; t < c.tet_slots(); ++t) {
        const auto& v = c.tet(t).v;
        const Vec3 centre =
            0.25 * (c.position(v[0]) + c.position(v[1]) + c.position(v[2]) + c.position(v[3]));
        if ((centre - Vec3(0.95, 0.95, 0.95)).norm() < 0.3) tets.push_back(t);
    }
    REQUIRE_FALSE(tets.empty());
    const std::vector<mesh::Label> labels(tets.size(), 1);
    std::vector<Event> events;
    const auto before = mesh::count_interface(c);
    CHECK(d.relabel(tets, labels, test::quality_policy(), events) > 0);
    const auto after = mesh::count_interface(c);
    CHECK(after.shells == before.shells + 1);
    CHECK(std::count_if(events.begin(), events.end(),
                        [](const Event& e) { return e.kind == Event::Kind::born; }) == 1);
    CHECK(mesh::validate(c).faults == std::vector<std::string>{});
}
