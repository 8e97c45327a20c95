#pragma once
// Computes one value per element, in parallel.

#include <cstddef>
#include <vector>

#include <dsc/base/workers.hpp>

namespace dsc {

/// value(i) for all i below `count`, computed in blocks that do not depend on the number of
/// threads; `workers` null: one thread.
template <class Value>
std::vector<double> parallel_table(Workers* workers, std::size_t count, const Value& value) {
    std::vector<double> values(count);
    for_blocks(workers, count, 256, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) values[i] = value(i);
    });
    return values;
}

}  // namespace dsc
