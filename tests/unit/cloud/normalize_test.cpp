#include <algorithm>
#include <cmath>
#include <limits>

#include <doctest/doctest.h>

#include <dsc/base/random.hpp>
#include <dsc/cloud/normalize.hpp>
#include <dsc/cloud/target.hpp>

#include "files.hpp"

using dsc::Vec3;
using namespace dsc::cloud;

namespace {
/// The refusal of these points, the same with and without normalisation.
std::string refusal(std::vector<Vec3> points) {
    const Cloud cloud{std::move(points), {}, "scan.xyz"};
    const std::string first = test::error_of([&] { normalize(cloud); });
    CHECK(test::error_of([&] {
              keep_coordinates(cloud, {Vec3::Constant(-1e30), Vec3::Constant(1e30)});
          }) == first);
    return first;
}

std::vector<Vec3> random_points(int count, std::uint64_t seed) {
    dsc::RandomStream random({seed, 0, 0, 0});
    std::vector<Vec3> points(static_cast<std::size_t>(count));
    for (Vec3& p : points)
        for (int k = 0; k < 3; ++k) p[k] = random.uniform();
    return points;
}
}  // namespace

TEST_CASE("the normalisation centres the box and scales its largest half-extent") {
    Cloud cloud{random_points(200, 1)};
    for (Vec3& p : cloud.points) p = Vec3(5e6, -3e6, 100) + p.cwiseProduct(Vec3(20, 4, 7));
    for (const double target : {0.9, 1.1, 1.5}) {
        const Normalized result = normalize(cloud, target);
        const dsc::Box3 box = dsc::bounding_box(result.points);
        CHECK(box.centre().norm() < 1e-8);
        CHECK(box.high.x() == box.high.maxCoeff());
        CHECK(box.high.x() == doctest::Approx(target).epsilon(1e-9));
        const Vec3 size = dsc::bounding_box(cloud.points).size();  // uniform: proportions stay
        CHECK(box.size().y() / box.size().x() ==
              doctest::Approx(size.y() / size.x()).epsilon(1e-9));
        CHECK_FALSE(result.transform.identity());
        for (std::size_t i = 0; i < result.points.size(); ++i) {
            CHECK(result.points[i] == result.transform.apply(cloud.points[i]));
            CHECK((result.transform.inverse(result.points[i]) - cloud.points[i]).norm() < 3e-9);
        }
    }
    CHECK(normalize(cloud).points == normalize(cloud, 0.9).points);
}

TEST_CASE("coordinates may stay as they are inside the box") {
    Cloud cloud{random_points(50, 2), {}, "scan.ply"};
    const Normalized result = keep_coordinates(cloud);
    CHECK(result.transform.identity());
    CHECK(result.points == cloud.points);
    cloud.points[7] = Vec3(2, 0, 0);
    cloud.points[9] = Vec3(0, -1.75, 0);
    cloud.points[8] = Vec3(1, 1, 1);
    cloud.points[3] = Vec3(0, 0, 0);
    CHECK(test::error_of([&] { keep_coordinates(cloud); })
              .find("cloud.outside_box 5: scan.ply: cloud outside the box: 2 of 50 points, the "
                    "first is point 7; the cloud spans [0, 2] x [-1.75, 1] x [0, ") == 0);
    CHECK(test::error_of([&] {
              keep_coordinates({{{2, 0, 0}, {0, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {}, "s"});
          }) ==
          "cloud.outside_box 5: s: cloud outside the box: 1 of 4 points, the first is point 0; the "
          "cloud spans [0, 2] x [0, 1] x [0, 1], the box is [-1.5, 1.5] x [-1.5, 1.5] x [-1.5, "
          "1.5]; normalise the cloud (normalize: {scale: 0.9}) or scale it into the box");
}

TEST_CASE("clouds that bound no volume are refused") {
    const std::string remedy = "; a surface needs at least 4 points that do not lie on one plane";
    CHECK(refusal({}) == "cloud.few 5: scan.xyz: the cloud has 0 points" + remedy);
    CHECK(refusal({{1, 2, 3}}) == "cloud.few 5: scan.xyz: the cloud has 1 point" + remedy);
    CHECK(refusal({{1, 2, 3}, {0, 0, 0}, {1, 0, 0}}) ==
          "cloud.few 5: scan.xyz: the cloud has 3 points" + remedy);
    CHECK(refusal(std::vector<Vec3>(5, Vec3(1, 2, 3))) ==
          "cloud.equal 5: scan.xyz: all 5 points are equal (extent 0 x 0 x 0)" + remedy);
    std::vector<Vec3> line;
    for (int i = 0; i < 10; ++i) line.push_back(Vec3(0.1, 0.2, 0.3) * i);
    CHECK(refusal(line) ==
          "cloud.collinear 5: scan.xyz: all 10 points lie on one line (extent 0.9 x 1.8 x 2.7)" +
              remedy);
    std::vector<Vec3> plane = random_points(100, 3);
    for (Vec3& p : plane) p.z() = 2.0;
    plane.push_back({0, 0, 2});
    plane.push_back({1, 1, 2});
    CHECK(refusal(plane) ==
          "cloud.coplanar 5: scan.xyz: all 102 points lie on one plane (extent 1 x 1 x 0)" +
              remedy);
    CHECK(test::error_of([&] { normalize(Cloud{plane}); }).find("cloud.coplanar 5: cloud: all") ==
          0);
    const double missing = std::numeric_limits<double>::quiet_NaN();
    CHECK(refusal({{0, 0, 0}, {1, 0, 0}, {0, missing, 0}, {0, 0, 1}}) ==
          "cloud.non_finite 5: scan.xyz: point 2 has a coordinate that is not finite or above "
          "1e100; remove it");
    CHECK(refusal({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1e200}})
              .find("cloud.non_finite 5: scan.xyz: point 3") == 0);
}

TEST_CASE(
    "flat is what rounding alone may have thickened, wherever it lies and however it is turned") {
    const Eigen::Matrix3d turn =
        (Eigen::AngleAxisd(0.7, Vec3::UnitX()) * Eigen::AngleAxisd(1.1, Vec3::UnitY()))
            .toRotationMatrix();
    for (const Vec3& offset : {Vec3(0, 0, 0), Vec3(1e3, -2e3, 7), Vec3(5e6, 5e6, 5e6)})
        for (const double size : {1.0, 1000.0}) {
            CAPTURE(size);
            for (const double thickness : {0.0, 1e-11, 1e-3}) {
                CAPTURE(thickness);
                std::vector<Vec3> points = random_points(300, 4);
                for (Vec3& p : points)
                    p = offset + turn * (size * Vec3(p.x(), p.y(), p.z() * thickness));
                const std::string outcome = test::error_of([&] { normalize(Cloud{points}); });
                CHECK(outcome.substr(0, 14) == (thickness > 1e-9 ? "no error" : "cloud.coplanar"));
            }
            std::vector<Vec3> line = random_points(300, 5);
            for (Vec3& p : line) p = offset + turn * Vec3(p.x() * size, 0, 0);
            CHECK(test::error_of([&] { normalize(Cloud{line}); }).substr(0, 15) ==
                  "cloud.collinear");
        }
    // Millimetre detail five thousand kilometres out is volume, not rounding.
    std::vector<Vec3> small = random_points(300, 6);
    for (Vec3& p : small) p = Vec3(5e6, 5e6, 5e6) + 0.001 * p;
    CHECK(test::error_of([&] { normalize(Cloud{small}); }) == "no error");
}

TEST_CASE("the scale target is checked") {
    const Cloud cloud{random_points(10, 7), {}, "scan.xyz"};
    CHECK(test::error_of([&] { normalize(cloud, 2.0); }) ==
          "cloud.scale 5: scan.xyz: the normalisation scale is 2; choose one above 0 and at most "
          "1.5, 0.9 by default");
    CHECK(test::error_of([&] { normalize(cloud, 0.0); }).find("cloud.scale 5: ") == 0);
    CHECK(test::error_of([&] { normalize(cloud, std::nan("")); }).find("cloud.scale 5: ") == 0);
}

TEST_CASE("a target cloud has the normalised points, their box and the way back") {
    const Cloud cloud{random_points(100, 8)};
    const Normalized normalized = normalize(cloud);
    const TargetCloud target(normalized);
    const TargetCloud copy = target;
    REQUIRE(copy.size() == 100);
    CHECK(&copy[0] == &target[0]);
    CHECK(copy[42] == normalized.points[42]);
    CHECK(copy.search().nearest(normalized.points[42]).index == 42);
    CHECK(copy.box().high == dsc::bounding_box(normalized.points).high);
    CHECK(copy.transform().scale == normalized.transform.scale);
}

TEST_CASE("attributes come into normalised units: areas with the square of the scale, lengths with "
          "it, directions as they are") {
    Cloud cloud{random_points(60, 5)};
    for (std::size_t i = 0; i < cloud.points.size(); ++i) {
        cloud.points[i] = Vec3(100, -20, 3) + 50.0 * cloud.points[i];
        cloud.normals.push_back(Vec3(1, static_cast<double>(i), 2).normalized());
        cloud.areas.push_back(4.0 * cloud.normals.back());
        cloud.confidence.push_back(static_cast<double>(i) / 60.0);
    }
    cloud.orientation = {{{cloud.points[3], Vec3(0, 8, 0), 3.0}}, 0.125, 0.5, true};
    const TargetCloud target(normalize(cloud));
    const double scale = target.transform().scale;
    REQUIRE(std::abs(scale - 1.0) > 0.1);
    REQUIRE(target.normals().size() == 60);
    REQUIRE(target.areas().size() == 60);
    REQUIRE(target.confidence().size() == 60);
    for (std::size_t i = 0; i < 60; ++i) {
        CHECK(target.normals()[i] == cloud.normals[i]);
        CHECK((target.areas()[i] - scale * scale * cloud.areas[i]).norm() < 1e-15);
        CHECK(target.confidence()[i] == cloud.confidence[i]);
    }
    REQUIRE(target.orientation().samples.size() == 1);
    const SurfaceSample& sample = target.orientation().samples[0];
    CHECK(sample.position == target[3]);
    CHECK((sample.area - Vec3(0, 8 * scale * scale, 0)).norm() < 1e-15);
    CHECK(sample.width == doctest::Approx(3 * scale).epsilon(1e-15));
    CHECK(target.orientation().residual == 0.125);
    CHECK(target.orientation().noise == doctest::Approx(0.5 * scale).epsilon(1e-15));
    CHECK(target.orientation().all_points);

    Cloud damaged = cloud;
    damaged.normals.pop_back();
    CHECK(TargetCloud(normalize(damaged)).normals().empty());
    CHECK(TargetCloud(normalize(Cloud{cloud.points})).orientation().empty());

    // Without normalisation all stays as it is.
    Cloud small{random_points(20, 6)};
    small.areas.assign(20, Vec3(1, 2, 3));
    small.orientation = cloud.orientation;
    const TargetCloud kept(keep_coordinates(small));
    CHECK(kept.areas()[7] == Vec3(1, 2, 3));
    CHECK(kept.orientation().samples[0].position == cloud.points[3]);
}

TEST_CASE("statistics of a target are those of its normalised points, with any number of threads") {
    Cloud cloud{random_points(300, 8)};
    for (Vec3& p : cloud.points) p = Vec3(1000, 0, 0) + 70.0 * p.normalized();
    const TargetCloud target(normalize(cloud));
    dsc::Workers three(3);
    const Statistics direct = measure_cloud(target.points());
    CHECK(target.statistics(&three).point_width == direct.point_width);
    CHECK(&target.statistics() == &TargetCloud(target).statistics());  // measured once
    for (std::size_t i = 0; i < 300; i += 37) {
        CHECK(target.point_width(i) == direct.point_width[i]);
        CHECK(target.label_width(i) == direct.label_width[i]);
    }
    CHECK(target.noise() == direct.noise);
    // Widths are lengths: those in the units of the file, times the scale.
    CHECK(direct.width ==
          doctest::Approx(target.transform().scale * measure_cloud(cloud.points).width)
              .epsilon(1e-9));
}
