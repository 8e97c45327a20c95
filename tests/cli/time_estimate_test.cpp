// The estimate of the time that a run still takes, on runs whose costs are known.
#include "../../core/app/time_estimate.hpp"

#include <cmath>

#include <doctest/doctest.h>

namespace {

using dsc::app::TimeEstimate;
using dsc::run::Series;

Series steps(std::uint32_t count) {
    return {.steps = count, .every = {}, .refine = {}, .until = {}};
}
Series refinement() { return {}; }

}  // namespace

TEST_CASE("time estimate: nothing before the first step, nothing left after the last") {
    TimeEstimate estimate({steps(3)});
    CHECK_FALSE(estimate.remaining().has_value());
    estimate.add(0, 100, 1.0);
    CHECK_FALSE(estimate.remaining().has_value());
    for (std::uint64_t step = 1; step <= 3; ++step) {
        estimate.add(step, 100, 1.0 + 0.5 * static_cast<double>(step));
        REQUIRE(estimate.remaining().has_value());
        CHECK(*estimate.remaining() == doctest::Approx(0.5 * static_cast<double>(3 - step)));
    }
}

TEST_CASE("time estimate: refinements make steps dearer by the factor that the first one shows") {
    const std::vector<Series> schedule = {steps(30), refinement(), steps(30), refinement(),
                                          steps(30)};
    TimeEstimate estimate(schedule);
    double now = 0;
    double whole = 0;
    for (int step = 1; step <= 90; ++step) whole += 1e-3 * 100 * std::pow(1.5, (step - 1) / 30);
    estimate.add(0, 100, 0);
    for (std::uint64_t step = 1; step <= 45; ++step) {
        const double vertices = step <= 30 ? 100 : 150;
        now += 1e-3 * vertices;
        estimate.add(step, static_cast<std::size_t>(vertices), now);
    }
    CHECK(now + estimate.remaining().value() == doctest::Approx(whole).epsilon(0.01));
}

TEST_CASE("time estimate: refined every few steps") {
    TimeEstimate estimate({{.steps = 40, .every = 10, .refine = {}, .until = {}}});
    double now = 0;
    double whole = 0;
    const auto vertices = [](std::uint64_t step) {
        return step <= 10 ? 100.0 : step <= 20 ? 200.0 : step <= 30 ? 400.0 : 800.0;
    };
    for (std::uint64_t step = 1; step <= 40; ++step) whole += 1e-3 * vertices(step);
    estimate.add(0, 100, 0);
    for (std::uint64_t step = 1; step <= 14; ++step) {
        now += 1e-3 * vertices(step);
        estimate.add(step, static_cast<std::size_t>(vertices(step)), now);
    }
    CHECK(now + estimate.remaining().value() == doctest::Approx(whole).epsilon(0.01));
}
