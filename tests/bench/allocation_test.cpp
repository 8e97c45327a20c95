// A settled step allocates nothing: view, velocity, movement, repair and topology work in memory
// that they have.
#include <atomic>
#include <cstdlib>
#include <new>

#include <doctest/doctest.h>

#include "pipeline.hpp"

namespace {

std::atomic<bool> counting = false;
std::atomic<std::size_t> allocations = 0;

void* counted(std::size_t size) {
    if (counting) ++allocations;
    if (void* p = std::malloc(size > 0 ? size : 1)) return p;
    throw std::bad_alloc();
}

}  // namespace

// The program's own: they serve the shared libraries too.
void* operator new(std::size_t size) { return counted(size); }
void* operator new[](std::size_t size) { return counted(size); }
void operator delete(void* p) noexcept { std::free(p); }
void operator delete[](void* p) noexcept { std::free(p); }
void operator delete(void* p, std::size_t) noexcept { std::free(p); }
void operator delete[](void* p, std::size_t) noexcept { std::free(p); }

TEST_CASE("a settled step of the thesis' protocol allocates nothing") {
    const dsc::bench::Plugins plugins;
    dsc::bench::Protocol protocol(plugins, dsc::bench::thesis(plugins, "teapot", false));
    protocol.run_to(50);  // the end of the first series: the arrays have seen the largest step
    std::size_t least = SIZE_MAX, sum = 0;
    constexpr std::size_t steps = 10;
    for (std::size_t i = 0; i < steps; ++i) {
        allocations = 0;
        counting = true;
        const dsc::bench::StepCost cost = protocol.step();
        counting = false;
        CHECK(cost.tried > 0);
        least = std::min<std::size_t>(least, allocations);
        sum += allocations;
    }
    MESSAGE("allocations in " << steps << " settled steps: " << sum << ", in the least of them "
                              << least);
    CHECK(sum == 0);
    // The counter counts: the same call on an empty pipeline allocates.
    counting = true;
    const std::size_t before = allocations;
    const std::vector<int> probe(1000);
    counting = false;
    CHECK(allocations == before + 1);
    CHECK(probe.size() == 1000);
}
