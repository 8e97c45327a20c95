#pragma once
// Performs an action at many vertices, each on its own star, on several threads, and with exactly
// the result of one thread that processes them in the order of the list (method.md, section 10).
//
// The vertices are divided into blocks of space. A thread processes the vertices of a block in the
// order of the list, until it comes to a vertex with a neighbour in another block that is earlier
// in the list and has not been processed. Then the thread continues with the block that is farthest
// behind. So each vertex sees the star that it would see in serial order, and no two threads use
// the same tet at the same time. The date of a move is that of its turn in the list, so it does not
// depend on the other moves. The change list and the action's books follow in the order of the
// list.

#include <array>
#include <atomic>
#include <cstdint>
#include <span>
#include <thread>
#include <vector>

#include <dsc/base/workers.hpp>
#include <dsc/mesh/complex.hpp>
#include <dsc/mesh/star_trial.hpp>

namespace dsc::kernel {

/// The visit of one star, for one thread at a time.
struct StarScratch {
    mesh::Star star;
    mesh::StarWalk walk;
    Vec3 place = Vec3::Zero();     // the planned place of the vertex,
    std::vector<float> qualities;  // and the qualities of the star there, in its order
    mesh::StarCopy copy;           // for the trial of places
};

class StarLoop {
public:
    /// Shorter lists run on one thread.
    static constexpr std::size_t least_split = 512;

    explicit StarLoop(mesh::Complex& complex) : complex_(complex) {}

    /// For each vertices[i], which must be alive:
    /// - action.ready(i): false if there is nothing to try [parallel]
    /// - action.attempt(i, scratch): scratch.star is filled, with the neighbours if
    ///   Action::needs_neighbours; true if the vertex moves to scratch.place, with
    ///   scratch.qualities [parallel]
    /// - action.settle(i, attempted, date): in the order of the list; date is the time of its turn
    ///   [step]
    /// The change clock advances by one per vertex, whether it moves or not.
    /// ready() and attempt() may read the star and the date of their vertex, and everything that
    /// neither place() nor settle() of other vertices writes.
    template <class Action>
    void run(std::span<const mesh::VertexId> vertices, Workers* workers, Action& action) {
        start_ = complex_.clock();
        if (workers == nullptr || workers->threads() < 2 || !divide(vertices, *workers)) {
            for (std::uint32_t i = 0; i < vertices.size(); ++i) {
                prefetch(i, vertices.size(), [&](std::size_t at) { return vertices[at]; });
                run_one(vertices[i], i, action);
            }
            complex_.advance_clock(date_of(vertices.size()) - 1);
            return;
        }
        struct Forget {
            StarLoop& loop;
            std::span<const mesh::VertexId> vertices;
            ~Forget() {
                for (const mesh::VertexId v : vertices) loop.turn_of_vertex_[v] = no_turn;
            }
        } const forget{*this, vertices};
        const auto body = [&](std::size_t, std::size_t) { work(vertices, action); };
        workers->for_blocks(workers->threads(), 1, body);
        complex_.advance_clock(date_of(vertices.size()) - 1);
        settle(action);
    }

private:
    static constexpr unsigned most_levels = 4;  // of the tree that divides space
    static constexpr std::size_t most_blocks = std::size_t{1} << most_levels;
    static constexpr std::uint32_t no_turn = 0xffffffffU;
    static constexpr std::uint8_t no_leaf = 0xff;
    static constexpr std::size_t near = 2, far = 6, farther = 12;  // how far ahead the memory is
                                                                   // asked for data

    // A vertex at its turn.
    struct Item {
        std::uint32_t turn;
        std::uint32_t changes = 0;  // how many tets its move put on the list of the block
        bool attempted = false;
    };

    // On cache lines of its own. What a thread finds out about the items lies here, too, so that
    // two threads do not write to one line.
    struct alignas(64) Block {
        std::atomic<std::uint32_t> turn{0};  // of the next item; no_turn after the last one
        std::atomic<bool> taken{false};
        std::size_t next = 0;
        bool prepared = false;                // scratch has the star and the neighbours of the next
        std::vector<Item> items;              // in the order of their turns
        std::vector<mesh::TetId> changed;     // by the moves, in their order
        std::size_t settled = 0, listed = 0;  // how many of both
        StarScratch scratch;

        bool take() { return !taken.exchange(true, std::memory_order_acquire); }
        void give_back() { taken.store(false, std::memory_order_release); }
    };

    // What a thread that looks for work finds.
    struct Offer {
        std::size_t block = most_blocks;  // most_blocks: none that is not taken or refused
        bool finished = true;             // all items have been processed
    };

    std::uint32_t date_of(std::size_t turn) const {
        return start_ + static_cast<std::uint32_t>(turn) + 1;
    }
    bool divide(std::span<const mesh::VertexId> vertices, Workers& workers);
    void make_planes(std::span<const mesh::VertexId> vertices);
    void split(unsigned node, unsigned level, std::span<Vec3> samples);
    void find_blocks(std::span<const mesh::VertexId> vertices, Workers& workers);
    bool is_balanced() const;
    std::uint8_t leaf_at(const Vec3& place) const;
    Offer farthest_behind(std::uint32_t refused) const;

    // Whether all neighbours are known to be in the same leaf as v. Then the order of the block is
    // enough, and the star of a vertex that is not ready need not be looked at.
    bool is_inner(mesh::VertexId v) const {
        return inner_since_[v] != 0 && complex_.shape_date(v) <= inner_since_[v];
    }
    // Whether the neighbours that come earlier have been processed.
    bool is_free(const Block& block, mesh::VertexId v, std::uint32_t turn) {
        const std::uint8_t own = leaf_of_vertex_[v];
        bool inner = true;
        for (const mesh::VertexId w : block.scratch.star.neighbours) {
            const std::uint8_t leaf = leaf_of_vertex_[w];
            if (leaf == own) continue;
            inner = false;
            if (leaf == no_leaf || leaf >> coarser_ == own >> coarser_) continue;
            const Block& other = blocks_[leaf >> coarser_];
            if (turn_of_vertex_[w] < turn &&
                other.turn.load(std::memory_order_acquire) <= turn_of_vertex_[w])
                return false;
        }
        if (inner) inner_since_[v] = start_;
        return true;
    }

    // `at(i)` is the i-th of `count` vertices.
    template <class At>
    void prefetch(std::size_t i, std::size_t count, const At& at) const {
        if (!complex_.exceeds_caches()) return;
        if (i + farther < count) complex_.prefetch_star_entry(at(i + farther));
        if (i + far < count) complex_.prefetch_star(at(i + far));
        if (i + near < count) complex_.prefetch_star_tets(at(i + near));
    }

    template <class Action>
    void run_one(mesh::VertexId v, std::uint32_t i, Action& action) {
        StarScratch& scratch = blocks_.front().scratch;
        const bool ready = action.ready(i);
        complex_.advance_clock(date_of(i) - 1);
        if (ready) {
            if constexpr (Action::needs_neighbours) {
                scratch.star = complex_.cached_star_and_neighbours(v, scratch.walk);
            } else {
                scratch.star = {complex_.cached_star(v, scratch.walk), {}};
            }
            if (action.attempt(i, scratch))
                complex_.move(v, scratch.place, scratch.star.tets, scratch.qualities);
        }
        action.settle(i, ready, date_of(i));
    }

    // Until all items have been processed. The earliest of the items that are left can always be
    // processed, so threads do not wait for each other without end, and one thread is enough.
    template <class Action>
    void work(std::span<const mesh::VertexId> vertices, Action& action) {
        std::uint32_t refused = 0;  // bits of the blocks that were not free
        for (Offer offer = farthest_behind(0); !offer.finished; offer = farthest_behind(refused)) {
            if (offer.block == most_blocks) {
                refused = 0;
                std::this_thread::yield();
                continue;
            }
            Block& block = blocks_[offer.block];
            if (!block.take()) continue;
            const bool some = run_block(block, vertices, action);
            refused = some ? 0 : refused | 1U << offer.block;
        }
    }

    // Runs a taken block as far as it goes and gives it back; false if no item was free.
    template <class Action>
    bool run_block(Block& block, std::span<const mesh::VertexId> vertices, Action& action) {
        // An exception ends the block, so that nobody waits for it.
        struct Guard {
            Block& block;
            bool normal = false;
            ~Guard() {
                if (!normal) block.turn.store(no_turn, std::memory_order_release);
                block.give_back();
            }
        } guard{block};
        const std::size_t first = block.next;
        while (block.turn.load(std::memory_order_relaxed) != no_turn) {
            Item& item = block.items[block.next];
            const mesh::VertexId v = vertices[item.turn];
            if (!block.prepared) {
                prefetch(block.next, block.items.size(),
                         [&](std::size_t at) { return vertices[block.items[at].turn]; });
            }
            if (!is_inner(v)) {
                prepare(block, v);
                if (!is_free(block, v, item.turn)) break;
            }
            run_next(block, v, item, action);
            block.prepared = false;
            ++block.next;
            block.turn.store(
                block.next < block.items.size() ? block.items[block.next].turn : no_turn,
                std::memory_order_release);
        }
        guard.normal = true;
        return block.next > first;
    }

    void prepare(Block& block, mesh::VertexId v) {
        if (block.prepared) return;
        block.scratch.star = complex_.cached_star_and_neighbours(v, block.scratch.walk);
        block.prepared = true;
    }

    // What follows in the order of the list.
    template <class Action>
    void settle(Action& action) {
        for (std::uint32_t turn = 0; turn < block_of_.size(); ++turn) {
            Block& block = blocks_[block_of_[turn]];
            const Item& item = block.items[block.settled++];
            complex_.add_changes(std::span(block.changed).subspan(block.listed, item.changes));
            block.listed += item.changes;
            action.settle(turn, item.attempted, date_of(turn));
        }
    }

    template <class Action>
    void run_next(Block& block, mesh::VertexId v, Item& item, Action& action) {
        StarScratch& scratch = block.scratch;
        if (!action.ready(item.turn)) return;
        item.attempted = true;
        prepare(block, v);
        if (!action.attempt(item.turn, scratch)) return;
        complex_.place(v, scratch.place, scratch.star.tets, scratch.qualities);
        const std::size_t before = block.changed.size();
        complex_.date_move(v, scratch.star, date_of(item.turn), block.changed);
        item.changes = static_cast<std::uint32_t>(block.changed.size() - before);
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
    // Per vertex: the leaf of the tree in which it was first; no_leaf if it was in no list since
    // the planes were made. It need not be the leaf where the vertex is now.
    std::vector<std::uint8_t> leaf_of_vertex_;
    std::vector<std::uint32_t> inner_since_;     // per vertex: a time at which it was inner, or 0
    std::vector<std::uint32_t> turn_of_vertex_;  // no_turn if it is not in the list
    std::vector<std::uint8_t> block_of_;         // per turn
    std::uint32_t start_ = 0;                    // the change clock at the start
};

}  // namespace dsc::kernel
