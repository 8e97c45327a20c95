// Exact predicates: a floating filter, then integer arithmetic [Shewchuk1997].
#include "dsc/geometry/predicates.hpp"

#include <array>
#include <cmath>

#include <boost/multiprecision/cpp_int.hpp>

namespace dsc::geometry {
namespace {

using Integer = boost::multiprecision::cpp_int;

thread_local std::uint64_t fallbacks = 0;

// A double is mantissa * 2^exponent. With the smallest exponent of all coordinates as the common
// unit, each coordinate becomes an integer, and the determinant has the sign of the integer
// determinant.
template <std::size_t N>
std::array<Integer, N> to_integers(const std::array<double, N>& values) {
    std::array<int, N> exponents{};
    std::array<std::int64_t, N> mantissas{};
    int lowest = std::numeric_limits<int>::max();
    for (std::size_t i = 0; i < N; ++i) {
        int e = 0;
        mantissas[i] = static_cast<std::int64_t>(std::ldexp(std::frexp(values[i], &e), 53));
        exponents[i] = e - 53;
        if (mantissas[i] != 0) lowest = std::min(lowest, exponents[i]);
    }
    std::array<Integer, N> out;
    for (std::size_t i = 0; i < N; ++i) {
        out[i] = mantissas[i];
        if (mantissas[i] != 0) out[i] <<= static_cast<unsigned>(exponents[i] - lowest);
    }
    return out;
}

int sign(const Integer& x) { return x.sign(); }

int orient3d_exact(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
    ++fallbacks;
    const auto v = to_integers<12>(
        {a.x(), a.y(), a.z(), b.x(), b.y(), b.z(), c.x(), c.y(), c.z(), d.x(), d.y(), d.z()});
    const Integer bx = v[3] - v[0], by = v[4] - v[1], bz = v[5] - v[2];
    const Integer cx = v[6] - v[0], cy = v[7] - v[1], cz = v[8] - v[2];
    const Integer dx = v[9] - v[0], dy = v[10] - v[1], dz = v[11] - v[2];
    return sign(
        Integer(bx * (cy * dz - cz * dy) - by * (cx * dz - cz * dx) + bz * (cx * dy - cy * dx)));
}

}  // namespace

// Static filter similar to Shewchuk's stage A [Shewchuk1997]: the permanent times (7 + 56 eps) eps
// bounds the error of the determinant evaluated from rounded differences.
int orient3d(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
    const double bx = b.x() - a.x(), by = b.y() - a.y(), bz = b.z() - a.z();
    const double cx = c.x() - a.x(), cy = c.y() - a.y(), cz = c.z() - a.z();
    const double dx = d.x() - a.x(), dy = d.y() - a.y(), dz = d.z() - a.z();
    const double cydz = cy * dz, czdy = cz * dy;
    const double czdx = cz * dx, cxdz = cx * dz;
    const double cxdy = cx * dy, cydx = cy * dx;
    const double det = bx * (cydz - czdy) + by * (czdx - cxdz) + bz * (cxdy - cydx);
    const double permanent = (std::abs(cydz) + std::abs(czdy)) * std::abs(bx) +
                             (std::abs(czdx) + std::abs(cxdz)) * std::abs(by) +
                             (std::abs(cxdy) + std::abs(cydx)) * std::abs(bz);
    constexpr double epsilon = 0x1p-53;
    constexpr double bound = (7.0 + 56.0 * epsilon) * epsilon;
    // The last term covers products that underflowed.
    const double error = bound * permanent + 0x1p-1020;
    if (det > error) return 1;
    if (det < -error) return -1;
    return orient3d_exact(a, b, c, d);
}

int orient2d(const Vec3& a, const Vec3& b, const Vec3& c, int axis0, int axis1) {
    const double left = (b[axis0] - a[axis0]) * (c[axis1] - a[axis1]);
    const double right = (b[axis1] - a[axis1]) * (c[axis0] - a[axis0]);
    const double det = left - right;
    constexpr double epsilon = 0x1p-53;
    constexpr double bound = (3.0 + 16.0 * epsilon) * epsilon;
    const double error = bound * (std::abs(left) + std::abs(right)) + 0x1p-1020;
    if (det > error) return 1;
    if (det < -error) return -1;
    const auto v = to_integers<6>({a[axis0], a[axis1], b[axis0], b[axis1], c[axis0], c[axis1]});
    return sign(Integer((v[2] - v[0]) * (v[5] - v[1]) - (v[3] - v[1]) * (v[4] - v[0])));
}

std::uint64_t exact_fallbacks() noexcept { return fallbacks; }

}  // namespace dsc::geometry
