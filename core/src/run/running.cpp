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
    std::vector<const Running*> all;
};
RunsOfProcess& runs_of_process() {
    static auto* const runs = new RunsOfProcess;  // lives as long as the process, including exit()
    return *runs;
}

}  // namespace

Running::Running(Abandon abandon) : abandon_(std::move(abandon)) {
    const std::lock_guard lock(runs_of_process().mutex);
    runs_of_process().all.push_back(this);
}

Running::~Running() {
    const std::lock_guard lock(runs_of_process().mutex);
    auto& all = runs_of_process().all;
    all.erase(std::find(all.begin(), all.end(), this));
}

void Running::set_rescue(Rescue rescue) {
    const std::lock_guard lock(runs_of_process().mutex);
    rescue_ = std::move(rescue);
}

void abandon_runs(const Error& error, bool unchanged) {
    const std::lock_guard lock(runs_of_process().mutex);
    // The cause comes first: a fault while a state is saved must not hide it.
    for (const Running* run : runs_of_process().all) run->abandon_(error);
    if (!unchanged) return;
    for (const Running* run : runs_of_process().all) {
        if (run->rescue_) run->rescue_();
    }
}

}  // namespace dsc::run
