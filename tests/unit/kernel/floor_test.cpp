// The least quality of tets: what a step never goes below, and what it gives up for a tet that
// comes close.
#include <algorithm>
#include <cmath>

#include <doctest/doctest.h>

#include <dsc/base/random.hpp>
#include <dsc/kernel/deformer.hpp>
#include <dsc/mesh/validate.hpp>

#include "policy.hpp"
#include "shapes.hpp"

using namespace dsc;
using namespace dsc::kernel;
using mesh::TetId;
using mesh::VertexId;

namespace {

// Four cells in a row: every vertex of it is on the interface, most of them on a crease.
mesh::Complex bar() {
    return test::by_cells(
        [](int i, int j, int k) { return test::between(2, i, 5) && j == 2 && k == 2 ? 1 : 0; });
}

float least_quality(const mesh::Complex& c) {
    float least = 1.0F;
    for (TetId t = 0; t < c.tet_slots(); ++t) {
        if (c.tet_alive(t)) least = std::min(least, c.quality(t));
    }
    return least;
}

RepairPolicy without_repair(double floor) {
    RepairPolicy policy;
    policy.topology.thickness = 0.0;
    policy.quality_floor = floor;
    return policy;
}

// An edge whose one end is moved onto the other: the tets round it become flat.
struct Fold {
    VertexId moved, to;
};

// The edges of tets that have four interface vertices.
std::vector<Fold> folds(const mesh::Complex& c) {
    std::vector<Fold> out;
    for (TetId t = 0; t < c.tet_slots(); ++t) {
        if (!c.tet_alive(t) || c.label(t) == 0) continue;
        const auto& v = c.tet(t).v;
        if (!std::all_of(v.begin(), v.end(), [&](VertexId x) { return c.on_interface(x); }))
            continue;
        for (const auto& e : mesh::edge_vertices) out.push_back({v[e[0]], v[e[1]]});
    }
    return out;
}

// Moves the one vertex to the other as far as `floor` allows.
void close_fold(Deformer& d, const Fold& fold, double floor) {
    const std::array<VertexId, 1> vertices = {fold.moved};
    for (int step = 0; step < 4; ++step) {
        const std::array<Vec3, 1> way = {
            Vec3(d.complex().position(fold.to) - d.complex().position(fold.moved))};
        d.step(vertices, way, without_repair(floor));
    }
}

// Tets below `bound`, all of them with four interface vertices; 0 if any of them has fewer.
std::size_t slivers_below(const mesh::Complex& c, float bound) {
    std::size_t count = 0;
    for (TetId t = 0; t < c.tet_slots(); ++t) {
        if (!c.tet_alive(t) || c.quality(t) >= bound) continue;
        const auto& v = c.tet(t).v;
        if (!std::all_of(v.begin(), v.end(), [&](VertexId x) { return c.on_interface(x); }))
            return 0;
        ++count;
    }
    return count;
}

// Asks for slivers to take the label around them, or for one of their edges to go, at any price.
RepairPolicy against_slivers(double floor) {
    RepairPolicy policy = without_repair(floor);
    policy.creases = repair::CreaseRule{};
    policy.propose = [](const repair::RepairRound& round, std::vector<repair::Request>& out) {
        for (const TetId t : round.dirty) {
            for (const auto operation :
                 {repair::Operation::relabel, repair::Operation::edge_collapse}) {
                repair::Request request;
                request.operation = operation;
                request.mode = repair::CollapseMode::bounded;
                request.tet = t;
                request.birth_date = round.complex.birth_date(t);
                request.only_below = request.accept_above = 0.03F;
                out.push_back(request);
            }
        }
    };
    return policy;
}

// Random displacements of all vertices of the interface.
StepReport shake(Deformer& d, RandomStream& random, double most, const RepairPolicy& policy) {
    std::vector<VertexId> vertices(d.complex().interface_vertices().begin(),
                                   d.complex().interface_vertices().end());
    std::sort(vertices.begin(), vertices.end(),
              [&d](VertexId a, VertexId b) { return d.complex().birth(a) < d.complex().birth(b); });
    std::vector<Vec3> displacements;
    for (std::size_t i = 0; i < vertices.size(); ++i) {
        displacements.push_back(
            most * Vec3(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)));
    }
    return d.step(vertices, displacements, policy);
}

}  // namespace

TEST_CASE("a flat tet between four interface vertices goes, crease or not, once it is close to the "
          "floor") {
    const mesh::Complex start = bar();
    std::size_t closed = 0, gone = 0, kept = 0;
    std::uint64_t exceptions = 0;
    for (const Fold& fold : folds(start)) {
        Deformer near(start), far(start);  // the floor of the one is half that of the other: its
                                           // tets are far from it
        close_fold(near, fold, 0.022);
        close_fold(far, fold, 0.022);
        if (slivers_below(near.complex(), 0.03F) == 0) continue;
        ++closed;
        for (int step = 0; step < 6; ++step) {
            exceptions += near.step({}, {}, against_slivers(refinement_floor)).crease_exceptions;
            CHECK(far.step({}, {}, against_slivers(0.5 * refinement_floor)).crease_exceptions == 0);
        }
        CHECK(mesh::validate(near.complex()).faults == std::vector<std::string>{});
        CHECK(least_quality(near.complex()) >= 0.02F);
        gone += slivers_below(near.complex(), 0.03F) == 0 ? 1 : 0;
        kept += slivers_below(far.complex(), 0.03F) > 0 ? 1 : 0;
    }
    CHECK(closed > 20);
    CHECK(gone == closed);
    CHECK(kept > 10);
    CHECK(exceptions >= kept);
}

TEST_CASE("steps with a floor leave no tet below it, whatever the interface must do; the "
          "usual floor lets it happen") {
    float lowest_without = 1.0F;
    for (const test::LabelledMesh& shape : test::labelled_meshes()) {
        CAPTURE(shape.name);
        for (const bool with_floor : {true, false}) {
            Deformer d(shape.complex);
            REQUIRE(least_quality(d.complex()) >= refinement_floor);
            RandomStream random(RandomKey{7, 1, 2, 3});
            RepairPolicy policy = test::quality_policy();
            policy.topology.thickness = 0.0;
            if (with_floor) policy.quality_floor = refinement_floor;
            float least = 1.0F;
            double way = 0.0;
            for (int step = 0; step < 8; ++step) {
                const StepReport report = shake(d, random, 0.5 * d.target_length(), policy);
                least = std::min(least, least_quality(d.complex()));
                way += static_cast<double>(report.arrived);
            }
            CHECK(mesh::validate(d.complex()).faults == std::vector<std::string>{});
            if (with_floor) {
                CHECK(least >= 0.02F);
                CHECK(way > 0.0);
            } else {
                lowest_without = std::min(lowest_without, least);
            }
        }
    }
    CHECK(lowest_without < 0.02F);
}
