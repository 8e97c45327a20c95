// Destinations that no motion can reach: every run ends within its budgets, with a valid complex,
// and says that it stalled where it did.
#include <functional>

#include <doctest/doctest.h>

#include <dsc/host/host.hpp>
#include <dsc/run/measure.hpp>
#include <dsc/run/simulation.hpp>

#include "results.hpp"

namespace {

using namespace dsc;

/// Sends every vertex to a place of its own choice.
class Adversary final : public hooks::VelocityField {
public:
    using Destination = std::function<Vec3(const hooks::StepContext&, std::size_t vertex)>;
    explicit Adversary(Destination destination) : destination_(std::move(destination)) {}
    void prepare(const hooks::StepContext& context) override { context_.emplace(context); }
    void evaluate(hooks::Range range, std::span<Vec3> out) const override {
        for (std::size_t i = 0; i < out.size(); ++i) {
            const std::size_t v = range.begin + i;
            out[i] = destination_(*context_, v) - context_->surface.positions[v];
        }
    }

private:
    Destination destination_;
    std::optional<hooks::StepContext> context_;
};

constexpr unsigned most_rounds = 50;  // a step, as the kernel has it

struct Outcome {
    run::SimulationResult result;
    run::VolumeMeasure measure;
};

Outcome drive_to(const Adversary::Destination& destination, std::uint32_t steps,
                 bool events = true) {
    host::Host host;
    test::load_strategies(host);
    run::Experiment experiment;
    experiment.name = "adversary";
    experiment.initial_mesh = {
        "grid", config::ConfigNode::map(
                    {{"cells", 12}, {"shape", "sphere"}, {"radius", 0.8}, {"project", true}})};
    experiment.improvement = {
        "dsc", config::ConfigNode::map(
                   {{"topology", config::ConfigNode::map({{"thickness", events ? 1.0 : 0.0}})}})};
    experiment.velocity = {"rotate", config::ConfigNode::map()};
    experiment.schedule.push_back({steps, {}, {}, {}});
    run::Strategies strategies = run::make_strategies(experiment, host);
    strategies.velocity = std::make_unique<Adversary>(destination);
    Outcome outcome{run::simulate(experiment, strategies, nullptr, {}), {}};
    outcome.measure = run::measure(outcome.result.mesh);
    MESSAGE(std::string(run::name(outcome.result.totals.status))
            << " after " << outcome.result.totals.steps << " steps, "
            << outcome.result.totals.rounds << " rounds, dropped "
            << outcome.result.totals.dropped_motion << ", clamped "
            << outcome.result.totals.clamped);
    const run::RunTotals& totals = outcome.result.totals;
    CHECK(totals.rounds <= most_rounds * totals.steps);
    CHECK(outcome.measure.inverted_tets == 0);
    CHECK(outcome.measure.adjacency_valid());
    CHECK(outcome.measure.fills_box());
    if (!outcome.measure.interface.faces.empty()) CHECK(outcome.measure.interface_measure.solid());
    return outcome;
}

}  // namespace

TEST_CASE("random places in the box, new ones in every step") {
    const Outcome outcome = drive_to(
        [](const hooks::StepContext& context, std::size_t v) {
            RandomStream random = context.random(context.surface.births[v]);
            return Vec3(random.uniform(-1.5, 1.5), random.uniform(-1.5, 1.5),
                        random.uniform(-1.5, 1.5));
        },
        5);
    CHECK(outcome.result.totals.dropped_motion > 0);
}

TEST_CASE("random places near by, new ones in every step") {
    const Outcome outcome = drive_to(
        [](const hooks::StepContext& context, std::size_t v) {
            RandomStream random = context.random(context.surface.births[v]);
            const double reach = 2 * context.target_length;
            return Vec3(context.surface.positions[v] + Vec3(random.uniform(-reach, reach),
                                                            random.uniform(-reach, reach),
                                                            random.uniform(-reach, reach)));
        },
        5);
    CHECK(outcome.result.totals.dropped_motion > 0);
}

TEST_CASE("every vertex to the place of the one opposite: through the middle, where the sphere "
          "vanishes") {
    const Outcome outcome =
        drive_to([](const hooks::StepContext& context,
                    std::size_t v) { return Vec3(-context.surface.positions[v]); },
                 10);
    CHECK(outcome.measure.interface.faces.empty());
    CHECK(outcome.result.totals.events.vanished == 1);
}

TEST_CASE("neighbours change places") {
    const Outcome outcome = drive_to(
        [](const hooks::StepContext& context, std::size_t v) {
            // The neighbour before the vertex in its first face: some pairs want each other's
            // places.
            const auto& face = context.surface.faces[context.surface.faces_of(v)[0]];
            const std::size_t k = face[0] == v ? 0 : face[1] == v ? 1 : 2;
            return context.surface.positions[face[(k + 2) % 3]];
        },
        20, false);
    CHECK(outcome.result.totals.events.vanished == 0);
}

TEST_CASE("all to one point outside the sphere") {
    drive_to([](const hooks::StepContext&, std::size_t) { return Vec3(1.0, 0.2, -0.1); }, 20,
             false);
}

TEST_CASE("all to the middle of the sphere: it vanishes") {
    const Outcome outcome =
        drive_to([](const hooks::StepContext&, std::size_t) { return Vec3(Vec3::Zero()); }, 10);
    CHECK(outcome.measure.interface.faces.empty());
    CHECK(outcome.result.totals.events.vanished == 1);
}

TEST_CASE("through the box' walls: clamped to a smaller box, stalled there") {
    const Outcome outcome = drive_to(
        [](const hooks::StepContext& context, std::size_t v) {
            // Straight to the nearest wall and beyond: once there, nobody has anywhere to go.
            const Vec3& p = context.surface.positions[v];
            Eigen::Index axis = 0;
            p.cwiseAbs().maxCoeff(&axis);
            return Vec3(p + 3 * (p[axis] < 0 ? -1 : 1) * Vec3::Unit(axis));
        },
        40);
    CHECK(outcome.result.totals.clamped > 0);
    CHECK(outcome.result.totals.status == run::Status::stalled);
    CHECK(outcome.result.totals.steps < 40);
    const double margin = 1.5 - 2 * outcome.result.totals.target_length;
    for (const Vec3& p : outcome.result.surface.points)
        CHECK(p.cwiseAbs().maxCoeff() <= margin + 1e-9);
}

TEST_CASE("through one wall: pressed flat against it") {
    const Outcome outcome =
        drive_to([](const hooks::StepContext& context,
                    std::size_t v) { return Vec3(context.surface.positions[v] + Vec3(3.0, 0, 0)); },
                 10);
    CHECK(outcome.result.totals.clamped > 0);
    const double margin = 1.5 - 2 * outcome.result.totals.target_length;
    for (const Vec3& p : outcome.result.surface.points) CHECK(p.x() <= margin + 1e-9);
}
