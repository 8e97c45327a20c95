#pragma once
// Performs an action at many vertices, each on its own star, on several threads, and with exactly
// the result of one thread that processes them in the order of the list (method.md, section 10).
//
// The vertices are divided into blocks of space. A thread processes the vertices of a block in the
// order of the list, until it comes to a vertex with a neighbour in another block that is earlier
// in the list and has not been processed. Then the thread continues with the block that is farthest
// behind, in its own part of space if possible. So each vertex sees the star that it would see in
// serial order, and no two threads use the same tet at the same time. The date of a move is that of
// its turn in the list, so it does not depend on the other moves. The change list and the action's
// books follow in the order of the list.

#include <array>
#include <atomic>
#include <cstdint>
#include <span>
#include <thread>
#include <vector>

#include <dsc/base/spin.hpp>
#include <dsc/base/workers.hpp>

#include "kernel/star_block.hpp"

namespace dsc::kernel {

class StarLoop {
public:
    /// Shorter lists run on one thread.
    static constexpr std::size_t least_split = 512;

    explicit StarLoop(mesh::Complex& complex) : complex_(complex) {}

    /// For each vertices[i], which must be alive:
    /// - action.prefetch(i, v): asks the memory for what ready(i) will read; v is vertices[i]
    ///   [parallel]
    /// - action.ready(i, note): false if there is nothing to try [parallel]
    /// - action.attempt(i, scratch, date, note): scratch.star is filled; date is the time of its
    ///   turn; true if the vertex moves to scratch.place, with scratch.qualities [parallel]
    /// - action.settle(i, date, note): in the order of the list; dates of vertices may not be read
    ///   [step]
    /// `note`, of the enumeration Action::Note in one byte, tells settle(i) what the other two have
    /// found. They need no list of their own, to whose lines both threads would write.
    /// The change clock advances by one per vertex, whether it moves or not.
    /// ready() and attempt() may read the star and the date of their vertex, and everything that
    /// neither place() nor settle() of other vertices writes.
    template <class Action>
    void run(std::span<const mesh::VertexId> vertices, Workers* workers, Action& action) {
        start_ = complex_.clock();
        if (workers == nullptr || workers->threads() < 2 || !divide(vertices, *workers)) {
            const auto item = [&](std::size_t i) {
                return Item{vertices[i], static_cast<std::uint32_t>(i), 0, 0};
            };
            for (std::uint32_t i = 0; i < vertices.size(); ++i) {
                prefetch(action, i, vertices.size(), item, blocks_.front().scratch.walk);
                run_one(vertices[i], i, action);
            }
            complex_.advance_clock(date_of(vertices.size()) - 1);
            return;
        }
        {
            // Also after an exception, so that the dates of these turns are in the past.
            struct Advance {
                StarLoop& loop;
                std::size_t turns;
                ~Advance() { loop.complex_.advance_clock(loop.date_of(turns) - 1); }
            } const advance{*this, vertices.size()};
            // A thread prefers the blocks in its part of space, whose data is near its core.
            const std::size_t threads = workers->threads();
            const auto body = [&](std::size_t thread, std::size_t) {
                work(action, {thread * blocks() / threads, (thread + 1) * blocks() / threads});
            };
            workers->for_blocks(threads, 1, body);
        }
        settle(action, *workers);
    }

    /// Forgets all that depends on dates. Between loops. [step]
    void forget_dates() { dates_.clear(); }

private:
    using Item = StarItem;
    using Block = StarBlock;
    static constexpr std::size_t most_blocks = Block::most;
    static constexpr std::uint32_t no_turn = Block::no_turn;
    static constexpr std::uint64_t no_wait = Block::no_wait;
    // The mark of a vertex contains the number of its leaf of the tree plus 1, and a bit that is
    // set if the vertex is known to be inner. A vertex keeps its leaf until the planes are made
    // again, and the bit until its shape changes.
    static constexpr std::uint8_t no_leaf = 0, leaf_bits = 2 * most_blocks - 1, inner_bit = 0x80;
    static_assert(leaf_bits < inner_bit);
    static constexpr std::size_t next = 1, near = 3, far = 6, farther = 12;  // how far ahead the
                                                                             // memory is asked for
                                                                             // data

    // Dates of a vertex that are not after the start of the loop do not count.
    struct Dates {
        std::uint32_t turn = 0;   // of its turn, if it is in the list
        std::uint32_t other = 0;  // of the latest move of a neighbour in another block
    };

    // How many items of a part of the list are in each block, or how many before the part.
    using BlockCounts = std::array<std::size_t, most_blocks>;

    // The room for the changes of this loop on the lists of the complex.
    struct ChangeSpans {
        std::span<mesh::TetId> changed, watched;
    };

    // Blocks that follow each other.
    struct Range {
        std::size_t begin, end;
        bool contains(std::size_t block) const { return begin <= block && block < end; }
    };

    // What a thread that looks for work finds.
    struct Offer {
        std::size_t block = most_blocks;  // most_blocks: none that is not taken and does not wait
        bool finished = true;             // all items have been processed
        bool none() const { return !finished && block == most_blocks; }
    };

    std::uint32_t date_of(std::size_t turn) const {
        return start_ + static_cast<std::uint32_t>(turn) + 1;
    }
    std::size_t blocks() const { return most_blocks >> coarser_; }
    bool divide(std::span<const mesh::VertexId> vertices, Workers& workers);
    void make_planes(std::span<const mesh::VertexId> vertices);
    void split(unsigned node, unsigned level, std::span<Vec3> samples);
    void take_marks(std::span<const mesh::VertexId> vertices, Workers& workers);
    void find_new_leaves(std::span<const mesh::VertexId> vertices);
    BlockCounts count_items(Workers& workers);
    bool fill_blocks(std::span<const mesh::VertexId> vertices, const BlockCounts& count,
                     Workers& workers);
    std::uint8_t leaf_of_new(mesh::VertexId v);
    bool is_balanced(const BlockCounts& count) const;
    std::uint8_t leaf_at(const Vec3& place) const;
    bool offers(std::size_t block) const;
    Offer farthest_behind(const Range& range) const;

    // While threads work, only leaf_in() and is_free() change marks.
    std::uint8_t mark_of(mesh::VertexId v) {
        return std::atomic_ref(complex_.mark(v)).load(std::memory_order_relaxed);
    }
    // The block of a vertex with a leaf.
    std::uint8_t block_of(std::uint8_t mark) const {
        return static_cast<std::uint8_t>(((mark & leaf_bits) - 1) >> coarser_);
    }
    // Whether all neighbours are in the leaf of v. Then the order of the block is enough, and the
    // star of a vertex that is not ready need not be looked at; also, only the thread that has the
    // block writes to v.
    bool is_inner(mesh::VertexId v) { return (mark_of(v) & inner_bit) != 0; }
    // The leaf in the mark of v. A vertex that has none, because it was in no list so far, gets
    // `offered`.
    std::uint8_t leaf_in(mesh::VertexId v, std::uint8_t offered) {
        std::uint8_t leaf = mark_of(v) & leaf_bits;
        if (leaf == no_leaf &&
            std::atomic_ref(complex_.mark(v))
                .compare_exchange_strong(leaf, offered, std::memory_order_relaxed))
            return offered;
        return leaf;
    }
    // Whether the neighbours that come earlier have been processed.
    bool is_free(Block& block, mesh::VertexId v, std::uint32_t turn) {
        const std::uint8_t mark = mark_of(v), own = mark & leaf_bits, own_block = block_of(mark);
        bool inner = true;
        for (const mesh::VertexId w : block.scratch.star.neighbours) {
            const std::uint8_t leaf = leaf_in(w, own);
            if (leaf == own) continue;
            inner = false;
            const std::uint8_t other = block_of(leaf);
            if (other == own_block) continue;
            const std::uint32_t date = dates_[w].turn;
            if (date <= start_ || date >= date_of(turn)) continue;
            const std::uint32_t earlier = date - date_of(0);
            if (block.seen[other] > earlier) continue;
            block.seen[other] = blocks_[other].turn.load(std::memory_order_acquire);
            if (block.seen[other] > earlier) continue;
            block.wait_for(other, earlier);
            return false;
        }
        if (inner) {
            std::atomic_ref(complex_.mark(v))
                .store(static_cast<std::uint8_t>(mark | inner_bit), std::memory_order_relaxed);
        }
        return true;
    }

    // `item(i)` is the i-th of `count` items.
    template <class Action, class ItemAt>
    void prefetch(const Action& action, std::size_t i, std::size_t count, const ItemAt& item,
                  mesh::StarWalk& walk) const {
        if (!complex_.exceeds_caches()) return;
        if (i + farther < count) {
            const Item later = item(i + farther);
            complex_.prefetch_star_entry(later.vertex);
            complex_.prefetch_vertex(later.vertex);
            action.prefetch(later.turn, later.vertex);
        }
        if (i + far < count) complex_.prefetch_star(item(i + far).vertex);
        if (i + near < count) complex_.prefetch_star_tets(item(i + near).vertex);
        // The connectivity stays as it is, so a star can be found ahead of its turn.
        if (i + next < count) {
            if (const mesh::VertexId v = item(i + next).vertex; !complex_.knows_star(v))
                complex_.cached_star(v, walk);
        }
    }

    // Asks the memory for the dates of a vertex that is not known to be inner.
    void prefetch_dates(Block& block) {
        if (!complex_.exceeds_caches() || block.next + near >= block.items.size()) return;
        const mesh::VertexId v = block.items[block.next + near].vertex;
        if (!is_inner(v)) prefetch_line(&dates_[v]);
    }

    template <class Action>
    void run_one(mesh::VertexId v, std::uint32_t i, Action& action) {
        StarScratch& scratch = blocks_.front().scratch;
        typename Action::Note note{};
        const bool ready = action.ready(i, note);
        complex_.advance_clock(date_of(i) - 1);
        if (ready) {
            scratch.star = complex_.cached_star(v, scratch.walk);
            if (action.attempt(i, scratch, date_of(i), note))
                complex_.move(v, scratch.place, scratch.star.tets, scratch.qualities);
        }
        action.settle(i, date_of(i), note);
    }

    // Until all items have been processed. The earliest of the items that are left can always be
    // processed, so threads do not wait for each other without end, and one thread is enough.
    template <class Action>
    void work(Action& action, const Range& preferred) {
        std::size_t wanted = most_blocks;  // the block that the last one waits for
        Offer offer;
        const auto found = [&] {
            offer = farthest_behind(preferred);
            if (offer.block == most_blocks) offer = farthest_behind({0, blocks()});
            return !offer.none();
        };
        while (true) {
            if (preferred.contains(wanted) && offers(wanted)) {
                offer = {wanted, false};
            } else {
                while (!spin_until(found)) std::this_thread::yield();
            }
            if (offer.finished) return;
            Block& block = blocks_[offer.block];
            wanted = block.take() ? run_block(block, action) : most_blocks;
        }
    }

    // Runs a taken block as far as it goes and gives it back. Returns the block that it waits for;
    // most_blocks if none.
    template <class Action>
    std::size_t run_block(Block& block, Action& action) {
        // An exception ends the block, so that nobody waits for it.
        struct Guard {
            Block& block;
            bool normal = false;
            ~Guard() {
                if (!normal) block.next = block.items.size();
                block.publish_turn();
                block.give_back();
            }
        } guard{block};
        while (block.next < block.items.size()) {
            Item& item = block.items[block.next];
            const mesh::VertexId v = item.vertex;
            if (!block.prepared) {
                prefetch(
                    action, block.next, block.items.size(),
                    [&](std::size_t i) { return block.items[i]; }, block.scratch.walk);
                prefetch_dates(block);
            }
            const bool inner = is_inner(v);
            if (!inner) {
                prepare(block, v);
                if (!is_free(block, v, item.turn)) {
                    guard.normal = true;
                    return block.waits_for & 0xffU;
                }
                complex_.raise_date(v, other_date(v));
            }
            item.note = static_cast<std::uint8_t>(run_next(block, item, action));
            item.changes_end = static_cast<std::uint32_t>(block.changes.changed.size());
            block.prepared = false;
            ++block.next;
            // Nobody waits for an inner vertex.
            if (!inner) block.publish_turn();
        }
        guard.normal = true;
        return most_blocks;
    }

    void prepare(Block& block, mesh::VertexId v) {
        if (block.prepared) return;
        block.scratch.star = complex_.cached_star(v, block.scratch.walk);
        block.prepared = true;
    }

    // What follows in the order of the list.
    template <class Action>
    void settle(Action& action, Workers& workers) {
        const ChangeSpans lists = make_room();
        // The books are kept by one thread, as job 0, while others go on.
        workers.for_blocks(1 + most_blocks + parts(), 1, [&](std::size_t begin, std::size_t end) {
            for (std::size_t job = begin; job < end; ++job) {
                if (job == 0)
                    keep_books(action);
                else if (job <= most_blocks)
                    finish_block(job - 1, lists.watched);
                else
                    list_changes(job - 1 - most_blocks, lists.changed);
            }
        });
    }
    template <class Action>
    void keep_books(Action& action) {
        BlockCounts at{};
        for (std::uint32_t turn = 0; turn < marks_.size(); ++turn) {
            const std::size_t b = block_of(marks_[turn]);
            const auto note = static_cast<typename Action::Note>(blocks_[b].items[at[b]++].note);
            action.settle(turn, date_of(turn), note);
        }
    }
    std::size_t parts() const;
    ChangeSpans make_room();
    void list_changes(std::size_t p, std::span<mesh::TetId> list) const;
    void finish_block(std::size_t b, std::span<mesh::TetId> watched);

    template <class Action>
    typename Action::Note run_next(Block& block, const Item& item, Action& action) {
        const mesh::VertexId v = item.vertex;
        StarScratch& scratch = block.scratch;
        typename Action::Note note{};
        if (!action.ready(item.turn, note)) return note;
        prepare(block, v);
        if (!action.attempt(item.turn, scratch, date_of(item.turn), note)) return note;
        complex_.place(v, scratch.place, scratch.star.tets, scratch.qualities);
        date_star(block, v, date_of(item.turn));
        return note;
    }

    void date_star(Block& block, mesh::VertexId v, std::uint32_t date);
    void raise_other_date(Block& block, mesh::VertexId w, std::uint32_t date);
    std::uint32_t other_date(mesh::VertexId v) {
        const std::uint32_t date = std::atomic_ref(dates_[v].other).load(std::memory_order_relaxed);
        return date > start_ ? date : 0;
    }

    mesh::Complex& complex_;
    std::array<Block, most_blocks> blocks_;
    unsigned coarser_ = 0;  // by how many levels the blocks are larger than the leaves of the tree
    unsigned loops_ = 0;    // over lists that were divided
    struct Plane {
        unsigned axis = 0;
        double at = 0.0;
    };
    std::array<Plane, most_blocks> planes_;  // of the tree; node i has the children 2 i and 2 i + 1
    std::vector<Vec3> samples_;
    std::vector<Dates> dates_;               // per vertex
    std::vector<mesh::VertexId> reshaped_;   // since the last division
    LargeVector<std::uint8_t> marks_;        // per turn
    std::vector<BlockCounts> items_before_;  // per part of the list
    std::uint32_t start_ = 0;                // the change clock at the start
};

}  // namespace dsc::kernel
