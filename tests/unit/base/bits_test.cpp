// A set of numbers as bits, against std::set.
#include <set>

#include <doctest/doctest.h>

#include <dsc/base/bits.hpp>
#include <dsc/base/random.hpp>

using namespace dsc;

TEST_CASE("a set of bits has the numbers that were inserted and not erased") {
    RandomStream random(RandomKey{17, 0, 0, 0});
    Bits bits;
    std::set<std::size_t> expected;
    std::size_t bound = 0;
    for (int n = 0; n < 5000; ++n) {
        if (n % 500 == 0) {
            bound += 1 + random.index(200);
            bits.grow(bound);
            bits.grow(bound / 2);  // never takes room away
        }
        const std::size_t i = random.index(bound);
        if (random.index(2) == 0) {
            bits.insert(i);
            expected.insert(i);
        } else {
            bits.erase(i);
            expected.erase(i);
        }
        const std::size_t asked = random.index(bound);
        REQUIRE(bits.contains(asked) == (expected.count(asked) > 0));
    }
    CHECK(expected.size() > 100);
}
