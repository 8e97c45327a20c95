// The list of active runs of this process.
#include "running.hpp"

#include <algorithm>
#include <mutex>
#include <utility>
#include <vector>

#include <dsc/run/run_experiment.hpp>

namespace dsc::run {
namespace {

struct RunsOfProcess {
    std::mutex mutex;
    std::vector<const Running::Abandon*> all;
};
RunsOfProcess& runs_of_process() {
    static auto* const runs = new RunsOfProcess;  // lives as long as the process, including exit()
    return *runs;
}

}  // namespace

Running::Running(Abandon abandon) : abandon_(std::move(abandon)) {
    const std::lock_guard lock(runs_of_process().mutex);
    runs_of_process().all.push_back(&abandon_);
}

Running::~Running() {
    const std::lock_guard lock(runs_of_process().mutex);
    auto& all = runs_of_process().all;
    all.erase(std::find(all.begin(), all.end(), &abandon_));
}

void abandon_runs(const Error& error) {
    const std::lock_guard lock(runs_of_process().mutex);
    for (const Running::Abandon* abandon : runs_of_process().all) (*abandon)(error);
}

}  // namespace dsc::run
