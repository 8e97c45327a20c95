// The inner loops of the winding field. Compiled with -fno-math-errno, so that eight square roots
// are computed at once; nothing else depends on this flag.
#include "winding_kernels.hpp"

#include <cmath>
#include <cstring>

#if defined(__x86_64__)
#define DSC_HAS_WIDE_LOOPS 1
#define DSC_WIDE __attribute__((target("avx2")))
#endif
#define DSC_INLINE inline __attribute__((always_inline))

namespace dsc::cloud {

namespace {

// A vector type of g++ and clang. The functions that pass it are always inlined, so its calling
// convention has no effect.
using Lanes = float __attribute__((vector_size(winding_lanes * sizeof(float))));

DSC_INLINE Lanes load(const float* from) {
    Lanes value;
    std::memcpy(&value, from, sizeof(value));
    return value;
}

DSC_INLINE Lanes square_root(Lanes square) {
    Lanes root;
    for (std::size_t lane = 0; lane < winding_lanes; ++lane) root[lane] = std::sqrt(square[lane]);
    return root;
}

DSC_INLINE float add_up(Lanes sum) {
    return ((sum[0] + sum[4]) + (sum[2] + sum[6])) + ((sum[1] + sum[5]) + (sum[3] + sum[7]));
}

/// The common terms of all three sums, for the sources k..k+7.
struct Terms {
    Lanes dx, dy, dz;
    Lanes inverse_square, inverse_cube;  ///< 1 / rho^2, 1 / rho^3
};

DSC_INLINE Terms terms(const WindingSources& sources, const WindingTarget& target, std::size_t k) {
    Terms t;
    t.dx = load(sources[0] + k) - target.x;
    t.dy = load(sources[1] + k) - target.y;
    t.dz = load(sources[2] + k) - target.z;
    const Lanes square =
        t.dx * t.dx + t.dy * t.dy + t.dz * t.dz + (load(sources[3] + k) + target.half_square);
    t.inverse_square = 1.0F / square;
    t.inverse_cube = t.inverse_square * square_root(t.inverse_square);
    return t;
}

DSC_INLINE float winding_loop(const WindingSources& sources, const WindingTarget& target) {
    Lanes sum{};
    for (std::size_t k = 0; k < sources.count(); k += winding_lanes) {
        const Terms t = terms(sources, target, k);
        sum += (load(sources[4] + k) * t.dx + load(sources[5] + k) * t.dy +
                load(sources[6] + k) * t.dz) *
               t.inverse_cube;
    }
    return add_up(sum);
}

DSC_INLINE std::array<float, 3> adjoint_loop(const WindingSources& sources,
                                             const WindingTarget& target) {
    Lanes x{}, y{}, z{};
    for (std::size_t k = 0; k < sources.count(); k += winding_lanes) {
        const Terms t = terms(sources, target, k);
        const Lanes strength = load(sources[4] + k) * t.inverse_cube;
        x -= strength * t.dx;
        y -= strength * t.dy;
        z -= strength * t.dz;
    }
    return {add_up(x), add_up(y), add_up(z)};
}

DSC_INLINE std::array<float, 3> gradient_loop(const WindingSources& sources,
                                              const WindingTarget& target) {
    Lanes x{}, y{}, z{};
    for (std::size_t k = 0; k < sources.count(); k += winding_lanes) {
        const Terms t = terms(sources, target, k);
        const Lanes a = load(sources[4] + k), b = load(sources[5] + k), c = load(sources[6] + k);
        const Lanes along = 3.0F * (a * t.dx + b * t.dy + c * t.dz) * t.inverse_square;
        x += (a - along * t.dx) * t.inverse_cube;
        y += (b - along * t.dy) * t.inverse_cube;
        z += (c - along * t.dz) * t.inverse_cube;
    }
    return {add_up(x), add_up(y), add_up(z)};
}

#ifdef DSC_HAS_WIDE_LOOPS
// Not target_clones, because their resolver runs before the sanitizers are ready.
DSC_WIDE float wide_winding(const WindingSources& s, const WindingTarget& t) {
    return winding_loop(s, t);
}
DSC_WIDE std::array<float, 3> wide_adjoint(const WindingSources& s, const WindingTarget& t) {
    return adjoint_loop(s, t);
}
DSC_WIDE std::array<float, 3> wide_gradient(const WindingSources& s, const WindingTarget& t) {
    return gradient_loop(s, t);
}

bool wide() {
    static const bool answer = __builtin_cpu_supports("avx2") != 0;
    return answer;
}
#endif

}  // namespace

void WindingSources::resize(std::size_t count) {
    count_ = (count + winding_lanes - 1) / winding_lanes * winding_lanes;
    if (count_ > stride_) {
        // Not a power of two, because columns that begin at the same cache position would displace
        // each other.
        stride_ = 2 * count_ + 3 * winding_lanes;
        values_.assign(winding_quantities * stride_, 0.0F);
    }
    for (std::size_t q = 0; q < winding_quantities; ++q)
        for (std::size_t n = count; n < count_; ++n) column(q)[n] = q == 3 ? 1.0F : 0.0F;
}

float sum_winding(const WindingSources& sources, const WindingTarget& target) {
#ifdef DSC_HAS_WIDE_LOOPS
    if (wide()) return wide_winding(sources, target);
#endif
    return winding_loop(sources, target);
}

std::array<float, 3> sum_adjoint(const WindingSources& sources, const WindingTarget& target) {
#ifdef DSC_HAS_WIDE_LOOPS
    if (wide()) return wide_adjoint(sources, target);
#endif
    return adjoint_loop(sources, target);
}

std::array<float, 3> sum_gradient(const WindingSources& sources, const WindingTarget& target) {
#ifdef DSC_HAS_WIDE_LOOPS
    if (wide()) return wide_gradient(sources, target);
#endif
    return gradient_loop(sources, target);
}

}  // namespace dsc::cloud
