#pragma once
// The process that a test runs in: what it has printed, what it has used, and how it ends.

#include <chrono>
#include <dsc/conformance/check.hpp>
#include <functional>
#include <string>

namespace dsc::conformance {

/// Of this process, whose standard output and error go to a file while a test runs in a process of its own; 0 otherwise.
std::size_t printed_so_far();
/// The first 200 characters from there on.
std::string printed_since(std::size_t begin);

/// CPU time of this process.
double cpu_seconds();

/// What a test came to.
struct Verdict {
    Status status = Status::pass;
    std::string message;
};

/// Runs `body` in a child process, in an empty folder of its own, for at most `limit`. Output with a sanitizer's report is a
/// failure whatever the body says. [setup]
Verdict run_in_child(const std::function<Verdict()>& body, std::chrono::milliseconds limit);

}  // namespace dsc::conformance
