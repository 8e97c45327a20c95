#pragma once
// Removes entries of a list on several threads. The others keep their order.

#include <algorithm>
#include <cstddef>
#include <vector>

#include <dsc/base/workers.hpp>

namespace dsc {

/// Reuse one object: then nothing is allocated after its array has grown. `workers` is null for
/// one thread, which asks in the order of the list.
class ParallelFilter {
public:
    /// Removes the entries for which keep(entry) is false, which is asked once per entry; some
    /// entries before that, fetch(entry) may ask the memory for what keep() will read [parallel].
    template <class T, class Allocator, class Keep, class Fetch>
    void keep_if(Workers* workers, std::vector<T, Allocator>& list, const Keep& keep,
                 const Fetch& fetch) {
        kept_.resize(block_count(list.size(), block));
        struct Job {
            T* list;
            std::size_t* kept;
            const Keep& keep;
            const Fetch& fetch;
        } const job{list.data(), kept_.data(), keep, fetch};
        for_blocks(workers, list.size(), block, [&job](std::size_t begin, std::size_t end) {
            std::size_t at = begin;
            for (std::size_t i = begin; i < end; ++i) {
                if (i + ahead < end) job.fetch(job.list[i + ahead]);
                const T entry = job.list[i];
                job.list[at] = entry;
                at += job.keep(entry) ? 1 : 0;
            }
            job.kept[begin / block] = at - begin;
        });
        // Closes the gaps between the blocks.
        auto end = list.begin();
        for (std::size_t b = 0; b < kept_.size(); ++b) {
            const auto start = list.begin() + static_cast<std::ptrdiff_t>(b * block);
            end = std::copy(start, start + static_cast<std::ptrdiff_t>(kept_[b]), end);
        }
        list.erase(end, list.end());
    }

private:
    static constexpr std::size_t block = 4096, ahead = 16;  // entries
    std::vector<std::size_t> kept_;                         // their number per block
};

}  // namespace dsc
