#include <doctest/doctest.h>

#include <dsc/base/error.hpp>
#include <dsc/cloud/shapes.hpp>
#include <dsc/run/reconstruct.hpp>

using namespace dsc;

namespace {

config::ConfigNode derive(const cloud::Cloud& cloud, run::Detail detail) {
    return run::derive_experiment("cloud.ply", cloud, detail);
}

}  // namespace

TEST_CASE("levels of detail have names") {
    CHECK(run::detail_from_name("low") == run::Detail::low);
    CHECK(run::detail_from_name("medium") == run::Detail::medium);
    CHECK(run::detail_from_name("high") == run::Detail::high);
    CHECK_FALSE(run::detail_from_name("ultra").has_value());
}

TEST_CASE("a derived experiment names the cloud; more detail means a finer start and more refinements") {
    const cloud::Cloud cloud = cloud::sample_shape("sphere", 60000, 1);
    std::int64_t cells = 0;
    std::size_t items = 0;
    for (const run::Detail detail : {run::Detail::low, run::Detail::medium, run::Detail::high}) {
        const config::ConfigNode root = derive(cloud, detail);
        CHECK(root.at("input").at("cloud").at("file").as_string() == "cloud.ply");
        CHECK(root.at("velocity").at("type").as_string() == "point_cloud");
        CHECK(root.at("initial_mesh").at("cells").as_integer() > cells);
        CHECK(root.at("schedule").size() > items);
        cells = root.at("initial_mesh").at("cells").as_integer();
        items = root.at("schedule").size();
    }
}

TEST_CASE("a sparse cloud gets fewer refinements, wherever it lies and whatever its unit") {
    const auto items = [](std::size_t n, double unit) {
        cloud::Cloud cloud = cloud::sample_shape("torus", n, 1);
        for (Vec3& p : cloud.points) p = unit * p + Vec3(7, 8, 9) * unit * 100;
        return derive(cloud, run::Detail::medium).at("schedule").size();
    };
    CHECK(items(400, 1.0) < items(20000, 1.0));
    CHECK(items(60, 1.0) >= 1);
    CHECK(items(400, 1e-6) == items(400, 1.0));
    CHECK(items(20000, 1e6) == items(20000, 1.0));
}

TEST_CASE("a handful of points: a coarse start, nothing opens between them") {
    const cloud::Cloud cloud = cloud::sample_shape("sphere", 12, 1);
    const config::ConfigNode root = derive(cloud, run::Detail::medium);
    CHECK(root.at("initial_mesh").at("cells").as_integer() == 16);
    CHECK(root.at("schedule").size() == 1);
    CHECK(root.at("improvement").at("topology").at("support").as_real() > 1.0);
    const config::ConfigNode dense = derive(cloud::sample_shape("sphere", 20000, 1), run::Detail::medium);
    CHECK(dense.at("improvement").at("topology").at("support").as_real() == 0.5);
}

TEST_CASE("few points are not filtered for outliers; repeated points do not count") {
    cloud::Cloud cloud = cloud::sample_shape("sphere", 60, 1);
    const auto filters = [&] {
        return derive(cloud, run::Detail::low).at("input").at("cloud").at("filters").size();
    };
    CHECK(filters() == 1);
    const std::vector<Vec3> once = cloud.points;
    for (int i = 0; i < 5; ++i) cloud.points.insert(cloud.points.end(), once.begin(), once.end());
    CHECK(filters() == 1);
    cloud = cloud::sample_shape("sphere", 600, 1);
    CHECK(filters() == 3);
}

TEST_CASE("a cloud without volume has no experiment") {
    cloud::Cloud flat;
    for (int i = 0; i < 20; ++i) flat.points.emplace_back(i % 5, i / 5, 3);
    CHECK_THROWS_AS(derive(flat, run::Detail::low), GeometryError);
}
