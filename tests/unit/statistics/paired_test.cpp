// Samples and paired tests against published examples, hand calculation and SciPy 1.10.
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include <doctest/doctest.h>

#include <dsc/base/error.hpp>
#include <dsc/statistics/paired.hpp>
#include <dsc/statistics/sample.hpp>

using namespace dsc::statistics;
using doctest::Approx;

namespace {

// Heights of maize plants in eighths of an inch, crossed and self-fertilised, in 15 pairs: C.
// Darwin (1876), the example of R. A. Fisher, The Design of Experiments (1935), section 17.
const std::vector<double> crossed = {188, 96,  168, 176, 153, 172, 177, 163,
                                     146, 173, 186, 168, 177, 184, 96};
const std::vector<double> selfed = {139, 163, 160, 160, 147, 149, 149, 122,
                                    132, 144, 130, 144, 102, 124, 144};

std::vector<double> patterned(int count, int a, int b, int modulus, int shift, double divisor,
                              double slope) {
    std::vector<double> values;
    for (int i = 0; i < count; ++i)
        values.push_back(((a * i * i + b * i) % modulus - shift) / divisor + slope * i);
    return values;
}

}  // namespace

TEST_CASE("a sample: mean, deviation with n - 1, the interval by Student's t") {
    // The quantile of t with 4 degrees of freedom is 2.776445; sums by hand: mean 20.7 / 5, squares
    // 0.172.
    const Sample s = summarise(std::array{4.1, 3.9, 4.4, 4.0, 4.3});
    CHECK(s.n == 5);
    CHECK(s.mean == Approx(4.14).epsilon(1e-14));
    CHECK(s.deviation == Approx(std::sqrt(0.172 / 4.0)).epsilon(1e-13));
    CHECK(s.low == Approx(3.8825230732070914).epsilon(1e-12));
    CHECK(s.high == Approx(4.397476926792908).epsilon(1e-12));
    CHECK(s.half_interval() == Approx(2.7764451051977987 * s.deviation / std::sqrt(5.0)));
}

TEST_CASE("a sample that is too small has no deviation, and NaN is left out") {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const Sample one = summarise(std::array{nan, 3.0});
    CHECK(one.n == 1);
    CHECK(one.mean == 3.0);
    CHECK(std::isnan(one.deviation));
    CHECK(std::isnan(one.low));
    const Sample none = summarise({});
    CHECK(none.n == 0);
    CHECK(std::isnan(none.mean));
    const Sample equal = summarise(std::array{2.0, 2.0, nan, 2.0});
    CHECK(equal.n == 3);
    CHECK(equal.deviation == 0.0);
    CHECK(equal.low == 2.0);
}

TEST_CASE("Darwin's maize: paired interval, signed ranks and signs as published") {
    const PairedComparison c = compare_pairs(selfed, crossed);
    CHECK(c.difference.n == 15);
    CHECK(c.difference.mean == Approx(314.0 / 15.0).epsilon(1e-13));  // Fisher: 20.93 eighths
    CHECK(c.difference.low == Approx(0.03119331840152384).epsilon(1e-9));
    CHECK(c.difference.high == Approx(41.83547334826514).epsilon(1e-12));
    // The negative differences -67 and -48 have the ranks 14 and 10. Of the 2^15 signs, 676 have a
    // sum of at most 24.
    CHECK(c.ranks.n == 15);
    CHECK(c.ranks.exact);
    CHECK(c.ranks.statistic == 24.0);
    CHECK(c.ranks.probability == 2.0 * 676.0 / 32768.0);
    // 1 + 15 + 105 of 2^15 signs have at most two negative ones.
    CHECK(c.signs.positive == 13);
    CHECK(c.signs.negative == 2);
    CHECK(c.signs.probability == Approx(2.0 * 121.0 / 32768.0).epsilon(1e-13));
}

TEST_CASE("signed ranks, exact: by hand, without and with equal differences") {
    // Ranks of -0.1 and -0.4 are 1 and 2. Sums of at most 3: {}, 1, 2, 3, 1 + 2.
    const SignedRank few = signed_rank(std::array{1.2, -0.4, 2.3, 0.7, -0.1, 3.1, 1.9, 0.5});
    CHECK(few.statistic == 3.0);
    CHECK(few.probability == 2.0 * 5.0 / 256.0);
    // 0 is left out; the mean ranks are 2, 2, 2, 5, 5, 5, 7, 8.5, 8.5; negative: 2 + 5. Of the 512
    // signs, 21 have a sum of at most 7 (all subsets enumerated).
    const SignedRank equal = signed_rank(std::array{1., 1., -1., 2., 2., 3., 0., -2., 4., 4.});
    CHECK(equal.n == 9);
    CHECK(equal.statistic == 7.0);
    CHECK(equal.probability == 2.0 * 21.0 / 512.0);
    CHECK(signed_rank({}).probability == 1.0);
    CHECK(signed_rank(std::array{0.0, 0.0}).n == 0);
    const SignedRank even = signed_rank(std::array{1.0, -1.0});
    CHECK(even.statistic == 1.5);
    CHECK(even.probability == 1.0);
    // Five differences of one sign cannot be below 2 / 2^5.
    CHECK(signed_rank(std::array{5., 4., 3., 2., 1.}).probability == 0.0625);
}

TEST_CASE("signed ranks of 25 and of 38 differences as SciPy") {
    const SignedRank most = signed_rank(patterned(25, 5, 11, 101, 40, 8.0, 0.001));
    CHECK(most.exact);
    CHECK(most.statistic == 153.0);
    CHECK(most.probability == Approx(0.8119303584098816).epsilon(1e-12));
    // With equal differences, 0, and both corrections.
    const SignedRank many = signed_rank(patterned(40, 7, 3, 23, 8, 4.0, 0.0));
    CHECK(many.n == 38);
    CHECK_FALSE(many.exact);
    CHECK(many.statistic == 267.0);
    CHECK(many.probability == Approx(0.13444865978590767).epsilon(1e-12));
}

TEST_CASE("the sign test: binomial, two-sided") {
    const Signs signs = sign_test(patterned(40, 7, 3, 23, 8, 4.0, 0.0));
    CHECK(signs.positive == 24);
    CHECK(signs.negative == 14);
    CHECK(signs.zero == 2);
    CHECK(signs.probability == Approx(0.14330665429588407).epsilon(1e-12));
    // (1 + 8 + 28) / 2^8 on each side.
    CHECK(sign_test(std::array{1., 2., -1., 3., -4., 5., 1., 1.}).probability ==
          Approx(2.0 * 37.0 / 256.0).epsilon(1e-13));
    CHECK(sign_test(std::array{1.0, -1.0}).probability == 1.0);
    CHECK(sign_test({}).probability == 1.0);
}

TEST_CASE("pairs: NaN leaves the pair out, and different numbers are refused") {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const PairedComparison c = compare_pairs(std::array{1.0, nan, 3.0}, std::array{2.0, 9.0, 5.0});
    CHECK(c.first.n == 2);
    CHECK(c.first.mean == 2.0);
    CHECK(c.second.mean == 3.5);
    CHECK(c.difference.mean == 1.5);
    CHECK_THROWS_AS(compare_pairs(std::array{1.0}, {}), dsc::UsageError);
}
