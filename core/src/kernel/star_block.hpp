#pragma once
// A block of the vertices that a star loop processes.

#include <array>
#include <atomic>
#include <cstdint>
#include <vector>

#include <dsc/base/large_vector.hpp>
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

/// A vertex at its turn.
struct StarItem {
    mesh::VertexId vertex;
    std::uint32_t turn;
    std::uint32_t changes_end;  ///< of the changed tets of this and earlier items, in their block
    std::uint8_t note;          ///< of the action
};

/// What all threads read, and what the thread that has the block writes at every vertex, are on
/// cache lines of their own.
struct alignas(64) StarBlock {
    static constexpr std::size_t most = 16;  // blocks of a loop
    static constexpr std::uint32_t no_turn = 0xffffffffU;
    static constexpr std::uint64_t no_wait = ~std::uint64_t{0};

    /// All items before this turn have been processed; no_turn after the last one.
    std::atomic<std::uint32_t> turn{0};
    std::atomic<bool> taken{false};
    std::atomic<std::uint64_t> waits_for{no_wait};  ///< the turn, then 8 bits for the block

    alignas(64) std::size_t next = 0;  ///< item
    bool prepared = false;             ///< scratch has the star and the neighbours of the next
    LargeVector<StarItem> items;       ///< in the order of their turns
    std::array<std::uint32_t, most> seen{};  ///< turns of the blocks, when last read
    mesh::ChangeLists changes;               ///< by the moves, in their order
    std::vector<mesh::VertexId> dated;  ///< vertices of other blocks that a move here has dated
    StarScratch scratch;

    bool take() { return !taken.exchange(true, std::memory_order_acquire); }
    void give_back() { taken.store(false, std::memory_order_release); }
    void publish_turn() {
        turn.store(next < items.size() ? items[next].turn : no_turn, std::memory_order_release);
    }
    /// The next item waits until another block is past this turn. Turns only grow, so a wait that
    /// has ended need not be removed.
    void wait_for(std::uint8_t block, std::uint32_t other_turn) {
        waits_for.store(std::uint64_t{other_turn} << 8U | block, std::memory_order_relaxed);
    }
    /// Before a loop. The items are there already.
    void begin() {
        changes.changed.clear();
        changes.watched.clear();
        dated.clear();
        next = 0;
        prepared = false;
        waits_for = no_wait;
        seen = {};
        publish_turn();
    }
};

}  // namespace dsc::kernel
