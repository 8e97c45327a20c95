#pragma once
// A set of numbers with one bit per number. A loop that asks for numbers in no order needs only
// little memory then.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace dsc {

/// A set of numbers below a bound.
class Bits {
public:
    /// Room for the numbers below `bound`; new ones are not in the set.
    void grow(std::size_t bound) { words_.resize(std::max(words_.size(), (bound + 63) / 64), 0); }
    bool contains(std::size_t i) const { return (words_[i / 64] & bit(i)) != 0; }
    void insert(std::size_t i) { words_[i / 64] |= bit(i); }
    void erase(std::size_t i) { words_[i / 64] &= ~bit(i); }

private:
    static std::uint64_t bit(std::size_t i) { return std::uint64_t{1} << i % 64; }
    std::vector<std::uint64_t> words_;
};

}  // namespace dsc
