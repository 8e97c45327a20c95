// prepare.*: prepare() only prepares. It may run any number of times and for any surface; state is
// changed in advance(), which runs exactly once per step.
#include <sstream>

#include "asked_data.hpp"
#include "test_table.hpp"

namespace dsc::conformance {
namespace {

constexpr std::uint64_t steps_of_run = 3;

std::string state_of(const hooks::Strategy& strategy) {
    std::ostringstream out(std::ios::binary);
    strategy.save(out);
    return out.str();
}

// Skips if a second prepare() changes the answers, which state.prepare tests.
void require_preparing_only(const Subject& subject) {
    subject.require_repeatable();
    const Trace once = subject.answers({.steps = 3}).trace;
    if (Trace::difference(once, subject.answers({.steps = 3, .prepares = 3}).trace))
        throw Skipped("a second call of prepare() changes its answers; see state.prepare");
}

void require_unchanged(const hooks::Strategy& strategy, const std::string& before) {
    require(state_of(strategy) == before,
            "prepare() changes what save() writes; only advance() may change the state");
}

// prepare() with the same context changes nothing that save() writes.
void keep_state(const Subject& subject) {
    require_preparing_only(subject);
    const auto strategy = subject.make();
    for (std::uint64_t step = 1; step <= steps_of_run; ++step) {
        exercise(subject.kind(), *strategy, subject.fixture(), {.first_step = step, .steps = 1});
        const std::string before = state_of(*strategy);
        const Fixture now = at_step(subject.fixture(), step);
        const hooks::StepContext context = context_of(now, step, {}, nullptr);
        AskedData asked;
        if (subject.kind() == plugin::Kind::velocity) {
            auto& field = static_cast<hooks::VelocityField&>(*strategy);
            const hooks::StepContext full = asked.complete(field, context);
            field.prepare(full);
            require_unchanged(*strategy, before);
        } else {
            static_cast<hooks::CurvatureEstimator&>(*strategy).prepare(context);
            require_unchanged(*strategy, before);
        }
    }
}

// What a refinement reads between two steps: the values on another surface. `step` is the last
// completed step.
Trace visit(plugin::Kind kind, hooks::Strategy& strategy, const Fixture& fixture,
            std::uint64_t step) {
    const hooks::StepContext given = context_of(fixture, step, {}, nullptr);
    const surface::SurfaceView& view = fixture.view;
    Trace values;
    values.part("values for a refinement after step " + std::to_string(step), 3);
    std::vector<Vec3> out(view.face_count());
    if (kind == plugin::Kind::velocity) {
        auto& field = static_cast<hooks::VelocityField&>(strategy);
        AskedData asked;
        const hooks::StepContext context = asked.complete(field, given);
        field.prepare(context);
        std::vector<Vec3> points;
        for (const auto& [a, b, c] : view.faces)
            points.push_back((view.positions[a] + view.positions[b] + view.positions[c]) / 3.0);
        field.sample(points, view.face_normals, out);
    } else {
        auto& estimator = static_cast<hooks::CurvatureEstimator&>(strategy);
        estimator.prepare(given);
        out.resize(view.vertex_count());
        std::vector<double> scalars(out.size());
        estimator.evaluate({0, out.size()}, scalars, out);
    }
    values.add(std::span<const Vec3>(out));
    return values;
}

void require_equal(const Trace& a, const Trace& b, const std::string& otherwise) {
    if (const auto difference = Trace::difference(a, b))
        throw Failed(otherwise + ": " + *difference);
}

// A refinement that samples before the first step and after each step, on a surface of another
// size, has no influence on the steps. What it reads depends only on the state and its surface.
void between_steps(const Subject& subject) {
    require_preparing_only(subject);
    const plugin::Kind kind = subject.kind();
    const auto alone = subject.make();
    const auto visited = subject.make();
    if (kind == plugin::Kind::velocity &&
        !static_cast<const hooks::VelocityField&>(*alone).can_sample())
        throw Skipped("it cannot be sampled, so no refinement prepares it");
    const Fixture other = triangles(2);
    visit(kind, *visited, other, 0);
    for (std::uint64_t step = 1; step <= steps_of_run; ++step) {
        const Exercise how{.first_step = step, .steps = 1};
        require_equal(exercise(kind, *alone, subject.fixture(), how).trace,
                      exercise(kind, *visited, subject.fixture(), how).trace,
                      "a refinement that calls prepare() between two steps changes the answers of "
                      "the next step; only advance() may change the state");
        const auto resumed = subject.make();
        std::istringstream in(state_of(*visited), std::ios::binary);
        resumed->load(in);
        require_equal(visit(kind, *visited, other, step), visit(kind, *resumed, other, step),
                      "after a step and in a resumed run it gives a refinement different values; "
                      "prepare() must compute all that they depend on, except the state");
    }
}

}  // namespace

void add_prepare_tests(std::vector<Test>& table) {
    add(table,
        {"prepare.state", Level::standard, false,
         "prepare() changes nothing that a checkpoint contains; advance() does."},
        keep_state, per_vertex);
    add(table,
        {"prepare.surface", Level::standard, false,
         "A refinement may call prepare() for another surface before the first step and between "
         "steps, without influence on the steps."},
        between_steps, per_vertex);
}

}  // namespace dsc::conformance
