// The table of a star walk, against the standard map.
#include <unordered_map>

#include <doctest/doctest.h>

#include <dsc/base/random.hpp>
#include <dsc/mesh/tet_index.hpp>

using namespace dsc;
using mesh::TetIndex;

TEST_CASE("tet index: places as a standard map gives them, over lists of all lengths, with the "
          "largest ids") {
    RandomStream random(RandomKey{11, 1, 2, 3});
    TetIndex index;
    for (int list = 0; list < 400; ++list) {
        index.clear();
        std::unordered_map<std::uint32_t, std::uint32_t> expected;
        const std::uint64_t length = random.index(list % 50 == 0 ? 3000 : 60);
        // Neighbouring ids, far ones, and those that are multiples of the table's size.
        const std::uint32_t stride = list % 3 == 0 ? 1U : list % 3 == 1 ? 4096U : 715827883U;
        const std::uint32_t first = list % 2 == 0 ? 0U : 0xfffffff0U;
        for (std::uint64_t i = 0; i < length; ++i) {
            const auto t = first + stride * static_cast<std::uint32_t>(
                                                random.index(list % 50 == 0 ? 2500 : 200));
            const bool fresh =
                expected.emplace(t, static_cast<std::uint32_t>(expected.size())).second;
            REQUIRE(index.insert(t) == fresh);
        }
        REQUIRE(index.size() == expected.size());
        for (std::uint32_t i = 0; i < 2520; ++i) {
            const std::uint32_t t = first + stride * i;
            const auto found = expected.find(t);
            REQUIRE(index.contains(t) == (found != expected.end()));
            REQUIRE(index.find(t) == (found != expected.end() ? found->second : TetIndex::absent));
        }
    }
}
