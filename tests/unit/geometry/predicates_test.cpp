#include <cmath>

#include <boost/multiprecision/cpp_int.hpp>
#include <doctest/doctest.h>

#include <dsc/base/random.hpp>
#include <dsc/geometry/predicates.hpp>

using dsc::Vec3;
using dsc::geometry::orient2d;
using dsc::geometry::orient3d;
using Rational = boost::multiprecision::cpp_rational;

namespace {

int truth(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
    const auto r = [](double x) { return Rational(x); };
    const Rational bx = r(b.x()) - r(a.x()), by = r(b.y()) - r(a.y()), bz = r(b.z()) - r(a.z());
    const Rational cx = r(c.x()) - r(a.x()), cy = r(c.y()) - r(a.y()), cz = r(c.z()) - r(a.z());
    const Rational dx = r(d.x()) - r(a.x()), dy = r(d.y()) - r(a.y()), dz = r(d.z()) - r(a.z());
    const Rational det =
        bx * (cy * dz - cz * dy) - by * (cx * dz - cz * dx) + bz * (cx * dy - cy * dx);
    return det.sign();
}

}  // namespace

TEST_CASE("orientation convention: d above the counter-clockwise triangle abc is positive") {
    CHECK(orient3d({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}) == 1);
    CHECK(orient3d({0, 0, 0}, {0, 1, 0}, {1, 0, 0}, {0, 0, 1}) == -1);
    CHECK(orient3d({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0.3, 0.3, 0}) == 0);
    CHECK(orient2d({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, 0, 1) == 1);
    CHECK(orient2d({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, 1, 0) == -1);
    CHECK(orient2d({0, 0, 5}, {1, 1, 2}, {3, 3, 1}, 0, 1) == 0);
}

TEST_CASE("orient3d agrees with rational arithmetic on points within an ulp of a plane") {
    dsc::RandomStream random(dsc::RandomKey{3, 0, 0, 0});
    const std::uint64_t before = dsc::geometry::exact_fallbacks();
    int zeros = 0;
    for (int i = 0; i < 3000; ++i) {
        const double scale = std::ldexp(1.0, static_cast<int>(random.index(80)) - 40);
        const auto point = [&] {
            return Vec3(random.uniform(-scale, scale), random.uniform(-scale, scale),
                        random.uniform(-scale, scale));
        };
        const Vec3 a = point(), b = point(), c = point();
        const double s = random.uniform(), t = random.uniform();
        Vec3 d = a + s * (b - a) + t * (c - a);
        if (i % 3 == 0) d = a + 0.5 * (b - a);
        if (i % 5 == 0) d[0] = std::nextafter(d[0], scale * 2);
        const int expected = truth(a, b, c, d);
        zeros += expected == 0;
        REQUIRE(orient3d(a, b, c, d) == expected);
        REQUIRE(orient3d(b, a, c, d) == -expected);
        REQUIRE(orient3d(c, d, a, b) == expected);
    }
    CHECK(zeros > 0);
    CHECK(dsc::geometry::exact_fallbacks() - before > 1000);
}

TEST_CASE("orient3d survives underflow and far translations") {
    const double tiny = 1e-110;
    CHECK(orient3d({0, 0, 0}, {tiny, 0, 0}, {0, tiny, 0}, {0, 0, tiny}) == 1);
    const Vec3 far(5e6, -5e6, 5e6);
    const double mm = 1e-3;
    CHECK(orient3d(far, far + Vec3(mm, 0, 0), far + Vec3(0, mm, 0), far + Vec3(0, 0, mm)) == 1);
}
