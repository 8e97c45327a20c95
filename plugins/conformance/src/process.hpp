#pragma once
// The process in which a test runs: its output, its CPU time and its end.

#include <chrono>
#include <functional>
#include <string>

#include <dsc/conformance/check.hpp>

namespace dsc::conformance {

/// Number of bytes printed by this process: a file receives its standard output and error while it
/// runs a test; 0 otherwise.
std::size_t printed_so_far();
/// The first 200 characters printed after that position.
std::string printed_since(std::size_t begin);

/// CPU time of this process.
double cpu_seconds();

/// The result of a test.
struct Verdict {
    Status status = Status::pass;
    std::string message;
};

/// Runs `body` in a child process, in its own empty folder, for at most `limit`. Output with a
/// sanitizer's report is a failure, whatever the body returns. A read beyond the end of an input
/// ends the process; the verdict is then `beyond`, with the name of the input appended. A verdict
/// about a crash names the call into the strategy that was in progress. [setup]
Verdict run_in_child(const std::function<Verdict()>& body, std::chrono::milliseconds limit,
                     const Verdict& beyond = {Status::fail, ""});

}  // namespace dsc::conformance
