#pragma once
// How a micro benchmark is declared and timed: a batch over many simplices of a snapshot, the CPU
// time of one attempt.

#include <functional>
#include <string>

#include <benchmark/benchmark.h>

#include "resources.hpp"
#include "snapshots.hpp"

namespace dsc::bench {

/// Registers NAME on each snapshot as SNAPSHOT/NAME. The body fills iterations by time_batch().
void on_snapshots(const std::string& name,
                  std::function<void(benchmark::State&, const Snapshot&)> body, int iterations = 1);

/// The time of a batch of `count` attempts, as nanoseconds an attempt.
template <class Work>
void record_batch(benchmark::State& state, std::size_t count, Work&& work) {
    state.SetIterationTime(cpu_of(work) / static_cast<double>(count));
    state.counters["attempts"] = static_cast<double>(count);
}

/// Batches that read: `read(i)` for all i < count, its result kept from the optimiser.
template <class Read>
void time_reads(benchmark::State& state, std::size_t count, Read&& read) {
    if (count == 0) {
        state.SkipWithError("no such simplex in this mesh");
        return;
    }
    while (state.KeepRunning()) {
        record_batch(state, count, [&] {
            for (std::size_t i = 0; i < count; ++i) benchmark::DoNotOptimize(read(i));
            benchmark::ClobberMemory();
        });
    }
}

void register_reads();
void register_operations();

}  // namespace dsc::bench
