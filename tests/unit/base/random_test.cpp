#include <cmath>
#include <set>

#include <doctest/doctest.h>

#include <dsc/base/random.hpp>

using dsc::RandomKey;
using dsc::RandomStream;

TEST_CASE("a stream depends on its key alone") {
    RandomStream a(RandomKey{7, 1, 2, 3});
    RandomStream b(RandomKey{7, 1, 2, 3});
    for (int i = 0; i < 100; ++i) CHECK(a() == b());
}

TEST_CASE("every field of the key matters") {
    std::set<std::uint64_t> seen;
    for (const RandomKey& key :
         {RandomKey{1, 1, 1, 1}, RandomKey{2, 1, 1, 1}, RandomKey{1, 2, 1, 1},
          RandomKey{1, 1, 2, 1}, RandomKey{1, 1, 1, 2}, RandomKey{1ULL << 40U, 1, 1, 1},
          RandomKey{1, 1, 1, 1ULL << 40U}, RandomKey{1, 1, 1ULL << 40U, 1}}) {
        RandomStream stream(key);
        seen.insert((static_cast<std::uint64_t>(stream()) << 32U) | stream());
    }
    CHECK(seen.size() == 8);
}

TEST_CASE("moments of uniform and normal numbers") {
    RandomStream stream(RandomKey{42, 0, 0, 0});
    constexpr int n = 200000;
    double sum = 0, sum2 = 0, normal_sum = 0, normal_sum2 = 0;
    for (int i = 0; i < n; ++i) {
        const double u = stream.uniform();
        REQUIRE(u >= 0.0);
        REQUIRE(u < 1.0);
        const double g = stream.normal();
        sum += u;
        sum2 += u * u;
        normal_sum += g;
        normal_sum2 += g * g;
    }
    // Five standard errors each.
    CHECK(std::abs(sum / n - 0.5) < 5 * std::sqrt(1.0 / 12 / n));
    CHECK(std::abs(sum2 / n - 1.0 / 3) < 5 * 0.3 / std::sqrt(n));
    CHECK(std::abs(normal_sum / n) < 5 / std::sqrt(n));
    CHECK(std::abs(normal_sum2 / n - 1.0) < 5 * std::sqrt(2.0 / n));
}
