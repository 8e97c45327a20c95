// Stores the stars and neighbours of vertices in blocks of a few sizes, which are used again.
#include "dsc/mesh/star_cache.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <mutex>
#include <utility>

namespace dsc::mesh {
namespace {

constexpr std::size_t most_tets = 16384;    // larger stars are walked each time
constexpr std::size_t least_chunk = 16384;  // ids; the chunks grow
constexpr std::size_t largest_chunk = large_page / sizeof(std::uint32_t);
constexpr std::size_t small_step = 4;       // between the sizes of small blocks, in ids
constexpr std::size_t largest_small = 128;  // larger blocks have powers of two
constexpr std::size_t small_sizes = largest_small / small_step;

std::size_t block_size(std::size_t wanted) {
    return wanted <= largest_small ? (wanted + small_step - 1) / small_step * small_step
                                   : std::bit_ceil(wanted);
}

std::size_t size_class(std::size_t size) {
    return size <= largest_small ? size / small_step - 1
                                 : small_sizes + static_cast<std::size_t>(std::bit_width(size)) -
                                       static_cast<std::size_t>(std::bit_width(largest_small)) - 1;
}

// Blocks of one group of threads. A free block begins with the address of the next one of its size.
class alignas(64) Shelf {
public:
    std::uint32_t* exchange(std::uint32_t* old, std::size_t old_size, std::size_t size) {
        const std::lock_guard lock(mutex_);
        if (old != nullptr) {
            std::uint32_t*& free = free_[size_class(old_size)];
            std::memcpy(old, &free, sizeof free);
            free = old;
        }
        std::uint32_t*& free = free_[size_class(size)];
        if (std::uint32_t* const block = free; block != nullptr) {
            std::memcpy(&free, block, sizeof free);
            return block;
        }
        if (left_ < size) {
            left_ = std::max(std::clamp(total_, least_chunk, largest_chunk), size);
            total_ += left_;
            next_ = chunks_.emplace_back(left_).data();
        }
        left_ -= size;
        return std::exchange(next_, next_ + size);
    }

private:
    std::mutex mutex_;
    std::vector<LargeVector<std::uint32_t>> chunks_;
    std::uint32_t* next_ = nullptr;  // in the last chunk
    std::size_t left_ = 0;           // ids from there on
    std::size_t total_ = 0;          // ids in all chunks
    std::array<std::uint32_t*, small_sizes + 16> free_{};
};

constexpr std::size_t shelves = 8;

std::size_t shelf_of_thread() {
    static std::atomic<std::size_t> threads{0};
    thread_local const std::size_t own = threads.fetch_add(1, std::memory_order_relaxed) % shelves;
    return own;
}

}  // namespace

// Several shelves, so that threads rarely wait for each other. A block may go back to another shelf
// than that which it came from.
class StarCache::Pool {
public:
    std::uint32_t* exchange(std::uint32_t* old, std::size_t old_size, std::size_t size) {
        return shelves_[shelf_of_thread()].exchange(old, old_size, size);
    }

private:
    std::array<Shelf, shelves> shelves_;
};

StarCache::StarCache() : pool_(std::make_unique<Pool>()) {}
StarCache::~StarCache() = default;
StarCache::StarCache(StarCache&&) noexcept = default;
StarCache& StarCache::operator=(StarCache&&) noexcept = default;
StarCache::StarCache(const StarCache& other)
    : entries_(other.entries_.size()), pool_(std::make_unique<Pool>()) {}
StarCache& StarCache::operator=(const StarCache& other) {
    if (this != &other) *this = StarCache(other);
    return *this;
}

// Gives the entry room for this number of ids; what it contains is lost.
void StarCache::reserve(Entry& entry, std::size_t wanted) {
    if (entry.capacity >= wanted) return;
    const std::size_t size = block_size(wanted);
    entry.ids = pool_->exchange(entry.ids, entry.capacity, size);
    entry.capacity = static_cast<std::uint16_t>(size);
}

void StarCache::keep(std::uint32_t v, std::span<const std::uint32_t> tets,
                     std::span<const std::uint32_t> neighbours) {
    if (std::max(tets.size(), neighbours.size()) > most_tets) return;
    Entry& entry = entries_[v];
    const std::atomic_ref known(entry.tets);
    std::uint16_t before = 0;
    if (!known.compare_exchange_strong(before, being_stored, std::memory_order_acquire)) return;
    reserve(entry, tets.size() + neighbours.size());
    std::copy(tets.begin(), tets.end(), entry.ids);
    std::copy(neighbours.begin(), neighbours.end(), entry.ids + tets.size());
    entry.neighbours = static_cast<std::uint16_t>(neighbours.size());
    known.store(static_cast<std::uint16_t>(tets.size()), std::memory_order_release);
}

}  // namespace dsc::mesh
