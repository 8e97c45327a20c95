// Divides a list of vertices into blocks of space, and chooses the block that a thread continues
// with (method.md, section 10).
#include "kernel/star_loop.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numeric>
#include <utility>

#include <dsc/base/prefetch.hpp>

namespace dsc::kernel {
namespace {

constexpr unsigned most_levels = std::bit_width(StarBlock::most) - 1;  // of the tree
constexpr std::size_t least_block = 256;                               // items, on average
constexpr std::size_t most_samples = 1024;
constexpr unsigned most_loops = 64;  // with the same planes, because vertices move on
constexpr std::size_t part = 4096;   // of the list, in items
constexpr std::size_t ahead = 16;    // how many items ahead the memory is asked for data

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

// Writes marks_, and gives vertices without a leaf the leaf of a neighbour.
void StarLoop::take_marks(std::span<const mesh::VertexId> vertices, Workers& workers) {
    marks_.resize(vertices.size());
    std::atomic<bool> some_new{false};
    workers.for_blocks(vertices.size(), part, [&](std::size_t begin, std::size_t end) {
        for (std::size_t turn = begin; turn < end; ++turn) {
            if (turn + ahead < end) complex_.prefetch_vertex(vertices[turn + ahead]);
            marks_[turn] = complex_.mark(vertices[turn]);
            if ((marks_[turn] & leaf_bits) == no_leaf)
                some_new.store(true, std::memory_order_relaxed);
        }
    });
    if (some_new) find_new_leaves(vertices);
}

void StarLoop::find_new_leaves(std::span<const mesh::VertexId> vertices) {
    for (std::size_t turn = 0; turn < vertices.size(); ++turn) {
        if ((marks_[turn] & leaf_bits) == no_leaf)
            complex_.mark(vertices[turn]) = marks_[turn] = leaf_of_new(vertices[turn]);
    }
}

// Whether no block has many times the average number of items.
bool StarLoop::is_balanced(const BlockCounts& count) const {
    return *std::max_element(count.begin(), count.end()) <=
           3 * marks_.size() / blocks() + least_block;
}

// How many items the blocks will have; items_before_ receives how many come before each part.
StarLoop::BlockCounts StarLoop::count_items(Workers& workers) {
    items_before_.assign(parts(), BlockCounts{});
    workers.for_blocks(marks_.size(), part, [&](std::size_t begin, std::size_t end) {
        BlockCounts count{};
        for (std::size_t turn = begin; turn < end; ++turn) ++count[block_of(marks_[turn])];
        items_before_[begin / part] = count;
    });
    BlockCounts total{};
    for (BlockCounts& count : items_before_) {
        for (std::size_t b = 0; b < most_blocks; ++b) total[b] += std::exchange(count[b], total[b]);
    }
    return total;
}

// The items of the blocks in the order of their turns, and the dates of the turns that another
// block may ask for. False if one of these vertices has two turns.
bool StarLoop::fill_blocks(std::span<const mesh::VertexId> vertices, const BlockCounts& count,
                           Workers& workers) {
    for (std::size_t b = 0; b < most_blocks; ++b) blocks_[b].items.resize(count[b]);
    std::atomic<bool> twice{false};
    workers.for_blocks(marks_.size(), part, [&](std::size_t begin, std::size_t end) {
        BlockCounts at = items_before_[begin / part];
        for (std::size_t turn = begin; turn < end; ++turn) {
            if (turn + ahead < end && (marks_[turn + ahead] & inner_bit) == 0)
                prefetch_line_to_write(&dates_[vertices[turn + ahead]]);
            const std::size_t b = block_of(marks_[turn]);
            blocks_[b].items[at[b]++] = {vertices[turn], static_cast<std::uint32_t>(turn), 0, 0};
            if ((marks_[turn] & inner_bit) != 0) continue;
            const std::atomic_ref date(dates_[vertices[turn]].turn);
            if (date.exchange(date_of(turn), std::memory_order_relaxed) > start_)
                twice.store(true, std::memory_order_relaxed);
        }
    });
    return !twice;
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

std::size_t StarLoop::parts() const { return block_count(marks_.size(), part); }

StarLoop::ChangeSpans StarLoop::make_room() {
    std::size_t changed = 0, watched = 0;
    for (const Block& block : blocks_) {
        changed += block.changes.changed.size();
        watched += block.changes.watched.size();
    }
    return {complex_.add_changes(changed), complex_.add_watched(watched)};
}

// Writes the changes of the blocks in a part of the turns, in their order.
void StarLoop::list_changes(std::size_t p, std::span<mesh::TetId> list) const {
    BlockCounts item = items_before_[p], change{};
    for (std::size_t b = 0; b < most_blocks; ++b)
        change[b] = item[b] == 0 ? 0 : blocks_[b].items[item[b] - 1].changes_end;
    mesh::TetId* to = list.data() + std::accumulate(change.begin(), change.end(), std::size_t{0});
    const std::size_t end = std::min((p + 1) * part, marks_.size());
    for (std::size_t turn = p * part; turn < end; ++turn) {
        const std::size_t b = block_of(marks_[turn]);
        const std::size_t to_end = blocks_[b].items[item[b]++].changes_end;
        to = std::copy(blocks_[b].changes.changed.data() + change[b],
                       blocks_[b].changes.changed.data() + to_end, to);
        change[b] = to_end;
    }
}

// Lists the watched tets of a block after those of the earlier blocks, and dates what it has not
// dated yet.
void StarLoop::finish_block(std::size_t b, std::span<mesh::TetId> watched) {
    std::size_t before = 0;
    for (std::size_t earlier = 0; earlier < b; ++earlier)
        before += blocks_[earlier].changes.watched.size();
    const LargeVector<mesh::TetId>& list = blocks_[b].changes.watched;
    std::copy(list.begin(), list.end(), watched.begin() + static_cast<std::ptrdiff_t>(before));
    for (const mesh::VertexId v : blocks_[b].dated) complex_.raise_date(v, other_date(v));
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
    take_marks(vertices, workers);
    BlockCounts count = count_items(workers);
    if (!is_new && !is_balanced(count)) {
        make_planes(vertices);
        std::fill(marks_.begin(), marks_.end(), no_leaf);
        find_new_leaves(vertices);
        count = count_items(workers);
    }
    if (!fill_blocks(vertices, count, workers)) return false;
    for (Block& block : blocks_) block.begin();
    return true;
}

// Whether a thread can continue with this block.
bool StarLoop::offers(std::size_t block) const {
    if (blocks_[block].turn.load(std::memory_order_relaxed) == no_turn ||
        blocks_[block].taken.load(std::memory_order_relaxed))
        return false;
    const std::uint64_t wait = blocks_[block].waits_for.load(std::memory_order_relaxed);
    return wait == no_wait ||
           blocks_[wait & 0xffU].turn.load(std::memory_order_relaxed) > wait >> 8U;
}

StarLoop::Offer StarLoop::farthest_behind(const Range& range) const {
    Offer offer;
    std::uint32_t least = no_turn;
    for (std::size_t b = range.begin; b < range.end; ++b) {
        const std::uint32_t turn = blocks_[b].turn.load(std::memory_order_relaxed);
        if (turn == no_turn) continue;
        offer.finished = false;
        if (turn >= least || !offers(b)) continue;
        least = turn;
        offer.block = b;
    }
    return offer;
}

}  // namespace dsc::kernel
