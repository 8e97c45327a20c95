#pragma once
// Mean, standard deviation and confidence interval of repeated measurements.

#include <cstddef>
#include <span>

namespace dsc::statistics {

/// Figures of a sample, in the units of its values. A figure that the sample is too small for is
/// NaN.
struct Sample {
    std::size_t n = 0;       ///< number of values that are not NaN
    double mean = 0.0;       ///< NaN without values
    double deviation = 0.0;  ///< standard deviation, with the divisor n - 1; NaN for n < 2
    double low = 0.0;        ///< the 95 % confidence interval of the mean, by Student's t
                             ///< distribution with n - 1 degrees of freedom; NaN for n < 2
    double high = 0.0;

    /// Half the length of the confidence interval.
    double half_interval() const { return 0.5 * (high - low); }
};

/// Values that are NaN are left out. [parallel]
Sample summarise(std::span<const double> values);

}  // namespace dsc::statistics
