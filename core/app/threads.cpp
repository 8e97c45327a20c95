// The option --threads.
#include "threads.hpp"

#include <algorithm>
#include <thread>

namespace dsc::app {

void add_threads(CLI::App& command, unsigned& threads) {
    command
        .add_option("--threads", threads,
                    "Number of threads; default: all. The result does not depend on it")
        ->check(CLI::Range(1U, 1024U));
}

unsigned thread_count(unsigned threads) {
    return threads != 0 ? threads : std::max(1U, std::thread::hardware_concurrency());
}

}  // namespace dsc::app
