#include "stages.hpp"

#include <algorithm>
#include <cmath>

namespace dsc::strategies::fit {
namespace {

constexpr double random_regularity = 1.1;  // random points have 1, with estimated widths up to 1.05
constexpr double start_bending = 1.5;      // widths: enough to move a staircase to the surface

}  // namespace

Scales scales_of(const cloud::Statistics& statistics, double noise) {
    Scales scales;
    scales.width = statistics.width;
    scales.noise = noise > 0.0 ? noise * statistics.width : statistics.noise;
    scales.even = statistics.even();
    scales.regular = statistics.regularity > random_regularity;
    scales.ratio = statistics.width > 0.0 ? scales.noise / statistics.width : 0.0;
    if (scales.even && noise <= 0.0) scales.ratio = cloud::certain_noise(scales.ratio);
    return scales;
}

Stage stage_of(const Scales& scales, std::size_t iteration, std::size_t iterations,
               double smoothing) {
    const double s = scales.ratio;
    const auto it = static_cast<double>(iteration);
    const auto all = static_cast<double>(iterations);
    Stage stage;
    const double last = smoothing * std::clamp(2.2 * std::sqrt(s), 0.22, 2.0);
    const double first = std::max(start_bending, last);
    stage.bending = first * std::pow(last / first, std::min(1.0, it / (settling_part * all)));
    stage.reach = it < start_part * all ? 2.1 : 1.05;
    stage.tangential = std::clamp(1.5 * s, 0.02, 1.0);
    stage.normal = 1e-3;
    stage.filter_rounds = s > 0.1 ? 4 : 1;
    stage.filter_range = std::min(0.8, 0.35 + s);
    // Not with noisy points; and no vertex is held while a large bending length still has to move
    // it.
    stage.attach =
        !scales.even && scales.regular && s < cloud::noise_floor && it >= settling_part * all;
    return stage;
}

std::size_t fill_iteration(std::size_t iterations) { return (2 * iterations + 3) / 7; }

}  // namespace dsc::strategies::fit
