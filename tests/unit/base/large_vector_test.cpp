// A vector in large pages.
#include <cstdint>
#include <limits>
#include <numeric>

#include <doctest/doctest.h>

#include <dsc/base/large_vector.hpp>

using namespace dsc;

TEST_CASE("a large vector keeps its elements while it grows, and is aligned from a page on") {
    LargeVector<std::uint32_t> list;
    constexpr std::uint32_t count = 3'000'000;
    for (std::uint32_t i = 0; i < count; ++i) list.push_back(i);
    CHECK(list.size() == count);
    CHECK(std::accumulate(list.begin(), list.end(), std::uint64_t{0}) ==
          std::uint64_t{count} * (count - 1) / 2);
    CHECK(reinterpret_cast<std::uintptr_t>(list.data()) % large_page == 0);
    const LargeVector<std::uint32_t> copy = list;
    CHECK(copy == list);
    CHECK(copy.data() != list.data());
    list.resize(3);
    list.shrink_to_fit();
    CHECK(list == LargeVector<std::uint32_t>{0, 1, 2});
    LargeVector<std::uint32_t> moved = std::move(list);
    CHECK(moved.size() == 3);
}

TEST_CASE("memory that no machine has is refused, and not half given") {
    constexpr std::size_t most = std::numeric_limits<std::size_t>::max();
    CHECK_THROWS_AS(LargePages<double>().allocate(most), std::bad_alloc);
    CHECK_THROWS_AS(allocate_large_pages(most - 1), std::bad_alloc);
}
