#pragma once
// Calls a strategy of any kind as a run would, and records all its answers.

#include <dsc/base/progress.hpp>
#include <dsc/cloud/cloud.hpp>
#include <dsc/hooks/cloud_filter.hpp>
#include <dsc/plugin/kind.hpp>

#include "fixtures.hpp"
#include "trace.hpp"

namespace dsc::conformance {

/// How the calls are made; only the seed may change an answer.
struct Exercise {
    std::uint64_t first_step = 1;
    unsigned steps = 2;
    std::uint64_t seed = 1;
    unsigned threads = 1;
    std::size_t block = 64;  ///< number of vertices per evaluate()
    unsigned prepares = 1;   ///< prepare() calls per step; the answers after the last one count
    const CancelToken* cancel = nullptr;
};

/// The recorded answers and faults.
struct Answers {
    Trace trace;
    std::string outside;        ///< where it wrote outside an output; empty: nowhere
    std::string changed;        ///< which input it changed; empty: none
    std::string unfit;          ///< which attribute does not fit the surface; empty: none
    std::string unfit_lengths;  ///< which target lengths do not fit the surface; empty: none
};

/// Runs the steps first_step, first_step + 1, ... on the fixture. `strategy` is the plugin's own
/// object without checks: its exceptions are passed on. A strategy whose first step is not 1
/// continues a run (observers get no begin()).
Answers exercise(plugin::Kind kind, hooks::Strategy& strategy, const Fixture& fixture,
                 const Exercise& how = {});

/// The cloud of the fixture as filters get it: each point has a colour, a normal, an area and a
/// confidence; there is no orientation. The cloud has no points if the fixture has no cloud.
cloud::Cloud cloud_of(const Fixture& fixture);
/// The context of a filter.
hooks::FilterContext filter_context(const Exercise& how, Workers* workers);

/// The context of a step on the fixture.
hooks::StepContext context_of(const Fixture& fixture, std::uint64_t step, const Exercise& how,
                              Workers* workers);

}  // namespace dsc::conformance
