#pragma once
// Fenced: the memory for a strategy's output, with a margin on both sides that the strategy must
// not change.

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <span>
#include <vector>

namespace dsc::plugin {

/// `size` entries of `fill` between two margins with the same value. The memory comes from a store
/// per thread, so that later steps allocate nothing; nested strategies get separate memory.
template <class T>
class Fenced {
public:
    Fenced(std::size_t size, const T& fill) : memory_(take()), size_(size) {
        memory_.assign(size + 2 * margin, fill);
        fill_ = fill;
    }
    ~Fenced() { store().push_back(std::move(memory_)); }
    Fenced(const Fenced&) = delete;
    Fenced& operator=(const Fenced&) = delete;

    std::span<T> entries() { return std::span(memory_).subspan(margin, size_); }

    /// Whether the margins are unchanged, bit for bit.
    bool intact() const {
        const auto same = [this](const T& entry) {
            return std::memcmp(&entry, &fill_, sizeof(T)) == 0;
        };
        const auto begin = memory_.begin();
        const auto end = memory_.end();
        constexpr auto width = static_cast<std::ptrdiff_t>(margin);
        return std::all_of(begin, begin + width, same) && std::all_of(end - width, end, same);
    }

private:
    static constexpr std::size_t margin = 16;

    static std::vector<std::vector<T>>& store() {
        thread_local std::vector<std::vector<T>> free;
        return free;
    }
    static std::vector<T> take() {
        if (store().empty()) return {};
        std::vector<T> memory = std::move(store().back());
        store().pop_back();
        return memory;
    }

    std::vector<T> memory_;
    std::size_t size_;
    T fill_;
};

}  // namespace dsc::plugin
