// Divides a list of vertices into blocks of space, and chooses the block that a thread continues
// with (method.md, section 10).
#include "kernel/star_loop.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include <dsc/base/prefetch.hpp>

namespace dsc::kernel {
namespace {

constexpr std::size_t least_block = 256;  // items, on average
constexpr std::size_t most_samples = 1024;
constexpr unsigned most_loops = 64;  // with the same planes, because vertices move on
constexpr std::size_t part = 4096;   // of the list, in items
constexpr std::size_t ahead = 16;    // how many items ahead the memory is asked for data

// Replaces the counts of a part by those before it.
template <class Counts>
void add_up(Counts& count, Counts& total) {
    for (std::size_t i = 0; i < count.size(); ++i) total[i] += std::exchange(count[i], total[i]);
}

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
    complex_.clear_marks();
}

// The leaf of a neighbour, so that a shape that moves on takes its leaves along.
std::uint8_t StarLoop::leaf_of_new(mesh::VertexId v) {
    for (const mesh::VertexId w : complex_.tet(complex_.seed(v)).v) {
        const std::uint8_t leaf = complex_.mark(w) & leaf_bits;
        if (leaf != no_leaf) return leaf;
    }
    return leaf_at(complex_.position(v)) + 1;
}

// Writes the dates of turns and leaf_of_, and gives vertices without a leaf the leaf of a
// neighbour. False if a vertex occurs twice, and so has two turns. Inner vertices get a date, too:
// the planes may be made anew after this, and then they need not be inner.
bool StarLoop::take_turns(std::span<const mesh::VertexId> vertices, Workers& workers) {
    leaf_of_.resize(vertices.size());
    std::atomic<bool> twice{false}, some_new{false};
    workers.for_blocks(vertices.size(), part, [&](std::size_t begin, std::size_t end) {
        for (std::size_t turn = begin; turn < end; ++turn) {
            if (turn + ahead < end) {
                complex_.prefetch_vertex(vertices[turn + ahead]);
                prefetch_line_to_write(&dates_[vertices[turn + ahead]]);
            }
            const std::atomic_ref date(dates_[vertices[turn]].turn);
            if (date.exchange(date_of(turn), std::memory_order_relaxed) > start_)
                twice.store(true, std::memory_order_relaxed);
            leaf_of_[turn] = mark_of(vertices[turn]) & leaf_bits;
            if (leaf_of_[turn] == no_leaf) some_new.store(true, std::memory_order_relaxed);
        }
    });
    if (twice) return false;
    if (some_new) find_new_leaves(vertices);
    return true;
}

void StarLoop::find_new_leaves(std::span<const mesh::VertexId> vertices) {
    for (std::size_t turn = 0; turn < vertices.size(); ++turn) {
        if (leaf_of_[turn] != no_leaf) continue;
        leaf_of_[turn] = leaf_of_new(vertices[turn]);
        complex_.mark(vertices[turn]) = leaf_of_[turn];
    }
}

// Whether no block has many times the average number of items.
bool StarLoop::is_balanced(const BlockCounts& count) const {
    return *std::max_element(count.begin(), count.end()) <=
           3 * leaf_of_.size() / (most_blocks >> coarser_) + least_block;
}

// How many items the blocks will have; items_before_ receives how many come before each part.
StarLoop::BlockCounts StarLoop::count_items(Workers& workers) {
    items_before_.assign(parts(), BlockCounts{});
    workers.for_blocks(leaf_of_.size(), part, [&](std::size_t begin, std::size_t end) {
        BlockCounts count{};
        for (std::size_t turn = begin; turn < end; ++turn) ++count[block_of(leaf_of_[turn])];
        items_before_[begin / part] = count;
    });
    BlockCounts total{};
    for (BlockCounts& count : items_before_) add_up(count, total);
    return total;
}

// The items of the blocks, in the order of their turns.
void StarLoop::fill_blocks(std::span<const mesh::VertexId> vertices, const BlockCounts& count,
                           Workers& workers) {
    for (std::size_t b = 0; b < most_blocks; ++b) blocks_[b].items.resize(count[b]);
    workers.for_blocks(leaf_of_.size(), part, [&](std::size_t begin, std::size_t end) {
        BlockCounts at = items_before_[begin / part];
        for (std::size_t turn = begin; turn < end; ++turn) {
            const std::size_t b = block_of(leaf_of_[turn]);
            blocks_[b].items[at[b]++] = {vertices[turn], static_cast<std::uint32_t>(turn), 0};
        }
    });
}

// A block gives dates to its own vertices only. Those of other blocks get the date at their turn,
// or after the loop.
void StarLoop::date_star(Block& block, mesh::VertexId v, std::uint32_t date) {
    const std::uint8_t mark = mark_of(v);
    if ((mark & inner_bit) != 0) {
        complex_.date_move(v, block.scratch.star, date, block.changes,
                           [](mesh::VertexId) { return true; });
        return;
    }
    const std::uint8_t own = block_of(mark);
    complex_.date_move(v, block.scratch.star, date, block.changes, [&](mesh::VertexId w) {
        if (block_of(mark_of(w)) == own) return true;
        raise_other_date(block, w, date);
        return false;
    });
}

void StarLoop::raise_other_date(Block& block, mesh::VertexId w, std::uint32_t date) {
    const std::atomic_ref latest(dates_[w].other);
    std::uint32_t known = latest.load(std::memory_order_relaxed);
    while (known < date) {
        if (!latest.compare_exchange_weak(known, date, std::memory_order_relaxed)) continue;
        if (known <= start_) block.dated.push_back(w);
        return;
    }
}

std::size_t StarLoop::parts() const { return block_count(leaf_of_.size(), part); }

// Makes room in the change list of the complex, and dates what the blocks have not dated yet.
std::span<mesh::TetId> StarLoop::count_changes(Workers& workers) {
    changes_before_.assign(parts(), BlockCounts{});
    workers.for_blocks(leaf_of_.size(), part, [&](std::size_t begin, std::size_t end) {
        BlockCounts at = items_before_[begin / part], count{};
        for (std::size_t turn = begin; turn < end; ++turn) {
            const std::size_t b = block_of(leaf_of_[turn]);
            count[b] += blocks_[b].items[at[b]++].changes;
        }
        changes_before_[begin / part] = count;
    });
    workers.for_blocks(most_blocks, 1, [this](std::size_t begin, std::size_t end) {
        for (const Block& block : std::span(blocks_).subspan(begin, end - begin)) {
            for (const mesh::VertexId v : block.dated) complex_.raise_date(v, other_date(v));
        }
    });
    listed_before_.clear();
    std::size_t listed = 0;
    BlockCounts total{};
    for (BlockCounts& count : changes_before_) {
        listed_before_.push_back(listed);
        listed += std::accumulate(count.begin(), count.end(), std::size_t{0});
        add_up(count, total);
    }
    return complex_.add_changes(listed);
}

// Writes the changes of the blocks in a part of the turns, in their order.
void StarLoop::list_changes(std::size_t p, std::span<mesh::TetId> list) const {
    BlockCounts item = items_before_[p], change = changes_before_[p];
    mesh::TetId* to = list.data() + listed_before_[p];
    const std::size_t end = std::min((p + 1) * part, leaf_of_.size());
    for (std::size_t turn = p * part; turn < end; ++turn) {
        const std::size_t b = block_of(leaf_of_[turn]);
        const std::size_t count = blocks_[b].items[item[b]++].changes;
        to = std::copy_n(blocks_[b].changes.changed.data() + change[b], count, to);
        change[b] += count;
    }
}

// Makes room for the watched tets of the blocks, one block after the other.
std::span<mesh::TetId> StarLoop::count_watched() {
    std::size_t count = 0;
    for (std::size_t b = 0; b < most_blocks; ++b) {
        watched_before_[b] = count;
        count += blocks_[b].changes.watched.size();
    }
    return complex_.add_watched(count);
}

void StarLoop::list_watched(std::size_t b, std::span<mesh::TetId> list) const {
    const LargeVector<mesh::TetId>& watched = blocks_[b].changes.watched;
    std::copy(watched.begin(), watched.end(),
              list.begin() + static_cast<std::ptrdiff_t>(watched_before_[b]));
}

// False if the items cannot be divided.
bool StarLoop::divide(std::span<const mesh::VertexId> vertices, Workers& workers) {
    if (vertices.size() < least_split || vertices.size() >= no_turn) return false;
    unsigned levels = 1;
    while (levels < most_levels && vertices.size() >> (levels + 1) >= least_block) ++levels;
    coarser_ = most_levels - levels;
    if (dates_.size() < complex_.vertex_slots()) dates_.resize(complex_.vertex_slots());
    complex_.take_reshaped(reshaped_);
    workers.for_blocks(reshaped_.size(), part, [this](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            if (i + ahead < end) complex_.prefetch_vertex(reshaped_[i + ahead]);
            complex_.mark(reshaped_[i]) &= leaf_bits;
        }
    });
    const bool is_new = loops_++ % most_loops == 0;
    if (is_new) make_planes(vertices);
    if (!take_turns(vertices, workers)) return false;
    BlockCounts count = count_items(workers);
    if (!is_new && !is_balanced(count)) {
        make_planes(vertices);
        std::fill(leaf_of_.begin(), leaf_of_.end(), no_leaf);
        find_new_leaves(vertices);
        count = count_items(workers);
    }
    fill_blocks(vertices, count, workers);
    for (Block& block : blocks_) {
        block.changes.changed.clear();
        block.changes.watched.clear();
        block.dated.clear();
        block.next = 0;
        block.prepared = false;
        block.waits_for = no_wait;
        block.seen = {};
        block.publish_turn();
    }
    return true;
}

StarLoop::Offer StarLoop::farthest_behind(const Thread& thread) const {
    const std::size_t count = most_blocks >> coarser_;
    std::array<std::uint32_t, most_blocks> turns;
    for (std::size_t b = 0; b < count; ++b)
        turns[b] = blocks_[b].turn.load(std::memory_order_acquire);
    Offer offer;
    std::uint32_t least = no_turn;
    bool preferred = false;
    for (std::size_t b = 0; b < count; ++b) {
        if (turns[b] == no_turn) continue;
        offer.finished = false;
        const bool prefers = thread.prefers(b, count);
        if ((prefers == preferred ? turns[b] >= least : preferred) ||
            blocks_[b].taken.load(std::memory_order_relaxed))
            continue;
        const std::uint64_t wait = blocks_[b].waits_for.load(std::memory_order_relaxed);
        if (wait != no_wait && turns[wait & 0xffU] <= wait >> 8U) continue;
        least = turns[b];
        preferred = prefers;
        offer.block = b;
    }
    return offer;
}

}  // namespace dsc::kernel
