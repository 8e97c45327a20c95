// The stars and neighbours of vertices, stored until the connectivity round the vertex changes.
#include "dsc/mesh/star_cache.hpp"

#include <algorithm>

namespace dsc::mesh {
namespace {

constexpr std::size_t most_tets = 32768;  // larger stars are walked each time

}  // namespace

void StarCache::keep_tets(std::uint32_t v, std::span<const std::uint32_t> tets) {
    if (tets.size() > most_tets) return;
    Entry& entry = entries_[v];
    // The link is a triangulated sphere of n triangles with n / 2 + 2 vertices; on the box it is a
    // part of one and has a few vertices more.
    const std::size_t wanted = tets.size() + tets.size() / 2 + 4;
    if (entry.capacity < wanted) {
        const std::size_t capacity = (wanted + 15) / 16 * 16;
        entry.ids = std::make_unique_for_overwrite<std::uint32_t[]>(capacity);
        entry.capacity = static_cast<std::uint16_t>(capacity);
    }
    std::copy(tets.begin(), tets.end(), entry.ids.get());
    entry.tets = static_cast<std::uint16_t>(tets.size());
    entry.neighbours = 0;
}

void StarCache::keep_neighbours(std::uint32_t v, std::span<const std::uint32_t> neighbours) {
    Entry& entry = entries_[v];
    if (entry.tets == 0 || entry.tets + neighbours.size() > entry.capacity) return;
    std::copy(neighbours.begin(), neighbours.end(), entry.ids.get() + entry.tets);
    entry.neighbours = static_cast<std::uint16_t>(neighbours.size());
}

}  // namespace dsc::mesh
