#pragma once
// Wall time, only for reports: no result depends on it.

#include <chrono>
#include <ctime>

namespace dsc::run {

class Stopwatch {
public:
    double seconds() const {
        return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
    }

private:
    std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

/// Adds the time of its lifetime to a sum.
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

/// CPU seconds of this process up to now, over all its threads.
inline double cpu_seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

/// Adds the CPU time of the process during its lifetime to a sum.
class CpuTimed {
public:
    explicit CpuTimed(double& sum) : sum_(&sum) {}
    ~CpuTimed() { *sum_ += cpu_seconds() - start_; }
    CpuTimed(const CpuTimed&) = delete;
    CpuTimed& operator=(const CpuTimed&) = delete;

private:
    double* sum_;
    double start_ = cpu_seconds();
};

}  // namespace dsc::run
