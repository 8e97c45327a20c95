#include "neighbours.hpp"

#include <algorithm>
#include <array>

#include <dsc/cloud/search.hpp>
#include <dsc/cloud/statistics.hpp>

namespace dsc::cloud {

namespace {

constexpr std::size_t block = 512;

}  // namespace

Neighbours find_neighbours(std::span<const Vec3> points, std::size_t wanted, Workers* workers) {
    const NearestSearch search(points);
    Neighbours out;
    out.each = std::min(std::max(wanted, reach_neighbours), points.size() - 1);
    out.index.resize(points.size() * out.each);
    out.reach.resize(points.size());
    for_blocks(workers, points.size(), block, [&](std::size_t begin, std::size_t end) {
        std::vector<Neighbour> found;
        for (std::size_t i = begin; i < end; ++i) {
            search.k_nearest(points[i], out.each + 1, found);
            // The point itself comes first unless others lie on it; then it may even be missing among those found.
            std::size_t count = 0;
            for (const Neighbour& n : found) {
                if (n.index == i || count == out.each) continue;
                out.index[i * out.each + count] = n.index;
                ++count;
                if (count == out.reached()) out.reach[i] = n.distance;
            }
        }
    });
    return out;
}

std::vector<double> median_reaches(const Neighbours& neighbours, Workers* workers) {
    std::vector<double> out(neighbours.reach.size());
    const std::size_t count = neighbours.reached();
    if (count == 0) return out;
    for_blocks(workers, out.size(), block, [&](std::size_t begin, std::size_t end) {
        std::array<double, reach_neighbours> around{};
        for (std::size_t i = begin; i < end; ++i) {
            for (std::size_t n = 0; n < count; ++n) around[n] = neighbours.reach[neighbours.of(i)[n]];
            const auto last = around.begin() + static_cast<std::ptrdiff_t>(count);
            const auto middle = around.begin() + static_cast<std::ptrdiff_t>(count / 2);
            std::nth_element(around.begin(), middle, last);
            out[i] = *middle;
        }
    });
    return out;
}

std::vector<double> label_widths(const Neighbours& neighbours, Workers* workers) {
    std::vector<double> out(neighbours.reach.size());
    const std::size_t count = neighbours.reached();
    if (count == 0) return out;
    for_blocks(workers, out.size(), block, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            double sum = neighbours.reach[i];
            for (std::size_t n = 0; n < count; ++n) sum += neighbours.reach[neighbours.of(i)[n]];
            out[i] = width_of(sum / static_cast<double>(count + 1), static_cast<double>(count) + 0.5);
        }
    });
    return out;
}

double median_of(std::vector<double> values) {
    if (values.empty()) return 0.0;
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

}  // namespace dsc::cloud
