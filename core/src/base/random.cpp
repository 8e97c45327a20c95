// Counter-based random numbers: Philox-4x32-10 [Salmon2011].
#include "dsc/base/random.hpp"

#include <cmath>
#include <numbers>

#include <Random123/philox.h>

namespace dsc {
namespace {

std::array<std::uint32_t, 4> philox(const std::array<std::uint32_t, 4>& counter,
                                    const std::array<std::uint32_t, 2>& key) {
    r123::Philox4x32 generator;
    const r123::Philox4x32::ctr_type c = {{counter[0], counter[1], counter[2], counter[3]}};
    const r123::Philox4x32::key_type k = {{key[0], key[1]}};
    const auto out = generator(c, k);
    return {out[0], out[1], out[2], out[3]};
}

std::uint32_t low(std::uint64_t x) { return static_cast<std::uint32_t>(x); }
std::uint32_t high(std::uint64_t x) { return static_cast<std::uint32_t>(x >> 32U); }

}  // namespace

std::uint64_t stream_id(std::string_view name) {
    std::uint64_t hash = 0xcbf29ce484222325ULL;
    for (const char c : name) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3ULL;
    return hash;
}

// Seed and instance make the key. Step and element are mixed by one Philox round, so that all 256
// bits have an influence and one 32-bit word of the counter remains for the position in the stream.
RandomStream::RandomStream(const RandomKey& key) {
    const auto mixed =
        philox({low(key.step), high(key.step), low(key.instance), high(key.instance)},
               {low(key.seed), high(key.seed)});
    key_ = {mixed[0], mixed[1]};
    counter_ = {0, low(key.element), high(key.element), mixed[2]};
}

RandomStream::result_type RandomStream::operator()() {
    if (used_ == 4) {
        block_ = philox(counter_, key_);
        ++counter_[0];
        used_ = 0;
    }
    return block_[used_++];
}

double RandomStream::uniform() {
    const std::uint64_t a = (*this)() >> 5U;
    const std::uint64_t b = (*this)() >> 6U;
    return (static_cast<double>(a) * 67108864.0 + static_cast<double>(b)) / 9007199254740992.0;
}

std::uint64_t RandomStream::index(std::uint64_t count) {
    return static_cast<std::uint64_t>(uniform() * static_cast<double>(count));
}

double RandomStream::normal() {
    const double radius = std::sqrt(-2.0 * std::log(1.0 - uniform()));
    return radius * std::cos(2.0 * std::numbers::pi * uniform());
}

}  // namespace dsc
