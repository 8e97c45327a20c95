#pragma once
// All triangulations of convex polygons with 3 to 7 corners (1, 2, 5, 14, 42 of them), computed at
// compile time (method.md, section 4.3).

#include <array>
#include <cstddef>
#include <cstdint>

namespace dsc::kernel {

inline constexpr std::size_t max_polygon = 7;

/// Corners i < j < k of a triangle.
struct Corners {
    std::uint8_t i, j, k;
};

/// The triangles of an n-gon, and each triangulation as a set of bits, one bit per triangle.
struct Triangulations {
    std::size_t triangle_count = 0;
    std::array<Corners, 35> triangles{};
    std::size_t count = 0;
    std::array<std::uint64_t, 42> masks{};
};

namespace detail {

constexpr std::size_t triangle_index(const Triangulations& t, std::size_t i, std::size_t j,
                                     std::size_t k) {
    for (std::size_t n = 0; n < t.triangle_count; ++n) {
        if (t.triangles[n].i == i && t.triangles[n].j == j && t.triangles[n].k == k) return n;
    }
    return 0;
}

/// Masks of the chain i..j: the side (i, j) has one triangle with each possible corner between i
/// and j.
struct MaskList {
    std::size_t count = 0;
    std::array<std::uint64_t, 42> masks{};
};
constexpr MaskList chain(const Triangulations& t, std::size_t i, std::size_t j) {
    MaskList out;
    if (j - i < 2) {
        out.count = 1;
        return out;
    }
    for (std::size_t k = i + 1; k < j; ++k) {
        const MaskList left = chain(t, i, k);
        const MaskList right = chain(t, k, j);
        const std::uint64_t own = std::uint64_t{1} << triangle_index(t, i, k, j);
        for (std::size_t a = 0; a < left.count; ++a) {
            for (std::size_t b = 0; b < right.count; ++b)
                out.masks[out.count++] = left.masks[a] | right.masks[b] | own;
        }
    }
    return out;
}

constexpr Triangulations make(std::size_t n) {
    Triangulations t;
    for (std::size_t i = 0; i < n; ++i) {
        for (std::size_t j = i + 1; j < n; ++j) {
            for (std::size_t k = j + 1; k < n; ++k) {
                t.triangles[t.triangle_count++] = {static_cast<std::uint8_t>(i),
                                                   static_cast<std::uint8_t>(j),
                                                   static_cast<std::uint8_t>(k)};
            }
        }
    }
    const MaskList all = chain(t, 0, n - 1);
    t.count = all.count;
    t.masks = all.masks;
    return t;
}

inline constexpr std::array<Triangulations, 5> table = {make(3), make(4), make(5), make(6),
                                                        make(7)};

}  // namespace detail

/// For 3 <= n <= max_polygon.
constexpr const Triangulations& triangulations(std::size_t n) { return detail::table[n - 3]; }

static_assert(triangulations(3).count == 1 && triangulations(4).count == 2 &&
              triangulations(5).count == 5);
static_assert(triangulations(6).count == 14 && triangulations(7).count == 42);

}  // namespace dsc::kernel
