// The rule for creases, on a cube: flat sides, sharp edges, eight corners. As long as it holds, the
// volume is the cube's.
#include <cmath>

#include <doctest/doctest.h>

#include <dsc/kernel/deformer.hpp>
#include <dsc/mesh/validate.hpp>
#include <dsc/surface/surface_view.hpp>

#include "policy.hpp"
#include "shapes.hpp"

using namespace dsc;
using namespace dsc::kernel;

namespace {

mesh::Complex cube() {
    return test::by_cells([](int i, int j, int k) {
        return test::between(2, i, 5) && test::between(2, j, 5) && test::between(2, k, 5) ? 1 : 0;
    });
}

surface::SurfaceView view_of(const Deformer& d) {
    surface::SurfaceView view;
    surface::build_view(d.complex(), view);
    return view;
}

const repair::CreaseRule rule{};

// Summed length of the edges with more than 0.6 between their faces' normals.
double crease_length(const Deformer& d) {
    const surface::SurfaceView view = view_of(d);
    std::vector<surface::ViewEdge> edges;
    surface::build_edges(view, edges);
    double sum = 0.0;
    for (const auto& e : edges) {
        if (view.face_normals[e.faces[0]].dot(view.face_normals[e.faces[1]]) > std::cos(0.6))
            continue;
        sum += (view.positions[e.vertices[0]] - view.positions[e.vertices[1]]).norm();
    }
    return sum;
}

// Every edge is to be collapsed into its middle or its end, and every edge to be flipped.
std::size_t ask_for_everything(Deformer& d, const std::optional<repair::CreaseRule>& creases,
                               bool to_middle) {
    const surface::SurfaceView view = view_of(d);
    std::vector<surface::ViewEdge> edges;
    surface::build_edges(view, edges);
    RefineRequests requests;
    requests.owns_sizing = true;
    requests.creases = creases;
    for (const auto& e : edges) {
        const auto [a, b] = e.vertices;
        const Vec3 place =
            to_middle ? Vec3(0.5 * (view.positions[a] + view.positions[b])) : view.positions[a];
        requests.collapses.push_back({view.vertex_ids[a], view.vertex_ids[b], place});
        requests.flips.push_back({view.vertex_ids[a], view.vertex_ids[b], -1.0});
    }
    return d.refine(requests).committed;
}

RepairPolicy asking_for(repair::Operation operation) {
    RepairPolicy policy;
    policy.topology.thickness = 0.0;
    policy.propose = [operation](const repair::RepairRound& round,
                                 std::vector<repair::Request>& out) {
        const mesh::Complex& c = round.complex;
        if (round.round > 0) return;
        for (mesh::TetId t = 0; t < c.tet_slots(); ++t) {
            if (!c.tet_alive(t)) continue;
            repair::Request request;
            request.operation = operation;
            request.tet = t;
            request.birth_date = c.birth_date(t);
            request.mode = repair::CollapseMode::bounded;
            request.accept_above = 0.0F;
            out.push_back(request);
        }
    };
    return policy;
}

}  // namespace

TEST_CASE("with the rule a refinement's collapses and flips leave a cube its edges and corners, "
          "without it they do not") {
    for (const bool to_middle : {true, false}) {
        CAPTURE(to_middle);
        Deformer kept(cube()), lost(cube());
        const double volume = mesh::labelled_volume(kept.complex()), creases = crease_length(kept);
        const std::size_t vertices = view_of(kept).vertex_count();
        CHECK(creases == doctest::Approx(12 * std::cbrt(volume)));
        std::size_t committed = 0;
        for (int sweep = 0; sweep < 3; ++sweep) {
            committed += ask_for_everything(kept, rule, to_middle);
            ask_for_everything(lost, std::nullopt, to_middle);
        }
        CHECK(committed > 10);
        CHECK(view_of(kept).vertex_count() < vertices);
        CHECK(mesh::labelled_volume(kept.complex()) == doctest::Approx(volume).epsilon(1e-12));
        CHECK(crease_length(kept) == doctest::Approx(creases).epsilon(1e-12));
        if (to_middle)
            CHECK(std::abs(mesh::labelled_volume(lost.complex()) - volume) > 1e-3 * volume);
        CHECK(mesh::validate(kept.complex()).faults == std::vector<std::string>{});
    }
}

TEST_CASE(
    "with the rule no collapse, flip, relabelling or compound of the improvement costs a crease") {
    using repair::Operation;
    for (const Operation operation : {Operation::edge_collapse, Operation::interface_flip,
                                      Operation::relabel, Operation::compound}) {
        CAPTURE(repair::name(operation));
        std::array<double, 2> change{};
        for (const bool keep : {false, true}) {
            Deformer d(cube());
            const double volume = mesh::labelled_volume(d.complex()), creases = crease_length(d);
            RepairPolicy policy = asking_for(operation);
            if (keep) policy.creases = rule;
            const StepReport report = d.step({}, {}, policy);
            CHECK(report.crease_exceptions == 0);
            if (keep) CHECK(crease_length(d) > creases * (1.0 - 1e-12));
            change[keep ? 1 : 0] = std::abs(mesh::labelled_volume(d.complex()) - volume) +
                                   std::abs(crease_length(d) - creases);
            CHECK(mesh::validate(d.complex()).faults == std::vector<std::string>{});
        }
        // A compound may raise a blister on a flat side, with faces that turn less than the rule
        // allows.
        if (operation != Operation::compound) CHECK(change[1] < 1e-12);
        if (operation == Operation::relabel || operation == Operation::edge_collapse)
            CHECK(change[0] > 1e-3);
    }
}

TEST_CASE("for a tet below the quality floor the rule is set aside, and that is counted") {
    DeformerOptions options;
    options.quality_floor = 0.99;  // which every tet of the grid is below
    Deformer d(cube(), options);
    const double volume = mesh::labelled_volume(d.complex());
    RepairPolicy policy = asking_for(repair::Operation::relabel);
    policy.creases = rule;
    const StepReport report = d.step({}, {}, policy);
    CHECK(report.crease_exceptions > 0);
    CHECK(mesh::labelled_volume(d.complex()) != doctest::Approx(volume));
}
