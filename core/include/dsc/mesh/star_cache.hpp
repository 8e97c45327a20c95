#pragma once
// The stars and neighbours of vertices, stored until the connectivity round the vertex changes, and
// which tet of a star refused a move last.

#include <atomic>
#include <cstdint>
#include <memory>
#include <span>

#include <dsc/base/large_vector.hpp>
#include <dsc/base/prefetch.hpp>

namespace dsc::mesh {

/// One entry per vertex slot; a vertex that nobody asked for takes 16 bytes. Most stars that the
/// kernel asks for have not changed since the last time, because moves and new labels leave the
/// connectivity as it is.
///
/// Several threads may ask for stars and store them at the same time, also those of one vertex; the
/// hints of different vertices are independent of each other. grow() and forget() are for one
/// thread, while no other one uses the cache.
class StarCache {
public:
    StarCache();
    ~StarCache();
    StarCache(StarCache&&) noexcept;
    StarCache& operator=(StarCache&&) noexcept;
    /// A copy of a complex starts with an empty cache of the same size.
    StarCache(const StarCache& other);
    StarCache& operator=(const StarCache& other);

    /// Makes room for this number of vertex slots.
    void grow(std::size_t slots) {
        if (entries_.size() < slots) entries_.resize(slots);
    }

    /// Asks the memory for the entry of a vertex that will be read soon.
    void prefetch(std::uint32_t v) const { prefetch_line(&entries_[v]); }
    /// The same for the ids of an entry that is there already.
    void prefetch_ids(std::uint32_t v) const {
        constexpr std::size_t line = 16;  // ids in a line of the caches
        const Entry& entry = entries_[v];
        const std::size_t tets = known_tets(entry);
        if (tets == 0) return;
        const std::size_t count = tets + entry.neighbours;
        for (std::size_t i = 0; i < count; i += line) prefetch_line(entry.ids + i);
        prefetch_line(entry.ids + count - 1);  // often in one line more
    }

    /// The tets of the star in the order of the walk; empty if they are not known.
    std::span<const std::uint32_t> tets(std::uint32_t v) const {
        const Entry& entry = entries_[v];
        const std::size_t count = known_tets(entry);
        if (count == 0) return {};
        return {entry.ids, count};
    }
    /// The neighbours in ascending birth order; empty if they are not known.
    std::span<const std::uint32_t> neighbours(std::uint32_t v) const {
        const Entry& entry = entries_[v];
        const std::size_t count = known_tets(entry);
        if (count == 0) return {};
        return {entry.ids + count, entry.neighbours};
    }

    /// Stores the tets and the neighbours, which must lie outside the cache. A very large star is
    /// not stored, and neither is one that another thread stores.
    void keep(std::uint32_t v, std::span<const std::uint32_t> tets,
              std::span<const std::uint32_t> neighbours);
    /// The star has changed. Its memory is used again.
    void forget(std::uint32_t v) { entries_[v].tets = entries_[v].neighbours = 0; }

    /// A place in the star that is worth asking first; any number, also after the star has changed.
    std::size_t suspect(std::uint32_t v) const { return entries_[v].suspect; }
    void keep_suspect(std::uint32_t v, std::size_t place) {
        entries_[v].suspect = static_cast<std::uint16_t>(place);
    }

private:
    struct Entry {
        std::uint32_t* ids = nullptr;    // the tets, then the neighbours; belongs to the pool
        mutable std::uint16_t tets = 0;  // 0: not known; written after all others
        std::uint16_t neighbours = 0;
        std::uint16_t capacity = 0;
        std::uint16_t suspect = 0;
    };
    static_assert(sizeof(Entry) == 16);
    static constexpr std::uint16_t being_stored = 0xffff;  // instead of the number of tets
    // How many tets are stored; 0 if none or not yet all. What it finds can be read.
    static std::size_t known_tets(const Entry& entry) {
        const std::uint16_t tets = std::atomic_ref(entry.tets).load(std::memory_order_acquire);
        return tets == being_stored ? 0 : tets;
    }
    class Pool;
    void reserve(Entry& entry, std::size_t wanted);

    LargeVector<Entry> entries_;
    std::unique_ptr<Pool> pool_;
};

}  // namespace dsc::mesh
