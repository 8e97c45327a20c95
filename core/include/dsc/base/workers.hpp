#pragma once
// Threads that work on fixed blocks. The blocks do not depend on the number of threads, and neither
// do the results.

#include <cstddef>
#include <functional>
#include <memory>

namespace dsc {

/// A small pool of worker threads. One loop at a time. [step]
class Workers {
public:
    /// `threads` 0 or 1: everything runs on the calling thread.
    explicit Workers(unsigned threads = 1);
    ~Workers();
    Workers(const Workers&) = delete;
    Workers& operator=(const Workers&) = delete;

    unsigned threads() const noexcept;

    /// Calls body(begin, end) for the blocks [0, block), [block, 2 block), ... of [0, count), in
    /// any order, possibly at the same time. After all blocks have ended it rethrows the exception
    /// of the block with the lowest index.
    void for_blocks(std::size_t count, std::size_t block,
                    const std::function<void(std::size_t, std::size_t)>& body);

private:
    struct Pool;
    std::unique_ptr<Pool> pool_;
};

/// The number of blocks that for_blocks() makes.
constexpr std::size_t block_count(std::size_t count, std::size_t block) {
    return (count + block - 1) / block;
}

/// The same loop with an optional pool: if `workers` is null, it runs on the calling thread.
template <class Body>
void for_blocks(Workers* workers, std::size_t count, std::size_t block, const Body& body) {
    if (workers != nullptr) {
        workers->for_blocks(count, block, body);
        return;
    }
    for (std::size_t begin = 0; begin < count; begin += block)
        body(begin, begin + block < count ? begin + block : count);
}

}  // namespace dsc
