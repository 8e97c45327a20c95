// geo.*: the answers do not depend on the coordinate system.
#include <algorithm>
#include <cmath>
#include <optional>
#include <string_view>
#include <utility>

#include <fmt/core.h>

#include "test_table.hpp"

namespace dsc::conformance {
namespace {

Motion some_motion() {
    return {Eigen::AngleAxisd(0.7, Vec3(1, -2, 3).normalized()).toRotationMatrix(),
            Vec3(0.11, -0.07, 0.05)};
}

double largest_of(const std::vector<double>& values, const Trace::Stretch& part) {
    double largest = 0;
    for (std::size_t i = part.begin; i < part.end; ++i)
        largest = std::max(largest, std::abs(values[i]));
    return largest;
}

// Scalars stay the same, vectors rotate. Vectors are compared relative to the longest vector,
// scalars relative to the largest value of their part, which has its own unit, or to the longest
// vector, since a part may be zero up to rounding.
void rigid(const Subject& subject) {
    if (!subject.record().traits.rigid)
        throw Skipped("it declares that it depends on a place or a direction");
    if (subject.record().traits.stochastic) throw Skipped("it is declared stochastic");
    subject.require_repeatable();
    subject.require_finite();
    constexpr double relative = 1e-7;
    const Motion motion = some_motion();
    const Trace trace = subject.answers({.steps = 1}).trace;
    const std::vector<double>& plain = trace.values();
    const std::vector<double> there =
        subject.answers_on(moved(subject.fixture(), motion), {.steps = 1}).trace.values();
    require(plain.size() == there.size(), "the number of answers changes when everything is moved");
    const std::vector<Trace::Stretch> parts = trace.stretches();
    double longest = 0;
    for (const Trace::Stretch& part : parts) {
        if (part.width == 3) longest = std::max(longest, largest_of(plain, part));
    }
    const std::string remedy = " when everything is moved and rotated; a strategy that depends on "
                               "a place or a direction declares traits = {.rigid = false}";
    for (const Trace::Stretch& part : parts) {
        if (part.width == 3) {
            for (std::size_t i = part.begin; i + 2 < part.end; i += 3) {
                const Vec3 turned = motion.rotation * Vec3(plain[i], plain[i + 1], plain[i + 2]);
                const Vec3 found(there[i], there[i + 1], there[i + 2]);
                require((turned - found).norm() <= relative * longest,
                        "the vector of " + trace.place(i) + " does not rotate" + remedy);
            }
            continue;
        }
        const double tolerance = relative * std::max(longest, largest_of(plain, part));
        for (std::size_t i = part.begin; i < part.end; ++i) {
            require(std::abs(plain[i] - there[i]) <= tolerance,
                    fmt::format("{} is {:f} instead of {:f}{}", trace.place(i), there[i], plain[i],
                                remedy));
        }
    }
}

// The power of the length in entry `i` of a part; empty if anything goes.
std::optional<int> expected_power(const Trace::Stretch& part, std::size_t i) {
    const auto is = [&part](std::string_view name) { return part.name.starts_with(name); };
    const std::size_t place = (i - part.begin) % part.width;
    if (is("displacements") || is("sampled displacements") || is("target length") || is("sizing"))
        return 1;
    if (is("edges to collapse")) return place >= 2 ? 1 : 0;
    if (is("vertices to move")) return place >= 1 ? 1 : 0;
    if (is("attribute")) return std::nullopt;
    return 0;
}

// A curvature is a power of the length: angles 0, 1/r -1, 1/r^2 -2. The largest value decides.
int found_power(const std::vector<double>& plain, const std::vector<double>& there,
                const Trace::Stretch& part, double factor) {
    const double before = largest_of(plain, part);
    const double after = largest_of(there, part);
    if (!(before > 0.0) || !(after > 0.0)) return 0;
    return static_cast<int>(std::lround(std::log(after / before) / std::log(factor)));
}

// Describes the first value that is not multiplied by the power of the factor; empty: none.
std::string unscaled(const Trace& trace, const std::vector<double>& there, double factor) {
    constexpr double relative = 1e-6;
    const std::vector<double>& plain = trace.values();
    if (plain.size() != there.size()) return "the number of answers changes";
    for (const Trace::Stretch& part : trace.stretches()) {
        const bool curvature = part.name.starts_with("curvature");
        const int common = curvature ? found_power(plain, there, part, factor) : 0;
        const double largest = std::max(largest_of(plain, part), largest_of(there, part));
        for (std::size_t i = part.begin; i < part.end; ++i) {
            const auto power = curvature ? std::optional(common) : expected_power(part, i);
            if (!power) break;
            const double expected = plain[i] * std::pow(factor, *power);
            if (std::abs(expected - there[i]) <= relative * largest) continue;
            return fmt::format("{} becomes {:.6g} instead of {:.6g}", trace.place(i), there[i],
                               expected);
        }
    }
    return {};
}

// The answers on the scaled fixture, with parameters to match; empty if they are out of range.
std::optional<std::vector<double>> scaled_answers(const Subject& subject, double factor,
                                                  int curvature_power) {
    const auto parameters =
        with_scaled_lengths(subject.schema(), subject.defaults(), factor, curvature_power);
    if (!parameters)
        throw Skipped("a parameter has a length in its unit or not, depending on another one");
    config::ConfigNode resolved;
    try {
        resolved = subject.resolve(*parameters);
    } catch (const Failed&) {
        return std::nullopt;
    }
    const auto strategy = subject.make(resolved);
    return exercise(subject.kind(), *strategy, scaled(subject.fixture(), factor), {.steps = 1})
        .trace.values();
}

// Describes what does not scale; empty: nothing.
std::string fault_of_scale(const Subject& subject, const Trace& plain, double factor) {
    std::string fault;
    for (const int curvature_power : {-1, 0}) {
        const auto there = scaled_answers(subject, factor, curvature_power);
        if (!there) throw Skipped("the scaled parameters are out of their ranges");
        fault = unscaled(plain, *there, factor);
        if (fault.empty()) break;
    }
    return fault;
}

// With surface, cloud, box and lengths of the parameters scaled, all answers scale too: a strategy
// has no length of its own. A factor of 3 also changes the rounding, which may decide between two
// equal edges; a power of two does not, so that it has the last word.
void scaling(const Subject& subject) {
    if (!subject.record().traits.rigid)
        throw Skipped("it declares that it depends on a place or a direction");
    subject.require_repeatable();
    subject.require_finite();
    const Trace plain = subject.answers({.steps = 1}).trace;
    for (const auto& [factor, exact] : {std::pair(3.0, 4.0), {1.0 / 3.0, 0.25}}) {
        const std::string fault = fault_of_scale(subject, plain, factor);
        if (fault.empty() || fault_of_scale(subject, plain, exact).empty()) continue;
        throw Failed(fmt::format(
            "with surface, cloud and box {} its answers do not scale: {}; it contains a length of "
            "its own, which must be a parameter with the unit \"length\" or relative to the mean "
            "edge, L or the box",
            factor > 1.0 ? "three times as large" : "a third as large", fault));
    }
}

}  // namespace

void add_geometry_tests(std::vector<Test>& table) {
    add(table,
        {"geo.rigid", Level::standard, false,
         "If surface and cloud are moved as a rigid body, the answers move with them."},
        rigid, per_vertex);
    add(table,
        {"geo.scale", Level::standard, false,
         "If surface, cloud, box and the lengths of the parameters are scaled, the answers scale "
         "with them."},
        scaling, {plugin::Kind::velocity, plugin::Kind::curvature, plugin::Kind::refinement});
}

}  // namespace dsc::conformance
