#include <cmath>
#include <cstring>
#include <limits>
#include <string>

#include <doctest/doctest.h>

#include <dsc/base/error.hpp>
#include <dsc/base/random.hpp>
#include <dsc/cloud/orientation.hpp>
#include <dsc/cloud/winding_field.hpp>

#include "solids.hpp"

using dsc::Vec3;
using namespace dsc::cloud;
using namespace dsc::cloud::known;

namespace {

void check_sound(const OrientedPoints& found, std::size_t count) {
    REQUIRE(found.normals.size() == count);
    REQUIRE(found.areas.size() == count);
    REQUIRE(found.confidence.size() == count);
    bool sound = true;
    for (std::size_t i = 0; i < count; ++i)
        sound = sound && std::abs(found.normals[i].norm() - 1.0) < 1e-9 &&
                found.areas[i].allFinite() && found.confidence[i] >= 0.0 &&
                found.confidence[i] <= 1.0;
    for (const SurfaceSample& s : found.orientation.samples)
        sound = sound && s.position.allFinite() && s.area.allFinite() && s.width > 0.0;
    CHECK(sound);
    CHECK(std::isfinite(found.orientation.residual));
    CHECK(std::isfinite(found.orientation.noise));
}

double total_area(const OrientedPoints& found) {
    double sum = 0.0;
    for (const Vec3& area : found.areas) sum += area.norm();
    return sum;
}

std::string bytes(const OrientedPoints& found) {
    const auto raw = [](const auto& values) {
        return std::string(reinterpret_cast<const char*>(values.data()),
                           values.size() * sizeof(values[0]));
    };
    return raw(found.normals) + raw(found.areas) + raw(found.confidence) +
           raw(found.orientation.samples) + std::to_string(found.orientation.residual);
}

std::string error_code(const std::vector<Vec3>& points) {
    try {
        orient_points(points);
    } catch (const dsc::GeometryError& error) {
        return error.code();
    }
    return "none";
}

}  // namespace

TEST_CASE("orientation: sphere, torus and cube") {
    const auto check = [](const Solid& solid, double median) {
        const OrientedPoints found = orient_points(solid.points);
        check_sound(found, solid.points.size());
        CHECK(wrong_share(found.normals, solid.normals) == 0.0);
        CHECK(median_error(found.normals, solid.normals) < median);
        // The smoothed field asks for a little more than the area where the surface is curved.
        CHECK(total_area(found) / (solid.area * static_cast<double>(solid.points.size())) ==
              doctest::Approx(1.0).epsilon(0.15));
        CHECK(found.orientation.residual < 0.1);
        CHECK(found.orientation.samples.size() + found.dropped == solid.points.size());
        CHECK(found.orientation.all_points);
    };
    check(sphere(3000), 3.0);
    check(torus(3000), 4.0);
    check(cube(3000), 1.0);
}

TEST_CASE("orientation: the field of its samples distinguishes inside and outside") {
    const Solid solid = torus(4000);
    const WindingField field = winding_field(orient_points(solid.points).orientation.samples);
    const std::vector<Vec3> points{Vec3(1, 0, 0), Vec3(0, -1, 0.1), Vec3(0, 0, 0), Vec3(0, 0, 2),
                                   Vec3(1.7, 0, 0)};
    std::vector<double> w(points.size());
    field.evaluate(points, {}, w);
    CHECK(w[0] > 0.9);
    CHECK(w[1] > 0.9);
    CHECK(w[2] < 0.1);
    CHECK(w[3] < 0.1);
    CHECK(w[4] < 0.1);
}

TEST_CASE("orientation: noise is measured, and outliers lose their say") {
    Solid solid = sphere(6000);
    dsc::RandomStream random({5, 0, 0, 0});
    const double sigma = 0.4 * std::sqrt(solid.area);
    for (std::size_t i = 0; i < solid.points.size(); ++i)
        solid.points[i] += sigma * random.normal() * solid.normals[i];
    solid.points.emplace_back(0.1, 0.2, 0.0);   // deep inside
    solid.points.emplace_back(0.0, -1.6, 0.3);  // far outside
    const OrientedPoints found = orient_points(solid.points);
    check_sound(found, solid.points.size());
    CHECK(wrong_share(std::span(found.normals).first(6000), solid.normals) < 0.004);
    CHECK(found.orientation.noise == doctest::Approx(sigma).epsilon(0.1));
    for (const std::size_t i : {6000UL, 6001UL}) {
        CHECK(found.confidence[i] == 0.0);
        CHECK(found.areas[i].norm() == 0.0);
    }
    CHECK(found.dropped < 200);
}

TEST_CASE("orientation: a large cloud is oriented by the means of its cells") {
    const Solid solid = torus(40000);
    const OrientedPoints found = orient_points(solid.points);
    check_sound(found, solid.points.size());
    CHECK(found.orientation.samples.size() > 15000);
    CHECK(found.orientation.samples.size() < 25000);
    CHECK_FALSE(found.orientation.all_points);
    CHECK(wrong_share(found.normals, solid.normals) == 0.0);
    CHECK(median_error(found.normals, solid.normals) < 3.0);
    CHECK(total_area(found) == doctest::Approx(solid.area * 40000.0).epsilon(0.1));
}

TEST_CASE("orientation: threads, order and repeated points change nothing") {
    const Solid solid = torus(12000);
    const OrientOptions quick{false, 8, 4};
    const OrientedPoints found = orient_points(solid.points, quick);
    CHECK(found.representatives < 12000);
    for (const unsigned threads : {2U, 3U}) {
        dsc::Workers workers(threads);
        CHECK(bytes(orient_points(solid.points, quick, &workers)) == bytes(found));
    }
    // Backwards, and with some points once more.
    std::vector<Vec3> backwards(solid.points.rbegin(), solid.points.rend());
    backwards.insert(backwards.end(), solid.points.begin(), solid.points.begin() + 500);
    const OrientedPoints again = orient_points(backwards, quick);
    bool same = true;
    for (std::size_t i = 0; i < 12000; ++i)
        same = same && again.normals[11999 - i] == found.normals[i];
    for (std::size_t i = 0; i < 500; ++i)
        same = same && again.normals[12000 + i] == found.normals[i] &&
               again.areas[12000 + i] == 0.5 * found.areas[i];
    CHECK(same);
    CHECK(again.orientation.samples.size() == found.orientation.samples.size());
    CHECK(again.orientation.residual == found.orientation.residual);
}

TEST_CASE("orientation: any unit of length, far from the origin") {
    const Solid solid = torus(2000);
    const auto check = [&](double scale, const Vec3& shift) {
        std::vector<Vec3> points(solid.points);
        for (Vec3& p : points) p = scale * p + shift;
        const OrientedPoints found = orient_points(points);
        check_sound(found, points.size());
        CHECK(wrong_share(found.normals, solid.normals) == 0.0);
        CHECK(total_area(found) / (scale * scale * solid.area * 2000.0) ==
              doctest::Approx(1.0).epsilon(0.15));
    };
    check(1e-6, Vec3::Zero());
    check(1e6, Vec3::Zero());
    check(1.0, Vec3(5e6, -5e6, 5e6));
}

TEST_CASE("orientation: clouds without a volume are refused, odd ones give sound results") {
    CHECK(error_code({}) != "none");
    CHECK(error_code({Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0)}) == "cloud.few");
    CHECK(error_code(std::vector<Vec3>(100, Vec3(1, 2, 3))) == "cloud.equal");
    CHECK(error_code({Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(2, 0, 0), Vec3(3, 0, 0), Vec3(5, 0, 0)}) ==
          "cloud.collinear");
    std::vector<Vec3> plane;
    for (int i = 0; i < 100; ++i) plane.emplace_back(i % 10, i / 10, 0.0);
    CHECK(error_code(plane) == "cloud.coplanar");
    CHECK(error_code({Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0),
                      Vec3(0, 0, std::numeric_limits<double>::infinity())}) == "cloud.non_finite");

    plane.emplace_back(5, 5, 3);  // a sheet and one point above it
    check_sound(orient_points(plane), plane.size());
    const std::vector<Vec3> tetrahedron{Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1)};
    check_sound(orient_points(tetrahedron), 4);
    // Most of the points in one small heap.
    std::vector<Vec3> heap = sphere(300).points;
    for (const Vec3& p : sphere(600, 2).points) heap.push_back(Vec3(3, 0, 0) + 1e-9 * p);
    check_sound(orient_points(heap), heap.size());
    std::vector<Vec3> repeated(500, Vec3(0, 0, 0));
    repeated.insert(repeated.end(), tetrahedron.begin(), tetrahedron.end());
    check_sound(orient_points(repeated), repeated.size());
}

TEST_CASE("orientation: stopped on request") {
    dsc::CancelToken cancel;
    cancel.cancel();
    CHECK_THROWS_AS(orient_points(sphere(100).points, {}, nullptr, &cancel), dsc::CancelledError);
}

TEST_CASE("orientation: by normals that are known") {
    for (const std::size_t count : {3000UL, 32000UL}) {
        const Solid solid = cube(count);
        std::vector<Vec3> longer(solid.normals);
        for (Vec3& n : longer) n *= 7.0;
        const OrientedPoints found = orient_by_normals(solid.points, longer);
        check_sound(found, count);
        CHECK(found.normals == solid.normals);
        CHECK(total_area(found) == doctest::Approx(24.0).epsilon(0.15));
        CHECK(found.orientation.residual < 0.15);
        CHECK((found.orientation.samples.size() == count) == (count < 30000));
        std::vector<double> w(2);
        const std::vector<Vec3> points{Vec3(0.5, 0.5, 0.5), Vec3(1.3, 0, 0)};
        winding_field(found.orientation.samples).evaluate(points, {}, w);
        CHECK(std::abs(w[0] - 1.0) < 0.1);
        CHECK(std::abs(w[1]) < 0.1);
    }
    const Solid solid = cube(100);
    CHECK_THROWS_AS(orient_by_normals(solid.points, std::vector<Vec3>(100, Vec3::Zero())),
                    dsc::GeometryError);
    CHECK_THROWS_AS(orient_by_normals(solid.points, std::vector<Vec3>(99, Vec3::UnitX())),
                    dsc::GeometryError);
}
