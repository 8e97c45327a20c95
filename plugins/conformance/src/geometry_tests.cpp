// geo.*: the answers are geometry, not coordinates.
#include <algorithm>
#include <cmath>

#include "test_table.hpp"

namespace dsc::conformance {
namespace {

Motion some_motion() {
    return {Eigen::AngleAxisd(0.7, Vec3(1, -2, 3).normalized()).toRotationMatrix(), Vec3(0.11, -0.07, 0.05)};
}

// Scalars stay, vectors turn along.
void rigid(const Subject& subject) {
    if (!subject.record().traits.rigid) throw Skipped("it is declared to know a place or a direction");
    if (subject.record().traits.stochastic) throw Skipped("it is declared stochastic");
    subject.require_repeatable();
    subject.require_finite();
    const Motion motion = some_motion();
    const std::vector<double> plain = subject.answers({.steps = 1}).trace.values();
    const std::vector<double> there =
        subject.answers_on(moved(subject.fixture(), motion), {.steps = 1}).trace.values();
    require(plain.size() == there.size(), "it gives another number of answers when all is moved");
    const bool curvature = subject.kind() == plugin::Kind::curvature;
    const std::size_t scalars = curvature ? subject.fixture().view.vertex_count() : 0;
    double largest = 0;
    for (const double v : plain) largest = std::max(largest, std::abs(v));
    const double tolerance = 1e-7 * largest;
    for (std::size_t i = 0; i < scalars; ++i) {
        require(std::abs(plain[i] - there[i]) <= tolerance,
                "vertex " + std::to_string(i) + " has the curvature " + std::to_string(there[i]) +
                    " instead of " + std::to_string(plain[i]) + " when all is moved and turned");
    }
    for (std::size_t i = scalars; i + 2 < plain.size(); i += 3) {
        const Vec3 turned = motion.rotation * Vec3(plain[i], plain[i + 1], plain[i + 2]);
        const Vec3 found(there[i], there[i + 1], there[i + 2]);
        require(
            (turned - found).norm() <= tolerance,
            "the vector of entry " + std::to_string((i - scalars) / 3) +
                " does not turn along when all is moved and "
                "turned; a strategy that knows a place or a direction says so: traits = {.rigid = false}");
    }
}

}  // namespace

void add_geometry_tests(std::vector<Test>& table) {
    add(table,
        {"geo.rigid", Level::standard, false,
         "Surface and cloud moved as a rigid body move the answers with them."},
        rigid, per_vertex);
}

}  // namespace dsc::conformance
