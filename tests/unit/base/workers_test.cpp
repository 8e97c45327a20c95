#include <atomic>
#include <chrono>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include <doctest/doctest.h>

#include <dsc/base/thread_mark.hpp>
#include <dsc/base/workers.hpp>

TEST_CASE("every index is visited once, whatever the number of threads") {
    for (const unsigned threads : {1U, 2U, 5U}) {
        dsc::Workers workers(threads);
        for (const std::size_t count : {0UL, 1UL, 7UL, 1000UL}) {
            std::vector<std::atomic<int>> visits(count);
            workers.for_blocks(count, 64, [&](std::size_t begin, std::size_t end) {
                CHECK(begin % 64 == 0);
                for (std::size_t i = begin; i < end; ++i) ++visits[i];
            });
            for (const auto& v : visits) CHECK(v == 1);
        }
    }
}

TEST_CASE("loops that follow each other at once, or after the threads have fallen asleep") {
    for (const unsigned threads : {2U, 5U}) {
        dsc::Workers workers(threads);
        std::size_t expected = 0;
        std::atomic<std::size_t> sum{0};
        for (std::size_t loop = 0; loop < 3000; ++loop) {
            const std::size_t count = loop % 7;
            workers.for_blocks(count, 2, [&](std::size_t begin, std::size_t end) {
                for (std::size_t i = begin; i < end; ++i) sum += loop + i;
            });
            for (std::size_t i = 0; i < count; ++i) expected += loop + i;
            // The loop has ended: nobody adds to the sum any more.
            REQUIRE(sum == expected);
            if (loop % 300 == 0) std::this_thread::sleep_for(std::chrono::milliseconds(2));
        }
    }
}

TEST_CASE("a thread begins with its own part of the list") {
    dsc::Workers workers(2);
    // Each of the two blocks waits until the other one has begun, so two threads run them.
    for (int loop = 0; loop < 50; ++loop) {
        std::atomic<int> begun{0};
        std::thread::id first;
        workers.for_blocks(2, 1, [&](std::size_t begin, std::size_t) {
            if (begin == 0) first = std::this_thread::get_id();
            ++begun;
            while (begun < 2) std::this_thread::yield();
        });
        CHECK(first == std::this_thread::get_id());
    }
}

TEST_CASE("the failure of the first block is reported") {
    for (const unsigned threads : {1U, 3U}) {
        dsc::Workers workers(threads);
        std::string message;
        try {
            workers.for_blocks(1000, 10, [](std::size_t begin, std::size_t) {
                if (begin >= 200) throw std::runtime_error(std::to_string(begin));
            });
        } catch (const std::runtime_error& error) {
            message = error.what();
        }
        CHECK(message == "200");
        int blocks = 0;
        dsc::Workers one(1);
        one.for_blocks(30, 10, [&](std::size_t, std::size_t) { ++blocks; });
        CHECK(blocks == 3);
    }
}

TEST_CASE("the threads of a loop have the mark of the thread that runs it") {
    dsc::Workers workers(4);
    const int task = 0;
    std::atomic<int> wrong = 0;
    const auto require_mark = [&](const void* mark) {
        workers.for_blocks(1000, 1, [&](std::size_t, std::size_t) {
            if (dsc::thread_mark() != mark) ++wrong;
        });
    };
    {
        const dsc::ThreadMark marked(&task);
        require_mark(&task);
        {
            const dsc::ThreadMark inner(&wrong);
            require_mark(&wrong);
        }
        CHECK(dsc::thread_mark() == &task);
    }
    require_mark(nullptr);
    CHECK(dsc::thread_mark() == nullptr);
    CHECK(wrong == 0);
}
