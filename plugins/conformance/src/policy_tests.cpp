// mesh.topology, policy.*, cloud.attributes: tests of initial meshes, requests and filtered clouds.
#include <algorithm>
#include <cstring>
#include <map>

#include <fmt/core.h>

#include <dsc/kernel/deformer.hpp>
#include <dsc/mesh/adopt.hpp>
#include <dsc/mesh/validate.hpp>
#include <dsc/run/mesh_files.hpp>

#include "test_table.hpp"

namespace dsc::conformance {
namespace {

constexpr unsigned rounds_of_refinement = 4;
constexpr unsigned steps_of_improvement = 4;

// The kernel accepts the mesh, and a full scan finds no fault in it.
void topology(const Subject& subject) {
    const auto strategy = subject.make();
    const run::MeshFiles files;
    hooks::InitialMeshContext context;
    context.cloud = &*subject.fixture().cloud;
    context.seed = subject.seed();
    context.files = &files;
    const mesh::TetMesh mesh = static_cast<hooks::InitialMesh&>(*strategy).build(context);
    const mesh::Complex complex = mesh::adopt(mesh, "the mesh", nullptr);
    const mesh::ComplexReport report = mesh::validate(complex);
    require(report.valid(), report.faults.empty() ? "" : report.faults.front());
    require(
        report.irregular_vertices == 0,
        fmt::format("the interface is not a 2-manifold at {} vertices", report.irregular_vertices));
    require(
        std::any_of(mesh.labels.begin(), mesh.labels.end(), [](mesh::Label l) { return l > 0; }),
        "no tet has a label above 0, so there is nothing to deform");
    require(
        std::any_of(mesh.labels.begin(), mesh.labels.end(), [](mesh::Label l) { return l == 0; }),
        "no tet has the label 0, so the body fills the box");
}

// A velocity along x, for refinements to read.
class Drift final : public hooks::VelocityField {
public:
    void prepare(const hooks::StepContext&) override {}
    void evaluate(hooks::Range, std::span<Vec3> out) const override {
        std::fill(out.begin(), out.end(), Vec3(0.01, 0, 0));
    }
    bool can_sample() const override { return true; }
    void sample(std::span<const Vec3>, std::span<const Vec3>, std::span<Vec3> out) const override {
        std::fill(out.begin(), out.end(), Vec3(0.01, 0, 0));
    }
};

hooks::RefinementRequests ask(hooks::RefinementPolicy& policy, const Fixture& fixture,
                              std::uint64_t step) {
    Drift velocity;
    const hooks::StepContext context = context_of(fixture, step, {}, nullptr);
    hooks::RefinementRequests requests;
    velocity.prepare(context);
    policy.refine({context, policy.needs_sampling() ? &velocity : nullptr, 0}, requests);
    return requests;
}

// Requests name each simplex once, a second call on the same mesh requests nothing more, and a few
// rounds end.
void refinement(const Subject& subject) {
    const auto strategy = subject.make();
    auto& policy = static_cast<hooks::RefinementPolicy&>(*strategy);
    kernel::Deformer deformer(*subject.fixture().complex);
    Fixture fixture = subject.fixture();
    for (unsigned round = 0; round < rounds_of_refinement; ++round) {
        surface::build_view(deformer.complex(), fixture.view);
        hooks::RefinementRequests requests = ask(policy, fixture, round + 1);
        std::sort(requests.split_faces.begin(), requests.split_faces.end());
        require(std::adjacent_find(requests.split_faces.begin(), requests.split_faces.end()) ==
                    requests.split_faces.end(),
                "it requests the split of one face twice");
        const hooks::RefinementRequests again = ask(policy, fixture, round + 1);
        require(again.split_faces.size() <= requests.split_faces.size() &&
                    again.split_edges.size() <= requests.split_edges.size(),
                fmt::format("a second call on the same mesh requests more: {} faces and {} edges "
                            "after {} and {}",
                            again.split_faces.size(), again.split_edges.size(),
                            requests.split_faces.size(), requests.split_edges.size()));
        std::vector<std::array<mesh::VertexId, 3>> faces;
        for (const std::uint32_t f : requests.split_faces) {
            require(f < fixture.view.face_count(),
                    fmt::format("it requests face {}, which does not exist", f));
            const auto& [a, b, c] = fixture.view.faces[f];
            faces.push_back({fixture.view.vertex_ids[a], fixture.view.vertex_ids[b],
                             fixture.view.vertex_ids[c]});
        }
        deformer.refine(faces, {});
    }
    require(mesh::validate(deformer.complex()).valid(), "its refinement left an invalid mesh");
}

// Displacements that make bad tets: a twist that grows along z.
std::vector<Vec3> twist(const surface::SurfaceView& view) {
    std::vector<Vec3> out;
    for (const Vec3& p : view.positions) out.push_back(0.08 * p.z() * Vec3(-p.y(), p.x(), 0));
    return out;
}

// A few steps with this policy end within their rounds, with a valid mesh.
void improvement(const Subject& subject) {
    const auto strategy = subject.make();
    auto& policy = static_cast<hooks::Improvement&>(*strategy);
    kernel::Deformer deformer(*subject.fixture().complex);
    Fixture fixture = subject.fixture();
    const hooks::StepContext* current = nullptr;
    kernel::RepairPolicy repair;
    repair.propose = [&](const repair::RepairRound& round, std::vector<repair::Request>& out) {
        policy.propose(*current, round, out);
    };
    repair.select = [&](std::span<const repair::TopologyCandidate> candidates,
                        std::span<std::uint8_t> accept) {
        policy.select(*current, candidates, accept);
    };
    repair.topology = policy.topology_limits();
    repair.flatness = policy.flatness();
    for (std::uint64_t step = 1; step <= steps_of_improvement; ++step) {
        surface::build_view(deformer.complex(), fixture.view);
        const hooks::StepContext context = context_of(fixture, step, {}, nullptr);
        current = &context;
        deformer.step(fixture.view.vertex_ids, twist(fixture.view), repair);
        const mesh::ComplexReport report = mesh::validate(deformer.complex());
        require(report.valid(), fmt::format("step {} left an invalid mesh: {}", step,
                                            report.faults.empty() ? "" : report.faults.front()));
    }
}

std::string bits_of(const Vec3& point) {
    std::string bits(3 * sizeof(double), '\0');
    std::memcpy(bits.data(), point.data(), bits.size());
    return bits;
}

void require_size(std::size_t size, std::size_t points, const char* what) {
    require(size == 0 || size == points,
            fmt::format("it returns {} {} for {} points", size, what, points));
}

// The attributes match the points, a point that stays keeps its colour, and the numbers in the
// report add up.
void filter_attributes(const Subject& subject) {
    const auto strategy = subject.make();
    const cloud::Cloud given = cloud_of(subject.fixture());
    const cloud::Filtered result =
        static_cast<hooks::CloudFilter&>(*strategy).apply(given, filter_context({}, nullptr));
    const std::size_t points = result.cloud.points.size();
    require(points > 0, "it leaves no point of an ordinary cloud");
    require_size(result.cloud.normals.size(), points, "normals");
    require_size(result.cloud.areas.size(), points, "areas");
    require_size(result.cloud.confidence.size(), points, "confidences");
    require(result.cloud.colours.size() == points,
            fmt::format("the cloud has a colour for each of its points, but the filter returns {} "
                        "colours for {} points",
                        result.cloud.colours.size(), points));
    std::map<std::string, cloud::Colour> colours;
    for (std::size_t i = 0; i < given.points.size(); ++i)
        colours[bits_of(given.points[i])] = given.colours[i];
    for (std::size_t i = 0; i < points; ++i) {
        const auto found = colours.find(bits_of(result.cloud.points[i]));
        require(found == colours.end() || found->second == result.cloud.colours[i],
                fmt::format("point {} has the colour of another point", i));
    }
    require(result.report.kept == points &&
                result.report.kept + result.report.removed == given.points.size(),
            fmt::format("its report counts {} points kept and {} removed, of {} given and {} left",
                        result.report.kept, result.report.removed, given.points.size(), points));
}

void progress(const Subject& subject) {
    if (subject.kind() == plugin::Kind::refinement) {
        refinement(subject);
    } else {
        improvement(subject);
    }
}

void sizing(const Subject& subject) {
    const Answers answers = subject.answers();
    require(answers.unfit_lengths.empty(), answers.unfit_lengths);
    const auto strategy = subject.make();
    const unsigned passes = static_cast<hooks::RefinementPolicy&>(*strategy).passes();
    require(passes >= 1 && passes <= hooks::refinement_passes,
            fmt::format("it asks for {} passes, but only 1 to {} are possible", passes,
                        hooks::refinement_passes));
}

}  // namespace

void add_policy_tests(std::vector<Test>& table) {
    add(table,
        {"mesh.topology", Level::standard, false,
         "An initial mesh is conforming, fills its box and has a manifold interface."},
        topology, {plugin::Kind::initial_mesh});
    add(table,
        {"policy.progress", Level::standard, false,
         "Requests come to an end: refinements request nothing twice, improvements leave valid "
         "meshes."},
        progress, {plugin::Kind::refinement, plugin::Kind::improvement});
    add(table,
        {"policy.sizing", Level::standard, false,
         "Target lengths are above 0, one for all vertices or one per vertex, and the number of "
         "passes is allowed."},
        sizing, {plugin::Kind::refinement});
    add(table,
        {"cloud.attributes", Level::standard, false,
         "The points that a filter keeps have their attributes, and its report counts them."},
        filter_attributes, {plugin::Kind::filter});
}

}  // namespace dsc::conformance
