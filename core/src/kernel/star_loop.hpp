#pragma once
// Performs an action at many vertices, each on its own star. Stars that cannot meet are processed
// in parallel; the result depends only on the complex and the list, never on the number of threads
// (method.md, section 10).
//
// Long lists are split into blocks of space, along the Z-order of a coarse grid. Blocks run at the
// same time; each processes its own vertices in the order of the list. A vertex whose star contains
// a vertex of another block waits and runs after all blocks, in the order of the list. So no two
// threads write to the same tet, and no thread reads what another one writes. Short lists run in
// their order without blocks.

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <dsc/base/workers.hpp>
#include <dsc/mesh/complex.hpp>

namespace dsc::kernel {

/// Arrays for the visit of one star; one per thread.
struct StarScratch {
    std::vector<mesh::TetId> star;
    mesh::TetIndex walk;  // for cached_star() and cached_neighbours()
    std::vector<mesh::VertexId> neighbours;
    Vec3 place = Vec3::Zero();     // the planned place of the vertex,
    std::vector<float> qualities;  // and the qualities of the star there, in its order
};

class StarLoop {
public:
    /// Shorter lists are not split.
    static constexpr std::size_t least_split = 16384;

    explicit StarLoop(mesh::Complex& complex) : complex_(complex) {}

    /// For each vertices[i], which must be alive:
    /// - action.ready(i): false if there is nothing to try; reads nothing that Complex::place()
    ///   writes [parallel]
    /// - action.attempt(i, scratch): scratch.star is filled; true if the vertex moves to
    ///   scratch.place, with scratch.qualities [parallel]
    /// - action.settle(i, attempted, date): once, after all of these; date is the change clock at
    ///   its turn [step]
    template <class Action>
    void run(std::span<const mesh::VertexId> vertices, Workers* workers, Action& action) {
        if (vertices.size() < least_split) {
            for (std::uint32_t i = 0; i < vertices.size(); ++i) run_one(vertices[i], i, action);
            return;
        }
        split(vertices);
        for (wave_ = 0; wave_ < block_count_; wave_ += blocks_.size()) {
            const std::size_t count = std::min(blocks_.size(), block_count_ - wave_);
            struct Job {
                std::span<const mesh::VertexId> vertices;
                Action& action;
            } const job{vertices, action};
            const auto body = [this, &job](std::size_t begin, std::size_t end) {
                for (std::size_t b = begin; b < end; ++b) run_block(b, job.vertices, job.action);
            };
            for_blocks(workers, count, 1, body);
            settle_wave(count, workers, action);
        }
        join(vertices);
        for (const std::uint32_t i : waiting_) run_one(vertices[i], i, action);
    }

private:
    static constexpr std::size_t most_blocks = 64;
    static constexpr std::size_t least_block = 2048;  // vertices
    static constexpr std::uint8_t no_block = 0xff;

    struct Entry {
        std::uint32_t i;
        mesh::VertexId vertex;
        std::uint32_t star_size;  // 0: not moved
        bool attempted;
    };
    struct Block {
        StarScratch scratch;
        std::vector<Entry> entries;
        std::vector<mesh::TetId> stars;  // stars of the moved vertices, one after the other
        std::uint32_t moved = 0;
        std::uint32_t clock = 0;  // before the first of these moves
        std::vector<mesh::TetId> changed;
        std::vector<std::uint32_t> waiting;
    };

    void split(std::span<const mesh::VertexId> vertices);
    void join(std::span<const mesh::VertexId> vertices);
    bool meets_another(std::span<const mesh::VertexId> neighbours, std::uint8_t block) const;

    template <class Action>
    void run_one(mesh::VertexId v, std::uint32_t i, Action& action) {
        StarScratch& scratch = blocks_.front().scratch;
        const bool ready = action.ready(i);
        if (ready) {
            complex_.cached_star(v, scratch.star, scratch.walk);
            if (action.attempt(i, scratch))
                complex_.move(v, scratch.place, scratch.star, scratch.qualities);
        }
        action.settle(i, ready, complex_.clock());
    }

    template <class Action>
    void run_block(std::size_t slot, std::span<const mesh::VertexId> vertices, Action& action) {
        Block& block = blocks_[slot];
        const std::size_t b = wave_ + slot;
        StarScratch& scratch = block.scratch;
        block.entries.clear();
        block.stars.clear();
        block.moved = 0;
        for (std::size_t at = begins_[b]; at < begins_[b + 1]; ++at) {
            const std::uint32_t i = order_[at];
            const mesh::VertexId v = vertices[i];
            Entry entry{i, v, 0, action.ready(i)};
            if (entry.attempted) {
                complex_.cached_star(v, scratch.star, scratch.walk);
                complex_.cached_neighbours(v, scratch.star, scratch.neighbours, scratch.walk);
                if (meets_another(scratch.neighbours, static_cast<std::uint8_t>(b))) {
                    block.waiting.push_back(i);
                    continue;
                }
                if (action.attempt(i, scratch)) {
                    complex_.place(v, scratch.place, scratch.star, scratch.qualities);
                    block.stars.insert(block.stars.end(), scratch.star.begin(), scratch.star.end());
                    entry.star_size = static_cast<std::uint32_t>(scratch.star.size());
                    ++block.moved;
                }
            }
            block.entries.push_back(entry);
        }
    }

    template <class Action>
    void settle_wave(std::size_t count, Workers* workers, Action& action) {
        date_wave(count, workers);
        for (std::size_t b = 0; b < count; ++b) {
            std::uint32_t clock = blocks_[b].clock;
            for (const Entry& entry : blocks_[b].entries) {
                if (entry.star_size > 0) ++clock;
                action.settle(entry.i, entry.attempted, clock);
            }
        }
    }
    void date_wave(std::size_t count, Workers* workers);

    mesh::Complex& complex_;
    std::array<Block, 8> blocks_;  // one wave of blocks, so that few stars are stored at a time
    std::size_t block_count_ = 0;
    std::size_t wave_ = 0;                // first block of the wave
    std::vector<std::uint8_t> block_of_;  // per vertex: its block; no_block if it is not in the
                                          // list
    std::vector<std::uint32_t> order_;    // the list by block
    std::array<std::size_t, most_blocks + 1> begins_{};
    std::vector<std::uint32_t> waiting_;
    std::vector<std::uint16_t> cells_;  // per entry of the list
    std::vector<std::uint32_t> cell_sizes_;
};

}  // namespace dsc::kernel
