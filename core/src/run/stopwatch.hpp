#pragma once
// Wall time, for reports only: no result depends on it.

#include <chrono>

namespace dsc::run {

class Stopwatch {
public:
    double seconds() const {
        return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
    }

private:
    std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

/// Adds the time of its life to a sum.
class Timed {
public:
    explicit Timed(double& sum) : sum_(&sum) {}
    ~Timed() { *sum_ += watch_.seconds(); }
    Timed(const Timed&) = delete;
    Timed& operator=(const Timed&) = delete;

private:
    double* sum_;
    Stopwatch watch_;
};

}  // namespace dsc::run
