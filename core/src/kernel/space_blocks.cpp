// Splits space into blocks by planes, and finds the vertices whose neighbours are in the same block
// (method.md, section 10.1).
#include "kernel/space_blocks.hpp"

#include <algorithm>
#include <cmath>

namespace dsc::kernel {
namespace {

constexpr std::size_t vertices_at_a_time = 8192;

// The directions of the planes by wave: the planes of one wave cross those of the others.
constexpr std::array<std::array<std::array<double, 3>, 3>, 3> directions = {
    {{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}},
     {{{1, 1, 0}, {0, 1, 1}, {1, 0, 1}}},
     {{{1, -1, 0}, {0, 1, -1}, {-1, 0, 1}}}}};

}  // namespace

unsigned SpaceBlocks::block_at(const Vec3& place) const {
    unsigned node = 1;
    while (node < count_)
        node = 2 * node + (planes_[node].height(place) < planes_[node].offset ? 0 : 1);
    return node - count_;
}

void SpaceBlocks::split(std::span<mesh::VertexId> vertices, unsigned levels, unsigned wave,
                        Workers* workers) {
    count_ = 1U << std::min(levels, most_levels);
    split_node(1, vertices, wave);
    blocks_.resize(complex_.vertex_slots());
    inner_.resize(blocks_.size());
    for_blocks(workers, blocks_.size(), vertices_at_a_time,
               [this](std::size_t begin, std::size_t end) {
                   for (std::size_t v = begin; v < end; ++v) {
                       const Vec3& place = complex_.position(static_cast<mesh::VertexId>(v));
                       blocks_[v] = static_cast<std::uint8_t>(block_at(place));
                       inner_[v] = Answer::unknown;
                   }
               });
}

// The plane halves the vertices, across the direction in which they are spread most.
void SpaceBlocks::split_node(unsigned node, std::span<mesh::VertexId> vertices, unsigned wave) {
    if (node >= count_) return;
    Plane plane;
    double widest = -1.0;
    for (const auto& [x, y, z] : directions[wave % directions.size()]) {
        const Plane candidate{Vec3(x, y, z), 0.0};
        double low = INFINITY, high = -INFINITY;
        for (const mesh::VertexId v : vertices) {
            const double height = candidate.height(complex_.position(v));
            low = std::min(low, height);
            high = std::max(high, height);
        }
        if (!(high - low > widest)) continue;
        widest = high - low;
        plane = candidate;
    }
    const auto by_height = [&](mesh::VertexId a, mesh::VertexId b) {
        const double x = plane.height(complex_.position(a)), y = plane.height(complex_.position(b));
        return x != y ? x < y : complex_.birth(a) < complex_.birth(b);
    };
    const auto middle = vertices.begin() + static_cast<std::ptrdiff_t>(vertices.size() / 2);
    std::nth_element(vertices.begin(), middle, vertices.end(), by_height);
    if (!vertices.empty()) plane.offset = plane.height(complex_.position(*middle));
    planes_[node] = plane;
    split_node(2 * node, {vertices.begin(), middle}, wave);
    split_node(2 * node + 1, {middle, vertices.end()}, wave);
}

void SpaceBlocks::give(mesh::VertexId slot, unsigned block) {
    if (slot >= blocks_.size()) {
        blocks_.resize(complex_.vertex_slots());
        inner_.resize(blocks_.size());
    }
    blocks_[slot] = static_cast<std::uint8_t>(block);
    inner_[slot] = Answer::unknown;
}

bool SpaceBlocks::inner(mesh::VertexId v, unsigned block, std::vector<mesh::TetId>& star,
                        mesh::TetIndex& walk) {
    if (block_of(v) != block) return false;
    if (inner_[v] != Answer::unknown) return inner_[v] == Answer::inner;
    const auto own = [this, block](mesh::VertexId w) { return block_of(w) == block; };
    const std::span<const mesh::VertexId> neighbours = complex_.known_neighbours(v);
    bool all = true;
    if (!neighbours.empty()) {
        all = std::all_of(neighbours.begin(), neighbours.end(), own);
    } else {
        complex_.cached_star(v, star, walk);
        all = std::all_of(star.begin(), star.end(), [&](mesh::TetId t) {
            const auto& corners = complex_.tet(t).v;
            return std::all_of(corners.begin(), corners.end(), own);
        });
    }
    inner_[v] = all ? Answer::inner : Answer::border;
    return all;
}

}  // namespace dsc::kernel
