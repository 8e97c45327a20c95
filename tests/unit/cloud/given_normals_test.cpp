// Whether the normals and the viewpoint of a file are trusted, and what is made of them.
#include <doctest/doctest.h>

#include <dsc/base/random.hpp>
#include <dsc/cloud/given_normals.hpp>

#include "solids.hpp"

using dsc::Vec3;
using namespace dsc::cloud;
using namespace dsc::cloud::known;

namespace {

Cloud cloud_of(const Solid& solid) {
    Cloud cloud;
    cloud.points = solid.points;
    cloud.normals = solid.normals;
    return cloud;
}

bool contains(const std::string& text, std::string_view part) {
    return text.find(part) != std::string::npos;
}

/// Not used, for the reason that has these words.
void check_refused(const Cloud& cloud, std::string_view why) {
    const GivenOrientation given = orient_by_file_normals(cloud);
    CHECK_FALSE(given.oriented.has_value());
    CHECK_MESSAGE(contains(given.note, "The normals of the file are not used, because "),
                  given.note);
    CHECK_MESSAGE(contains(given.note, why), given.note);
}

Vec3 random_direction(dsc::RandomStream& random) {
    return Vec3(random.normal(), random.normal(), random.normal()).normalized();
}

/// The points of a solid that a scanner at `place` sees: those whose normal looks at it and that
/// nothing hides.
template <class Hidden>
Cloud view_of(const Solid& solid, const Vec3& place, const Hidden& hidden) {
    Cloud cloud;
    for (std::size_t i = 0; i < solid.points.size(); ++i) {
        const Vec3 ray = (place - solid.points[i]).normalized();
        if (solid.normals[i].dot(ray) < 0.15 || hidden(solid.points[i])) continue;
        cloud.points.push_back(solid.points[i]);
        cloud.normals.push_back(solid.normals[i]);
    }
    return cloud;
}

}  // namespace

TEST_CASE("given normals: good ones are used, clean or rough, in small clouds and large") {
    for (const Solid& solid : {sphere(2000), torus(3000), cube(3000), torus(40000)}) {
        Cloud cloud = cloud_of(solid);
        const GivenOrientation given = orient_by_file_normals(cloud);
        REQUIRE(given.oriented.has_value());
        CHECK(given.note == "The normals of the file are used.");
        CHECK(wrong_share(given.oriented->normals, solid.normals) == 0.0);
        CHECK(median_error(given.oriented->normals, solid.normals) < 4.0);
        CHECK(given.oriented->orientation.residual < 0.1);
        // Normals that are off by 20 degrees, one in sixty turned over, one in thirty lost.
        dsc::RandomStream random({9, 0, 0, 0});
        for (std::size_t i = 0; i < cloud.normals.size(); ++i) {
            cloud.normals[i] = (cloud.normals[i] + 0.36 * random_direction(random)).normalized();
            if (i % 60 == 7) cloud.normals[i] = -cloud.normals[i];
            if (i % 30 == 9) cloud.normals[i].setZero();
        }
        const GivenOrientation rough = orient_by_file_normals(cloud);
        REQUIRE_MESSAGE(rough.oriented.has_value(), rough.note);
        CHECK(wrong_share(rough.oriented->normals, solid.normals) == 0.0);
        CHECK(median_error(rough.oriented->normals, solid.normals) < 4.0);
    }
}

TEST_CASE("given normals that all point inwards are turned, and that is said") {
    Cloud cloud = cloud_of(torus(3000));
    const std::vector<Vec3> truth = cloud.normals;
    for (Vec3& normal : cloud.normals) normal = -normal;
    const GivenOrientation given = orient_by_file_normals(cloud);
    REQUIRE(given.oriented.has_value());
    CHECK(given.note ==
          "The normals of the file point into the solid; they are used with the opposite sign.");
    CHECK(wrong_share(given.oriented->normals, truth) == 0.0);
}

TEST_CASE("given normals that contradict the points are refused") {
    const Solid solid = torus(3000);
    dsc::RandomStream random({4, 0, 0, 0});
    Cloud cloud = cloud_of(solid);
    for (Vec3& normal : cloud.normals)
        if (random.uniform() < 0.5) normal = -normal;
    check_refused(cloud, " % of neighbouring normals point to opposite sides");
    for (Vec3& normal : cloud.normals) normal = Vec3::UnitZ();
    check_refused(cloud, " % of the flat places they are not perpendicular to the surface");
    for (std::size_t i = 0; i < cloud.normals.size(); ++i)
        cloud.normals[i] = solid.normals[i].unitOrthogonal();
    check_refused(cloud, "at 100 % of the flat places they are not perpendicular to the surface");
    for (std::size_t i = 0; i < cloud.normals.size(); ++i)
        cloud.normals[i] = random_direction(random);
    check_refused(cloud, "they are not perpendicular to the surface");
    cloud = cloud_of(solid);
    for (std::size_t i = 0; i < 600; ++i) cloud.normals[i].setZero();
    check_refused(cloud, "20 % of the points have none");
}

TEST_CASE("given normals whose parts disagree are refused, however few neighbours show it") {
    for (const std::size_t count : {3000UL, 24000UL}) {
        Cloud half = cloud_of(sphere(count));
        for (std::size_t i = 0; i < half.points.size(); ++i)
            if (half.points[i].x() > 0.0) half.normals[i] = -half.normals[i];
        check_refused(half, "together they bound no solid");
    }
    // Two objects, one of them inside out: no neighbours disagree at all.
    Cloud two = cloud_of(sphere(2000));
    const Solid other = sphere(2000, 2);
    for (std::size_t i = 0; i < other.points.size(); ++i) {
        two.points.push_back(other.points[i] + Vec3(5, 0, 0));
        two.normals.push_back(-other.normals[i]);
    }
    check_refused(two, "together they bound no solid");
}

TEST_CASE("given normals: clouds without any are left alone") {
    Cloud cloud = cloud_of(sphere(500));
    cloud.normals.clear();
    const GivenOrientation given = orient_by_file_normals(cloud);
    CHECK_FALSE(given.oriented.has_value());
    CHECK(given.note.empty());
    CHECK(given.figures.empty());
}

TEST_CASE("given normals decide the side of an open surface") {
    // Hilly ground: without normals, nothing distinguishes its upper side from its lower side.
    for (const double sign : {1.0, -1.0}) {
        dsc::RandomStream random({6, 0, 0, 0});
        Cloud cloud;
        for (int i = 0; i < 4000; ++i) {
            const double x = 2.0 * random.uniform() - 1.0, y = 2.0 * random.uniform() - 1.0;
            cloud.points.emplace_back(x, y, 0.1 * std::sin(4.0 * x) * std::cos(3.0 * y));
            const Vec3 up(-0.4 * std::cos(4.0 * x) * std::cos(3.0 * y),
                          0.3 * std::sin(4.0 * x) * std::sin(3.0 * y), 1.0);
            cloud.normals.push_back(sign * up.normalized());
        }
        const GivenOrientation given = orient_by_file_normals(cloud);
        REQUIRE_MESSAGE(given.oriented.has_value(), given.note);
        CHECK(wrong_share(given.oriented->normals, cloud.normals) == 0.0);
    }
}

TEST_CASE("given normals: threads change nothing") {
    const Cloud cloud = cloud_of(torus(12000));
    dsc::Workers workers(3);
    const GivenOrientation one = orient_by_file_normals(cloud),
                           three = orient_by_file_normals(cloud, {}, &workers);
    REQUIRE(one.oriented.has_value());
    CHECK(one.oriented->normals == three.oriented->normals);
    CHECK(one.oriented->areas == three.oriented->areas);
    CHECK(one.figures == three.figures);
}

TEST_CASE("a scanner's place turns the normals of one view towards it") {
    const Vec3 place(0.5, -3.0, 4.0);
    Cloud view = view_of(sphere(8000), place, [](const Vec3&) { return false; });
    view.sensor = Sensor{place, true};
    const GivenOrientation given = orient_by_sensor(view);
    REQUIRE(given.oriented.has_value());
    CHECK(given.note == "Normals point towards the viewpoint 0.5 -3 4 of the file, from which all "
                        "points were seen.");
    CHECK(wrong_share(given.oriented->normals, view.normals) == 0.0);
    // A room seen from inside has no solid round its points, so the winding field cannot use the
    // place.
    Cloud room = cloud_of(sphere(4000));
    room.sensor = Sensor{Vec3(0.1, 0.0, 0.0), true};
    const GivenOrientation inside = orient_by_sensor(room);
    CHECK_FALSE(inside.oriented.has_value());
    CHECK_MESSAGE(contains(inside.note, "of the points would then lie inside or outside"),
                  inside.note);
}

TEST_CASE("a place from which not all points can have been seen is not used") {
    Cloud cloud = cloud_of(sphere(4000));
    cloud.sensor = Sensor{Vec3(0.5, -3.0, 4.0), true};
    const GivenOrientation given = orient_by_sensor(cloud);
    CHECK_FALSE(given.oriented.has_value());
    CHECK_MESSAGE(contains(given.note, "The viewpoint 0.5 -3 4 of the file is not used, because "),
                  given.note);
    // The value that programs write by default needs no word, and is not believed inside of the
    // cloud.
    cloud.sensor = Sensor{Vec3(0.0, 0.0, 0.0), false};
    CHECK_FALSE(orient_by_sensor(cloud).oriented.has_value());
    CHECK(orient_by_sensor(cloud).note.empty());
    Cloud none = cloud_of(sphere(500));
    CHECK_FALSE(orient_by_sensor(none).oriented.has_value());
}

TEST_CASE("a place that may be a default counts where the surface bulges towards it") {
    const Vec3 shift(0.0, 0.0, 5.0);
    Cloud view = view_of(sphere(8000), -shift, [](const Vec3&) { return false; });
    for (Vec3& p : view.points) p += shift;
    view.sensor = Sensor{Vec3::Zero(), false};
    const GivenOrientation given = orient_by_sensor(view);
    REQUIRE(given.oriented.has_value());
    CHECK(wrong_share(given.oriented->normals, view.normals) == 0.0);
    // The far side of the sphere, which was not scanned from there.
    for (Vec3& p : view.points) p.z() = 10.0 - p.z();
    CHECK_FALSE(orient_by_sensor(view).oriented.has_value());
}
