#include "stages.hpp"

#include <cmath>

#include <doctest/doctest.h>

using namespace dsc::strategies::fit;

namespace {

dsc::cloud::Statistics statistics(double ratio, double spread) {
    dsc::cloud::Statistics s;
    s.width = 0.02;
    s.noise = ratio * s.width;
    s.noise_ratio = ratio;
    s.spread = spread;
    s.regularity = 1.4;
    return s;
}

}  // namespace

TEST_CASE("little noise counts as none if the spacing is even, and in full if it is uneven or the "
          "noise is given") {
    CHECK(scales_of(statistics(0.1, 1.5), 0).ratio == 0.0);
    CHECK(scales_of(statistics(0.21, 1.5), 0).ratio == doctest::Approx(0.15));
    CHECK(scales_of(statistics(0.3, 1.5), 0).ratio == doctest::Approx(0.3));
    CHECK(scales_of(statistics(0.7, 1.5), 0).ratio == doctest::Approx(0.7));
    CHECK(scales_of(statistics(0.1, 3.5), 0).ratio == doctest::Approx(0.1));
    CHECK(scales_of(statistics(0.7, 1.5), 0.1).ratio == doctest::Approx(0.1));
    CHECK(scales_of(statistics(0.7, 1.5), 0.1).noise == doctest::Approx(0.002));
    // the noise that is corrected for is not reduced
    CHECK(scales_of(statistics(0.1, 1.5), 0).noise == doctest::Approx(0.002));
    CHECK(scales_of(statistics(0.1, 2.9), 0).even);
    CHECK_FALSE(scales_of(statistics(0.1, 3.0), 0).even);
}

TEST_CASE("the bending length falls from 1.5 widths to its last value in 60 % of the iterations") {
    const Scales clean = scales_of(statistics(0.0, 1.5), 0);
    CHECK(stage_of(clean, 0, 14, 1.0).bending == doctest::Approx(1.5));
    CHECK(stage_of(clean, 9, 14, 1.0).bending == doctest::Approx(0.22));
    CHECK(stage_of(clean, 100, 14, 1.0).bending == doctest::Approx(0.22));
    CHECK(stage_of(clean, 6, 20, 1.0).bending ==
          doctest::Approx(std::sqrt(1.5 * 0.22)));  // halfway, in proportions
    CHECK(stage_of(clean, 19, 14, 0.5).bending == doctest::Approx(0.11));
    const Scales noisy = scales_of(statistics(0.36, 1.5), 0);
    CHECK(stage_of(noisy, 13, 14, 1.0).bending == doctest::Approx(2.2 * 0.6));
    CHECK(stage_of(noisy, 13, 14, 3.0).bending == doctest::Approx(6.6 * 0.6));
    CHECK(stage_of(noisy, 0, 14, 3.0).bending == doctest::Approx(6.6 * 0.6));  // it never rises
}

TEST_CASE("reach, holds and filter follow the iteration and the noise") {
    const Scales clean = scales_of(statistics(0.0, 1.5), 0);
    CHECK(stage_of(clean, 4, 14, 1.0).reach == 2.1);
    CHECK(stage_of(clean, 5, 14, 1.0).reach == 1.05);
    CHECK(stage_of(clean, 5, 14, 1.0).tangential == doctest::Approx(0.02));
    CHECK(stage_of(clean, 5, 14, 1.0).filter_rounds == 1);
    CHECK(stage_of(clean, 5, 14, 1.0).filter_range == doctest::Approx(0.35));
    const Scales noisy = scales_of(statistics(0.4, 1.5), 0);
    CHECK(stage_of(noisy, 5, 14, 1.0).tangential == doctest::Approx(0.6));
    CHECK(stage_of(noisy, 5, 14, 1.0).filter_rounds == 4);
    CHECK(stage_of(noisy, 5, 14, 1.0).filter_range == doctest::Approx(0.75));
    CHECK(fill_iteration(14) == 4);
    CHECK(fill_iteration(24) == 7);
}

TEST_CASE("vertices move to points only if the spacing is uneven, without noise, once the bending "
          "length has its last value") {
    const Scales uneven = scales_of(statistics(0.1, 3.5), 0);
    CHECK_FALSE(stage_of(uneven, 8, 14, 1.0).attach);
    CHECK(stage_of(uneven, 9, 14, 1.0).attach);
    dsc::cloud::Statistics at_random = statistics(0.1, 3.5);
    at_random.regularity = 1.05;
    CHECK_FALSE(stage_of(scales_of(at_random, 0), 9, 14, 1.0).attach);
    CHECK_FALSE(stage_of(scales_of(statistics(0.1, 2.9), 0), 9, 14, 1.0).attach);
    CHECK_FALSE(stage_of(scales_of(statistics(0.13, 3.5), 0), 9, 14, 1.0).attach);
}
