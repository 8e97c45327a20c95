// A vector in large pages.
#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <fstream>
#include <limits>
#include <numeric>
#include <string>
#include <vector>

#ifdef __linux__
#include <unistd.h>
#endif

#include <doctest/doctest.h>

#include <dsc/base/large_vector.hpp>
#include <dsc/base/release.hpp>

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

#ifdef __linux__
namespace {

// Whether the system was asked for large pages at an address; see proc(5).
bool prefers_large_pages(const void* address) {
    std::ifstream maps("/proc/self/smaps");
    const auto at = reinterpret_cast<std::uintptr_t>(address);
    bool here = false;
    for (std::string line; std::getline(maps, line);) {
        std::uintptr_t begin = 0, end = 0;
        if (std::sscanf(line.c_str(), "%zx-%zx ", &begin, &end) == 2)
            here = begin <= at && at < end;
        if (here && line.starts_with("VmFlags:")) return line.find(" hg") != std::string::npos;
    }
    return false;
}

}  // namespace

TEST_CASE("large pages are asked for inside memory of any place and size, which keeps its data") {
    const bool offered = std::ifstream("/sys/kernel/mm/transparent_hugepage/enabled").good();
    std::vector<char> list(3 * large_page, 'x');
    for (const std::size_t skipped : {0, 1, 4096, 100'000}) {
        CAPTURE(skipped);
        prefer_large_pages(list.data() + skipped, list.size() - skipped);
        CHECK(prefers_large_pages(list.data() + list.size() / 2) == offered);
        CHECK(std::all_of(list.begin(), list.end(), [](char c) { return c == 'x'; }));
    }
    std::vector<char> small(large_page - 1, 'y');
    prefer_large_pages(small.data(), small.size());
    CHECK_FALSE(prefers_large_pages(small.data() + small.size() / 2));
}
#endif

TEST_CASE("release gives back what an empty list of braces keeps") {
    LargeVector<int> list(1000, 7);
    list = {};
    CHECK(list.empty());
    CHECK(list.capacity() >= 1000);  // the reason for release()
    release(list);
    CHECK(list.capacity() == 0);
    std::string text(1000, 'x');
    release(text);
    CHECK(text.empty());
    CHECK(text.capacity() < 1000);
}

TEST_CASE("a list gives back room for three times what it needs, but nothing small") {
    constexpr std::size_t many = 4 * large_page / sizeof(std::uint32_t);
    LargeVector<std::uint32_t> list(many, 1);
    give_back_room(list, many / 2);
    CHECK(list.size() == many);
    give_back_room(list, many / 4);
    CHECK(list.empty());
    CHECK(list.capacity() == many / 4);
    LargeVector<std::uint32_t> small(1000, 1);
    give_back_room(small, 0);
    CHECK(small.size() == 1000);
}

TEST_CASE("resize adds elements with the initial values of their type") {
    struct WithValue {
        std::uint32_t number = 42;
    };
    LargeVector<WithValue> list;
    list.resize(1000);
    CHECK(std::all_of(list.begin(), list.end(), [](const WithValue& x) { return x.number == 42; }));
    LargeVector<std::uint32_t> filled(1000, 3);
    filled.resize(2000, 4);
    CHECK(std::count(filled.begin(), filled.end(), 3U) == 1000);
    CHECK(std::count(filled.begin(), filled.end(), 4U) == 1000);
}

#ifdef __linux__
namespace {

// What the process has in memory, in bytes.
std::size_t resident() {
    std::size_t pages = 0, total = 0;
    std::ifstream("/proc/self/statm") >> total >> pages;
    return pages * static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
}

}  // namespace

TEST_CASE("memory in large pages goes back to the system when it is freed") {
    constexpr std::size_t bytes = 64 * large_page;
    const std::size_t before = resident();
    LargeVector<char> list(bytes, 1);
    CHECK(resident() > before + bytes / 2);
    release(list);
    CHECK(resident() < before + bytes / 4);
}
#endif
