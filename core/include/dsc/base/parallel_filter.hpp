#pragma once
// Chooses entries of a list on several threads. The chosen entries keep their order.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include <dsc/base/workers.hpp>

namespace dsc {

/// Reuse one object: then nothing is allocated after its arrays have grown. `workers` is null for
/// one thread, which asks in the order of the list.
class ParallelFilter {
public:
    /// Removes the entries for which keep(i, entry) is false, which is asked once per
    /// entry [parallel].
    template <class T, class Keep>
    void keep_if(Workers* workers, std::vector<T>& list, const Keep& keep) {
        kept_.resize((list.size() + block - 1) / block);
        struct Job {
            T* list;
            std::size_t* kept;
            const Keep& keep;
        } const job{list.data(), kept_.data(), keep};
        for_blocks(workers, list.size(), block, [&job](std::size_t begin, std::size_t end) {
            std::size_t at = begin;
            for (std::size_t i = begin; i < end; ++i) {
                const T entry = job.list[i];
                job.list[at] = entry;
                at += job.keep(i, entry) ? 1 : 0;
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

    /// Appends the entries of `from` for which keep(i, entry) is true to `to`.
    template <class T, class Keep>
    void append_if(Workers* workers, std::span<const T> from, std::vector<T>& to,
                   const Keep& keep) {
        if (workers == nullptr || workers->threads() < 2) {
            for (std::size_t i = 0; i < from.size(); ++i) {
                if (keep(i, from[i])) to.push_back(from[i]);
            }
            return;
        }
        for (std::size_t start = 0; start < from.size(); start += part) {
            append_part(workers, from.subspan(start, std::min(part, from.size() - start)), to,
                        [&keep, start](std::size_t i, T entry) { return keep(start + i, entry); });
        }
    }

private:
    static constexpr std::size_t block = 4096;       // entries
    static constexpr std::size_t part = 64 * block;  // of a list, so that the flags take little room

    template <class T, class Keep>
    void append_part(Workers* workers, std::span<const T> from, std::vector<T>& to,
                     const Keep& keep) {
        kept_.resize((from.size() + block - 1) / block);
        flags_.resize(from.size());
        struct Job {
            std::span<const T> from;
            std::uint8_t* flags;
            std::size_t* kept;
            const Keep& keep;
            T* to = nullptr;
        } job{from, flags_.data(), kept_.data(), keep};
        for_blocks(workers, from.size(), block, [&job](std::size_t begin, std::size_t end) {
            std::size_t count = 0;
            for (std::size_t i = begin; i < end; ++i) {
                job.flags[i] = job.keep(i, job.from[i]) ? 1 : 0;
                count += job.flags[i];
            }
            job.kept[begin / block] = count;
        });
        // Now the place of each block is known.
        std::size_t total = to.size();
        for (std::size_t& kept : kept_) total += std::exchange(kept, total);
        to.resize(total);
        job.to = to.data();
        for_blocks(workers, from.size(), block, [&job](std::size_t begin, std::size_t end) {
            T* at = job.to + job.kept[begin / block];
            for (std::size_t i = begin; i < end; ++i) {
                if (job.flags[i] != 0) *at++ = job.from[i];
            }
        });
    }

    std::vector<std::size_t> kept_;    // per block: their number, then their place
    std::vector<std::uint8_t> flags_;  // per entry of a part
};

}  // namespace dsc
