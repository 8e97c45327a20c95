#pragma once
// Offers the present state of a simulation, for the case that a strategy never returns.

#include <functional>
#include <utility>

#include <dsc/run/simulation.hpp>

namespace dsc::run {

/// Offers the function of on_rescue during the lifetime of the object.
class OfferedRescue {
public:
    OfferedRescue(const SimulationOptions& options, std::function<void()> rescue)
        : options_(options) {
        if (options_.on_rescue) options_.on_rescue(std::move(rescue));
    }
    ~OfferedRescue() {
        if (options_.on_rescue) options_.on_rescue({});
    }
    OfferedRescue(const OfferedRescue&) = delete;
    OfferedRescue& operator=(const OfferedRescue&) = delete;

private:
    const SimulationOptions& options_;
};

}  // namespace dsc::run
