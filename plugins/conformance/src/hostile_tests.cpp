// *.hostile, err.*: tests with bad input.
#include <fmt/core.h>

#include "test_table.hpp"

namespace dsc::conformance {
namespace {

// The strategy must return finite answers or throw. A crash or an endless loop ends the process and
// the test.
void survive(const Subject& subject, const std::vector<Fixture>& fixtures) {
    for (const Fixture& fixture : fixtures) {
        const auto strategy = subject.make();
        Answers answers;
        try {
            answers = exercise(subject.kind(), *strategy, fixture);
        } catch (const std::exception&) {
            continue;
        } catch (...) {
            throw Failed("on " + fixture.name +
                         " it throws something that is not a std::exception");
        }
        if (const auto bad = answers.trace.first_not_finite())
            throw Failed(fmt::format("on {} it returns {:f} as {}", fixture.name,
                                     answers.trace.values()[*bad], answers.trace.place(*bad)));
    }
}

void surfaces(const Subject& subject) { survive(subject, hostile_surfaces()); }

void clouds(const Subject& subject) { survive(subject, hostile_clouds()); }

// After an exception a strategy works like a new one.
void throws(const Subject& subject) {
    subject.require_repeatable();
    const Trace fresh = subject.answers().trace;
    const auto strategy = subject.make();
    std::vector<Fixture> fixtures = hostile_surfaces();
    for (Fixture& fixture : hostile_clouds()) fixtures.push_back(std::move(fixture));
    bool thrown = false;
    for (const Fixture& fixture : fixtures) {
        try {
            exercise(subject.kind(), *strategy, fixture, {.steps = 1});
        } catch (const std::exception&) {
            thrown = true;
            break;
        }
    }
    if (!thrown) throw Skipped("no input makes it throw");
    Trace after;
    try {
        after = exercise(subject.kind(), *strategy, subject.fixture(), {}).trace;
    } catch (const std::exception& error) {
        throw Failed(std::string("after an exception it can no longer be used: ") + error.what());
    }
    if (const auto difference = Trace::difference(fresh, after))
        throw Failed("after an exception it gives different answers: " + *difference);
}

}  // namespace

void add_hostile_tests(std::vector<Test>& table) {
    add(table,
        {"mesh.hostile", Level::standard, false,
         "Empty, flat, tiny and open surfaces give finite answers or an exception."},
        surfaces,
        {plugin::Kind::velocity, plugin::Kind::curvature, plugin::Kind::refinement,
         plugin::Kind::observer});
    add(table,
        {"cloud.hostile", Level::standard, false,
         "No cloud, one point, and points on a line or in one place give finite answers or an "
         "exception."},
        clouds,
        {plugin::Kind::velocity, plugin::Kind::curvature, plugin::Kind::refinement,
         plugin::Kind::observer, plugin::Kind::initial_mesh, plugin::Kind::filter});
    add(table, {"err.throw", Level::standard, false, "After an exception it works like a new one."},
        throws);
}

}  // namespace dsc::conformance
