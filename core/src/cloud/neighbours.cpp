// The nearest neighbours of all points of a cloud.
#include "neighbours.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include <dsc/cloud/search.hpp>
#include <dsc/cloud/statistics.hpp>

namespace dsc::cloud {

namespace {

constexpr std::size_t search_block = 512;

/// The lowest 21 bits of a number, with two zeros between neighbouring bits.
std::uint64_t spread_bits(std::uint64_t bits) {
    bits = (bits | bits << 32U) & 0x001F00000000FFFFU;
    bits = (bits | bits << 16U) & 0x001F0000FF0000FFU;
    bits = (bits | bits << 8U) & 0x100F00F00F00F00FU;
    bits = (bits | bits << 4U) & 0x10C30C30C30C30C3U;
    return (bits | bits << 2U) & 0x1249249249249249U;
}

}  // namespace

std::vector<std::uint32_t> spatial_order(std::span<const Vec3> points) {
    const Box3 box = bounding_box(points);
    const double edge = box.empty() ? 0.0 : box.size().maxCoeff();
    const double per_unit = edge > 0.0 ? 2097151.0 / edge : 0.0;
    std::vector<std::pair<std::uint64_t, std::uint32_t>> keys(points.size());
    for (std::size_t i = 0; i < points.size(); ++i) {
        const Vec3 from_low = (points[i] - box.low) * per_unit;
        std::uint64_t key = 0;
        for (int k = 0; k < 3; ++k)
            key = key << 1U | spread_bits(static_cast<std::uint64_t>(from_low[k]));
        keys[i] = {key, static_cast<std::uint32_t>(i)};
    }
    std::sort(keys.begin(), keys.end());
    std::vector<std::uint32_t> order(points.size());
    for (std::size_t n = 0; n < order.size(); ++n) order[n] = keys[n].second;
    return order;
}

Neighbours find_neighbours(std::span<const Vec3> points, std::size_t wanted, Workers* workers) {
    const std::vector<std::uint32_t> order = spatial_order(points);
    std::vector<Vec3> ordered(points.size());
    for (std::size_t n = 0; n < order.size(); ++n) ordered[n] = points[order[n]];
    const NearestSearch search(ordered);
    Neighbours out;
    out.each = std::min(std::max(wanted, reach_neighbours), points.size() - 1);
    out.index.resize(points.size() * out.each);
    out.reach.resize(points.size());
    for_blocks(workers, points.size(), search_block, [&](std::size_t begin, std::size_t end) {
        std::vector<Neighbour> found;
        for (std::size_t q = begin; q < end; ++q) {
            search.k_nearest(ordered[q], out.each + 1, found);
            const std::size_t i = order[q];
            // The point itself comes first unless others coincide with it; then it may even be
            // missing in the result.
            std::size_t count = 0;
            for (const Neighbour& n : found) {
                if (n.index == q || count == out.each) continue;
                out.index[i * out.each + count] = order[n.index];
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
    for_blocks(workers, out.size(), search_block, [&](std::size_t begin, std::size_t end) {
        std::array<double, reach_neighbours> around{};
        for (std::size_t i = begin; i < end; ++i) {
            for (std::size_t n = 0; n < count; ++n)
                around[n] = neighbours.reach[neighbours.of(i)[n]];
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
    for_blocks(workers, out.size(), search_block, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            double sum = neighbours.reach[i];
            for (std::size_t n = 0; n < count; ++n) sum += neighbours.reach[neighbours.of(i)[n]];
            out[i] =
                width_of(sum / static_cast<double>(count + 1), static_cast<double>(count) + 0.5);
        }
    });
    return out;
}

}  // namespace dsc::cloud
