#pragma once
// The median of numbers.

#include <algorithm>
#include <cstddef>
#include <vector>

namespace dsc {

/// The upper median; 0 without values. [parallel]
inline double median_of(std::vector<double> values) {
    if (values.empty()) return 0.0;
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

}  // namespace dsc
