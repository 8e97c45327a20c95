// Figures of a sample.
#include "dsc/statistics/sample.hpp"

#include <cmath>
#include <limits>

#include <boost/math/distributions/students_t.hpp>

namespace dsc::statistics {

Sample summarise(std::span<const double> values) {
    Sample sample;
    double sum = 0.0;
    for (const double value : values) {
        if (std::isnan(value)) continue;
        ++sample.n;
        sum += value;
    }
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    const auto n = static_cast<double>(sample.n);
    sample.mean = sample.n == 0 ? nan : sum / n;
    sample.deviation = sample.low = sample.high = nan;
    if (sample.n < 2 || !std::isfinite(sample.mean)) return sample;
    double squares = 0.0;
    for (const double value : values) {
        if (!std::isnan(value)) squares += (value - sample.mean) * (value - sample.mean);
    }
    sample.deviation = std::sqrt(squares / (n - 1.0));
    const boost::math::students_t distribution(n - 1.0);
    const double half =
        boost::math::quantile(distribution, 0.975) * sample.deviation / std::sqrt(n);
    sample.low = sample.mean - half;
    sample.high = sample.mean + half;
    return sample;
}

}  // namespace dsc::statistics
