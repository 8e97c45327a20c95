#include "rows.hpp"

#include <numeric>

namespace dsc::strategies::fit {

void gather_rows(RowSystem& system, std::span<const std::uint8_t> movable) {
    system.offsets.assign(movable.size() + 1, 0);
    const auto for_entries = [&](const auto& body) {
        for (std::uint32_t r = 0; r < system.rows.size(); ++r) {
            const Row& row = system.rows[r];
            for (std::size_t k = 0; k < row.factor.size(); ++k) {
                if (row.factor[k] != 0.0 && movable[row.vertex[k]] != 0)
                    body(r, row.vertex[k], row.factor[k]);
            }
        }
    };
    for_entries([&](std::uint32_t, std::uint32_t v, double) { ++system.offsets[v + 1]; });
    std::partial_sum(system.offsets.begin(), system.offsets.end(), system.offsets.begin());
    system.entries.resize(system.offsets.back());
    std::vector<std::uint32_t> place(system.offsets.begin(), system.offsets.end() - 1);
    for_entries([&](std::uint32_t r, std::uint32_t v, double factor) {
        system.entries[place[v]++] = {factor, r};
    });
}

}  // namespace dsc::strategies::fit
