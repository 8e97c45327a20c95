#pragma once
// Hook `filter`: takes a cloud with its attributes and returns a cloud.

#include <cstdint>

#include <dsc/base/progress.hpp>
#include <dsc/base/workers.hpp>
#include <dsc/cloud/cloud.hpp>
#include <dsc/cloud/filter.hpp>
#include <dsc/hooks/context.hpp>

namespace dsc::hooks {

/// What a filter may read in addition to the cloud, which is in the units of the file. It is valid
/// until apply() returns.
struct FilterContext {
    /// Seed of the experiment. [1; -]
    std::uint64_t seed = 0;
    /// Stream id of this filter's place in the experiment; see InitialMeshContext. [1; -]
    std::uint64_t instance = 0;
    /// Says whether the run shall stop: on request, or because its time budget is over. After it
    /// has said so, the answer is discarded. May be null. [-; -]
    const CancelToken* cancel = nullptr;
    /// Threads for loops of the filter, with dsc::for_blocks(). Null: one thread. [-; -]
    Workers* workers = nullptr;
};

/// Drops points (and reports how many and why), moves them, or adds attributes. Lengths are in the
/// units of the file.
class CloudFilter : public Strategy {
public:
    ~CloudFilter() override;

    /// Returns the filtered cloud. Every attribute is empty or has one entry per point; points are
    /// finite; at least one point is left. report.kept is the number of returned points;
    /// report.kept + report.removed is the number of given points. [setup]
    virtual cloud::Filtered apply(const cloud::Cloud& cloud, const FilterContext& context) = 0;
};

}  // namespace dsc::hooks
