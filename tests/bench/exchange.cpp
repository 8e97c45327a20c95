// Two threads that answer each other.
#include "exchange.hpp"

#include <atomic>
#include <chrono>
#include <thread>

#include <dsc/base/spin.hpp>

namespace dsc::bench {
namespace {

constexpr int rounds = 100;  // between two looks at the clock
constexpr std::chrono::milliseconds least{5};

struct alignas(64) Line {
    std::atomic<long> value{0};

    // With one core, the other thread can answer only if this one gives way.
    void wait_for(long expected) const {
        const auto here = [&] { return value.load(std::memory_order_acquire) == expected; };
        while (!spin_until(here)) std::this_thread::yield();
    }
};

}  // namespace

double exchange_ns() {
    using Clock = std::chrono::steady_clock;
    constexpr long end = -1;
    Line question, answer;
    const std::jthread other([&] {
        for (long next = 1;; ++next) {
            const auto news = [&] {
                const long value = question.value.load(std::memory_order_acquire);
                return value == next || value == end;
            };
            while (!spin_until(news)) std::this_thread::yield();
            if (question.value.load(std::memory_order_acquire) == end) return;
            answer.value.store(next, std::memory_order_release);
        }
    });
    long asked = 0;
    const auto ask = [&] {
        question.value.store(++asked, std::memory_order_release);
        answer.wait_for(asked);
    };
    ask();  // the other thread has started
    const Clock::time_point start = Clock::now();
    const long before = asked;
    while (Clock::now() - start < least) {
        for (int i = 0; i < rounds; ++i) ask();
    }
    const double ns = std::chrono::duration<double, std::nano>(Clock::now() - start).count();
    question.value.store(end, std::memory_order_release);
    return ns / static_cast<double>(2 * (asked - before));
}

}  // namespace dsc::bench
