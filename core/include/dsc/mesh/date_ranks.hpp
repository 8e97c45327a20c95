#pragma once
// Small dates in place of large ones, so that the change clock never comes to its end.

#include <algorithm>
#include <cstdint>
#include <utility>

#include <dsc/base/large_vector.hpp>

namespace dsc::mesh {

/// Replaces each date of a set by its rank. For a date x that need not be in the set and a date d
/// that is in it, d > x if and only if rank(d) > rank(x). So whoever remembers dates and compares
/// them with those of a complex replaces them by their ranks, too. Date 0 stays 0.
class DateRanks {
public:
    /// `dates` in any order; a date may occur several times.
    explicit DateRanks(LargeVector<std::uint32_t> dates) : dates_(std::move(dates)) {
        std::sort(dates_.begin(), dates_.end());
        dates_.erase(std::unique(dates_.begin(), dates_.end()), dates_.end());
        if (!dates_.empty() && dates_.front() == 0) dates_.erase(dates_.begin());
    }
    /// How many dates of the set, without 0, are not after this one.
    std::uint32_t operator()(std::uint32_t date) const {
        return static_cast<std::uint32_t>(std::upper_bound(dates_.begin(), dates_.end(), date) -
                                          dates_.begin());
    }
    /// The same, in place.
    void replace(std::uint32_t& date) const { date = (*this)(date); }

private:
    LargeVector<std::uint32_t> dates_;
};

}  // namespace dsc::mesh
