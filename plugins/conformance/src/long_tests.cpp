// long.*: what shows only after many steps.
#include <malloc.h>

#include <fmt/core.h>

#include <dsc/plugin/fingerprint.hpp>

#include "test_table.hpp"

namespace dsc::conformance {
namespace {

constexpr unsigned many_steps = 50;

/// A surface that is small enough for many steps; improvements need one with tets.
Fixture small_surface(const Subject& subject) {
    if (subject.kind() == plugin::Kind::improvement) return subject.fixture();
    Fixture fixture = triangles(2);
    fixture.name = "a small sphere";
    return fixture;
}

Trace step_of(const Subject& subject, hooks::Strategy& strategy, const Fixture& fixture,
              std::uint64_t step) {
    return exercise(subject.kind(), strategy, fixture,
                    {.first_step = step, .steps = 1, .seed = subject.seed()})
        .trace;
}

// A strategy that fails within two steps is judged by other tests.
void require_two_steps(const Subject& subject, const Fixture& fixture) {
    const Trace first = subject.answers_on(fixture, {.seed = subject.seed()}).trace;
    if (first.first_not_finite() || first.first_unwritten())
        throw Skipped("not all answers are numbers; see out.finite and out.complete");
}

void steps(const Subject& subject) {
    const Fixture fixture = small_surface(subject);
    require_two_steps(subject, fixture);
    const auto strategy = subject.make();
    for (std::uint64_t step = 1; step <= many_steps; ++step) {
        Trace trace;
        try {
            trace = step_of(subject, *strategy, fixture, step);
        } catch (const std::exception& error) {
            throw Failed(fmt::format("at step {} it throws: {}", step, error.what()));
        }
        if (const auto bad = trace.first_not_finite())
            throw Failed(fmt::format("{:f} as {}", trace.values()[*bad], trace.place(*bad)));
        if (const auto bad = trace.first_unwritten())
            throw Failed("it does not write " + trace.place(*bad));
    }
}

std::size_t used_memory() {
    const auto info = ::mallinfo2();
    return info.uordblks + info.hblkhd;
}

// A state of some numbers per step is allowed, such as a list of figures.
void memory(const Subject& subject) {
    if (plugin::core_fingerprint().find("san=none") == std::string_view::npos)
        throw Skipped("memory is not counted under a sanitizer");
    constexpr std::size_t allowed = 1024;  // bytes per step
    const Fixture fixture = small_surface(subject);
    require_two_steps(subject, fixture);
    const auto strategy = subject.make();
    std::uint64_t step = 1;
    const auto run = [&](unsigned count) {
        for (unsigned i = 0; i < count; ++i, ++step) {
            try {
                step_of(subject, *strategy, fixture, step);
            } catch (const std::exception&) {
                throw Skipped("it throws; see long.steps");
            }
        }
    };
    run(many_steps / 2);  // arrays reach their size
    // The allocator's own cache may grow once; a strategy that keeps memory does so every time.
    std::size_t grown = allowed;
    for (int round = 0; round < 3 && grown >= allowed; ++round) {
        const std::size_t before = used_memory();
        run(many_steps / 2);
        const std::size_t after = used_memory();
        grown = after > before ? (after - before) / (many_steps / 2) : 0;
    }
    require(grown < allowed,
            fmt::format("it keeps another {} bytes with each step, on a surface of {} vertices",
                        grown, fixture.view.vertex_count()));
}

const std::vector<plugin::Kind> stepping = {plugin::Kind::velocity, plugin::Kind::curvature,
                                            plugin::Kind::refinement, plugin::Kind::improvement,
                                            plugin::Kind::observer};

}  // namespace

void add_long_tests(std::vector<Test>& table) {
    add(table,
        {"long.steps", Level::standard, false,
         "In 50 steps no answer is NaN or infinite or left out, and nothing is thrown."},
        steps, stepping);
    add(table,
        {"long.memory", Level::standard, false,
         "The memory that it uses does not grow with the steps."},
        memory, stepping);
}

}  // namespace dsc::conformance
