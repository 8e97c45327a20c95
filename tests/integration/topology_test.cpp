// From the cube to a torus and to a box with a tunnel: the hole opens by counted events, and the
// books agree with a recount of every step's volume.
#include <cmath>

#include <doctest/doctest.h>

#include <dsc/cloud/normalize.hpp>
#include <dsc/cloud/shapes.hpp>
#include <dsc/cloud/target.hpp>
#include <dsc/hooks/improvement.hpp>
#include <dsc/hooks/velocity_field.hpp>
#include <dsc/host/host.hpp>
#include <dsc/kernel/deformer.hpp>
#include <dsc/mesh/adopt.hpp>
#include <dsc/mesh/validate.hpp>
#include <dsc/surface/surface_view.hpp>

#include "../unit/mesh/meshes.hpp"
#include "poses.hpp"

namespace {

using namespace dsc;

struct Outcome {
    mesh::InterfaceCounts counts;
    kernel::EventCounts events;
    bool books_balance = true;
    bool valid = false;
};

Outcome deform_cube_to(const cloud::Cloud& cloud) {
    host::Host host;
    host.load(DSC_TEST_IMPROVEMENT);
    host.load(DSC_TEST_VELOCITY);
    const auto improvement =
        host.create<hooks::Improvement>({"dsc", config::ConfigNode::map()}, "improvement");
    const auto velocity = host.create<hooks::VelocityField>(
        {"point_cloud",
         config::ConfigNode::map({{"unsupported", config::ConfigNode::map({{"beyond", 2.5}})}})},
        "velocity");
    const cloud::TargetCloud target(cloud::normalize(cloud, 0.9));
    kernel::Deformer deformer(mesh::adopt(test::cube_grid(30), "cube"));
    Outcome outcome;
    outcome.counts = mesh::count_interface(deformer.complex());
    surface::SurfaceView view;
    std::vector<Vec3> displacements;
    for (std::uint64_t step = 0; step < 80; ++step) {
        surface::build_view(deformer.complex(), view);
        if (step == 60) {
            double mean = 0.0;
            for (const double area : view.face_areas)
                mean += area / static_cast<double>(view.face_count());
            std::vector<std::array<mesh::VertexId, 3>> large;
            for (std::size_t f = 0; f < view.face_count(); ++f) {
                const auto& face = view.faces[f];
                if (view.face_areas[f] >= mean)
                    large.push_back({view.vertex_ids[face[0]], view.vertex_ids[face[1]],
                                     view.vertex_ids[face[2]]});
            }
            deformer.refine(large, {});
            surface::build_view(deformer.complex(), view);
        }
        const hooks::StepContext context{.step = step,
                                         .surface = view,
                                         .cloud = &target,
                                         .target_length = deformer.target_length(),
                                         .box = deformer.complex().box(),
                                         .to_normalised = target.transform()};
        displacements.assign(view.vertex_count(), Vec3::Zero());
        velocity->prepare(context);
        velocity->evaluate({0, view.vertex_count()}, displacements);
        kernel::RepairPolicy policy;
        policy.propose = [&](const repair::RepairRound& round, std::vector<repair::Request>& out) {
            improvement->propose(context, round, out);
        };
        policy.select = [&](auto candidates, auto accept) {
            improvement->select(context, candidates, accept);
        };
        policy.topology = improvement->topology_limits();
        policy.flatness = improvement->flatness();
        const kernel::StepReport report = deformer.step(view.vertex_ids, displacements, policy);
        const auto& e = report.event_counts;
        const mesh::InterfaceCounts now = mesh::count_interface(deformer.complex());
        const long shells =
            static_cast<long>(now.shells) - static_cast<long>(outcome.counts.shells);
        const long genus = now.genus() - outcome.counts.genus();
        if (shells != static_cast<long>(e.split + e.born) - static_cast<long>(e.merge + e.vanished))
            outcome.books_balance = false;
        if (genus != static_cast<long>(e.handle_opened) - static_cast<long>(e.handle_closed))
            outcome.books_balance = false;
        outcome.counts = now;
        outcome.events.handle_opened += e.handle_opened;
        outcome.events.handle_closed += e.handle_closed;
    }
    outcome.valid = mesh::validate(deformer.complex()).valid();
    return outcome;
}

void check_poses(const char* shape) {
    const cloud::Cloud sampled = cloud::sample_shape(shape, 5000, 1, 0.0, 0.0);
    for (int pose = 0; pose < 4; ++pose) {
        CAPTURE(pose);
        Eigen::Matrix3d turn =
            test::random_rotation(pose < 3 ? static_cast<std::uint64_t>(pose) + 1 : 1);
        if (pose == 3) turn.row(0) *= -1.0;
        cloud::Cloud posed = sampled;
        for (Vec3& p : posed.points) p = turn * p;
        const Outcome outcome = deform_cube_to(posed);
        CHECK(outcome.valid);
        CHECK(outcome.books_balance);
        CHECK(outcome.counts.shells == 1);
        CHECK(outcome.counts.genus() == 1);
        CHECK(outcome.events.handle_opened - outcome.events.handle_closed == 1);
    }
}

}  // namespace

// Three random rotations and a mirror image each: one shell, genus 1, one handle on the books.
TEST_CASE("a torus from the cube, in four poses") { check_poses("torus"); }
TEST_CASE("a box with a tunnel from the cube, in four poses") { check_poses("box_tunnel"); }
