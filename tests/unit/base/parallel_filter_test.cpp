#include <algorithm>
#include <atomic>

#include <doctest/doctest.h>

#include <dsc/base/parallel_filter.hpp>
#include <dsc/base/random.hpp>

TEST_CASE("a parallel filter keeps what a filter of one thread keeps, in its order") {
    dsc::ParallelFilter filter;
    dsc::RandomStream random(dsc::RandomKey{3, 0, 0, 0});
    for (const unsigned threads : {1U, 2U, 5U}) {
        CAPTURE(threads);
        dsc::Workers workers(threads);
        for (const std::size_t count : {0UL, 1UL, 4096UL, 4097UL, 50000UL}) {
            CAPTURE(count);
            std::vector<std::uint32_t> list;
            for (std::size_t i = 0; i < count; ++i)
                list.push_back(static_cast<std::uint32_t>(random.index(1000)));
            // Also nothing, everything, and long runs of one answer.
            for (const std::uint32_t bound : {0U, 300U, 1000U}) {
                const auto keep = [bound](std::uint32_t x) { return x < bound; };
                std::vector<std::uint32_t> expected, all = list;
                std::copy_if(list.begin(), list.end(), std::back_inserter(expected), keep);
                std::atomic<std::size_t> asked{0};
                filter.keep_if(
                    threads == 1 ? nullptr : &workers, all,
                    [&](std::uint32_t x) {
                        ++asked;
                        return keep(x);
                    },
                    [](std::uint32_t) {});
                CHECK(all == expected);
                CHECK(asked == count);
            }
        }
    }
}
