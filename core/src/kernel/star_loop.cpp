// Divides a list of vertices into blocks of space, and chooses the block that a thread continues
// with (method.md, section 10).
#include "kernel/star_loop.hpp"

#include <algorithm>
#include <cmath>

namespace dsc::kernel {
namespace {

constexpr std::size_t least_block = 256;  // items, on average
constexpr std::size_t most_samples = 1024;
constexpr unsigned most_loops = 64;      // with the same planes, because vertices move on
constexpr std::size_t looked_up = 4096;  // items whose block a thread finds at a time

}  // namespace

// The planes below a node of the tree: each halves the samples across their longest extent.
void StarLoop::split(unsigned node, unsigned level, std::span<Vec3> samples) {
    if (level == most_levels) return;
    Vec3 low = samples.front(), high = samples.front();
    for (const Vec3& p : samples) {
        low = low.cwiseMin(p);
        high = high.cwiseMax(p);
    }
    Plane& plane = planes_[node];
    (high - low).maxCoeff(&plane.axis);
    const auto middle = samples.begin() + static_cast<std::ptrdiff_t>(samples.size() / 2);
    std::nth_element(samples.begin(), middle, samples.end(),
                     [&](const Vec3& x, const Vec3& y) { return x[plane.axis] < y[plane.axis]; });
    plane.at = (*middle)[plane.axis];
    split(2 * node, level + 1, samples.first(samples.size() / 2));
    split(2 * node + 1, level + 1, samples.subspan(samples.size() / 2));
}

std::uint8_t StarLoop::leaf_at(const Vec3& place) const {
    unsigned node = 1;
    for (unsigned level = 0; level < most_levels; ++level) {
        const Plane& plane = planes_[node];
        node = 2 * node + (place[plane.axis] < plane.at ? 0 : 1);
    }
    return static_cast<std::uint8_t>(node - most_blocks);
}

void StarLoop::make_planes(std::span<const mesh::VertexId> vertices) {
    const std::size_t stride = (vertices.size() + most_samples - 1) / most_samples;
    samples_.clear();
    for (std::size_t turn = 0; turn < vertices.size(); turn += stride)
        samples_.push_back(complex_.position(vertices[turn]));
    split(1, 0, samples_);
    std::fill(leaf_of_vertex_.begin(), leaf_of_vertex_.end(), no_leaf);
    std::fill(inner_since_.begin(), inner_since_.end(), 0);
}

// Writes block_of_. A vertex keeps its leaf as long as the planes stay, so that inner vertices are
// known again in the next loop.
void StarLoop::find_blocks(std::span<const mesh::VertexId> vertices, Workers& workers) {
    block_of_.resize(vertices.size());
    workers.for_blocks(vertices.size(), looked_up, [&](std::size_t begin, std::size_t end) {
        for (std::size_t turn = begin; turn < end; ++turn) {
            const mesh::VertexId v = vertices[turn];
            block_of_[turn] =
                leaf_of_vertex_[v] != no_leaf ? leaf_of_vertex_[v] : leaf_at(complex_.position(v));
        }
    });
    for (std::size_t turn = 0; turn < vertices.size(); ++turn) {
        leaf_of_vertex_[vertices[turn]] = block_of_[turn];
        block_of_[turn] = static_cast<std::uint8_t>(block_of_[turn] >> coarser_);
    }
}

// Whether no block has many times the average number of items.
bool StarLoop::is_balanced() const {
    std::array<std::size_t, most_blocks> count{};
    for (const std::uint8_t block : block_of_) ++count[block];
    return *std::max_element(count.begin(), count.end()) <=
           3 * block_of_.size() / (most_blocks >> coarser_) + least_block;
}

// False if the items cannot be divided.
bool StarLoop::divide(std::span<const mesh::VertexId> vertices, Workers& workers) {
    if (vertices.size() < least_split || vertices.size() >= no_turn) return false;
    unsigned levels = 1;
    while (levels < most_levels && vertices.size() >> (levels + 1) >= least_block) ++levels;
    coarser_ = most_levels - levels;
    if (turn_of_vertex_.size() < complex_.vertex_slots()) {
        leaf_of_vertex_.resize(complex_.vertex_slots(), no_leaf);
        inner_since_.resize(complex_.vertex_slots(), 0);
        turn_of_vertex_.resize(complex_.vertex_slots(), no_turn);
    }
    const bool is_new = loops_++ % most_loops == 0;
    if (is_new) make_planes(vertices);
    find_blocks(vertices, workers);
    if (!is_new && !is_balanced()) {
        make_planes(vertices);
        find_blocks(vertices, workers);
    }
    for (Block& block : blocks_) {
        block.items.clear();
        block.changed.clear();
        block.next = block.settled = block.listed = 0;
        block.prepared = false;
    }
    for (std::uint32_t turn = 0; turn < vertices.size(); ++turn) {
        const mesh::VertexId v = vertices[turn];
        if (turn_of_vertex_[v] != no_turn) {  // It occurs twice, so it has two turns.
            for (const mesh::VertexId w : vertices) turn_of_vertex_[w] = no_turn;
            return false;
        }
        turn_of_vertex_[v] = turn;
        blocks_[block_of_[turn]].items.push_back({turn});
    }
    for (Block& block : blocks_)
        block.turn = block.items.empty() ? no_turn : block.items.front().turn;
    return true;
}

StarLoop::Offer StarLoop::farthest_behind(std::uint32_t refused) const {
    Offer offer;
    std::uint32_t least = no_turn;
    for (std::size_t b = 0; b < most_blocks >> coarser_; ++b) {
        const std::uint32_t turn = blocks_[b].turn.load(std::memory_order_acquire);
        if (turn == no_turn) continue;
        offer.finished = false;
        if (turn >= least || (refused >> b & 1U) != 0 ||
            blocks_[b].taken.load(std::memory_order_relaxed))
            continue;
        least = turn;
        offer.block = b;
    }
    return offer;
}

}  // namespace dsc::kernel
