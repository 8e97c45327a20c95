// A run of the program that crashes between the calls of strategies, as a defect of the program
// would.   crash_outside EXPERIMENT FOLDER PLUGIN
#include <dsc/host/host.hpp>
#include <dsc/host/search_path.hpp>
#include <dsc/run/run_experiment.hpp>

#include "../../core/app/crash_guard.hpp"
#include "../../core/app/exit_guard.hpp"
#include "../../core/app/standard_streams.hpp"

int main(int, char** argv) {
    dsc::app::take_standard_streams();
    dsc::host::Host host;
    dsc::host::SearchOptions search;
    search.command_line = {argv[3]};
    host.load_all(dsc::host::search_path(search));
    const auto loaded = dsc::run::load_experiment(
        argv[1], {}, [&](const auto&) -> const dsc::config::StrategyLookup& { return host; });
    dsc::app::guard_exit();
    dsc::app::guard_crashes(host.plugins());
    static int* volatile nowhere = nullptr;
    dsc::run::RunOptions options;
    options.folder = argv[2];
    options.on_step = [](const dsc::run::StepMetrics& row, std::uint64_t) {
        if (row.step == 2) *nowhere = 1;
    };
    dsc::run::run_experiment(loaded, host, options);
    return dsc::app::leave(0);
}
