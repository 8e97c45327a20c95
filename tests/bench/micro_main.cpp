// dsc_bench: what each walk, predicate and local operation costs, on snapshots of real runs. Takes
// google-benchmark's options; the time of a row is that of one attempt.
#include <cstdio>

#include <dsc/base/error.hpp>

#include "micro.hpp"

namespace dsc::bench {

void on_snapshots(const std::string& name,
                  std::function<void(benchmark::State&, const Snapshot&)> body, int iterations) {
    for (const std::string_view mesh : snapshot_names) {
        benchmark::RegisterBenchmark(
            (std::string(mesh) + "/" + name).c_str(),
            [body, mesh](benchmark::State& state) { body(state, snapshot(mesh)); })
            ->Iterations(iterations)
            ->UseManualTime();
    }
}

}  // namespace dsc::bench

int main(int argc, char** argv) {
    benchmark::Initialize(&argc, argv);
    if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
    try {
        dsc::bench::register_reads();
        dsc::bench::register_operations();
        benchmark::RunSpecifiedBenchmarks();
    } catch (const dsc::Error& error) {
        std::fprintf(stderr, "dsc_bench: %s\n", error.what());
        return static_cast<int>(error.exit_code());
    }
    benchmark::Shutdown();
    return 0;
}
