#pragma once
// Time for reports and limits: no result depends on it.

#include <chrono>
#include <ctime>

namespace dsc {

/// Seconds that a part of the program took.
struct Seconds {
    double cpu = 0.0;  ///< of the process, over all its threads
    double wall = 0.0;

    Seconds& operator+=(const Seconds& other) {
        cpu += other.cpu;
        wall += other.wall;
        return *this;
    }
};

class Stopwatch {
public:
    /// Wall time since the start.
    double seconds() const {
        return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
    }
    /// Both kinds of time since the start.
    Seconds elapsed() const { return {cpu_now() - cpu_start_, seconds()}; }

private:
    static double cpu_now() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

    std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
    double cpu_start_ = cpu_now();
};

/// Adds the time of its lifetime to a sum.
class Timed {
public:
    explicit Timed(Seconds& sum) : sum_(&sum) {}
    ~Timed() { *sum_ += watch_.elapsed(); }
    Timed(const Timed&) = delete;
    Timed& operator=(const Timed&) = delete;

private:
    Seconds* sum_;
    Stopwatch watch_;
};

}  // namespace dsc
