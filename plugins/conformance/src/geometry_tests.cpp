// geo.*: the answers do not depend on the coordinate system.
#include <algorithm>
#include <cmath>

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

}  // namespace

void add_geometry_tests(std::vector<Test>& table) {
    add(table,
        {"geo.rigid", Level::standard, false,
         "If surface and cloud are moved as a rigid body, the answers move with them."},
        rigid, per_vertex);
}

}  // namespace dsc::conformance
