#pragma once
// Hook `filter`: takes a cloud with its attributes and returns one.

#include <cstdint>

#include <dsc/base/progress.hpp>
#include <dsc/base/workers.hpp>
#include <dsc/cloud/cloud.hpp>
#include <dsc/cloud/filter.hpp>
#include <dsc/hooks/context.hpp>

namespace dsc::hooks {

/// What a filter may look at besides the cloud.
struct FilterContext {
    std::uint64_t seed = 0;
    std::uint64_t instance = 0;  ///< stream id of this filter's place in the experiment
    const CancelToken* cancel = nullptr;
    Workers* workers = nullptr;  ///< for loops of its own (dsc::for_blocks); null: one thread
};

/// Drops points (and reports how many and why), moves them, or adds attributes. Lengths are in the units of the file.
class CloudFilter : public Strategy {
public:
    ~CloudFilter() override;

    /// The filtered cloud: every attribute is empty or has one entry per point, points are finite, at least one is left.
    /// report.kept is the number of returned points, report.kept + report.removed that of the given ones. [setup]
    virtual cloud::Filtered apply(const cloud::Cloud& cloud, const FilterContext& context) = 0;
};

}  // namespace dsc::hooks
