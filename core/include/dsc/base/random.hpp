#pragma once
// Counter-based random numbers: a value depends only on its key and its index, not on the order of
// the calls.

#include <array>
#include <cstdint>
#include <string_view>

namespace dsc {

/// Identifies a stream. Two streams with different keys are independent.
struct RandomKey {
    std::uint64_t seed = 0;      ///< the experiment's seed
    std::uint64_t instance = 0;  ///< hash of the strategy's place in the experiment, see
                                 ///< stream_id()
    std::uint64_t step = 0;
    std::uint64_t element = 0;  ///< birth id of a vertex, index of a sample, ...
};

/// Stable 64-bit id of a name (FNV-1a), for RandomKey::instance.
std::uint64_t stream_id(std::string_view name);

/// Philox-4x32-10 stream [Salmon2011]. Cheap to construct; satisfies UniformRandomBitGenerator.
class RandomStream {
public:
    using result_type = std::uint32_t;

    explicit RandomStream(const RandomKey& key);
    static constexpr result_type min() { return 0; }
    static constexpr result_type max() { return 0xffffffffU; }
    result_type operator()();

    /// Uniform in [0, 1), 53 bits.
    double uniform();
    /// Uniform in [low, high).
    double uniform(double low, double high) { return low + (high - low) * uniform(); }
    /// Uniform integer in [0, count); count > 0.
    std::uint64_t index(std::uint64_t count);
    /// Normal with mean 0 and deviation 1 (Box-Muller).
    double normal();

private:
    std::array<std::uint32_t, 2> key_;
    std::array<std::uint32_t, 4> counter_;
    std::array<std::uint32_t, 4> block_{};
    unsigned used_ = 4;
};

}  // namespace dsc
