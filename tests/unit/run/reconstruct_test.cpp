#include <doctest/doctest.h>

#include <dsc/base/error.hpp>
#include <dsc/cloud/shapes.hpp>
#include <dsc/run/reconstruct.hpp>

using namespace dsc;

TEST_CASE("levels of detail have names") {
    CHECK(run::detail_from_name("low") == run::Detail::low);
    CHECK(run::detail_from_name("medium") == run::Detail::medium);
    CHECK(run::detail_from_name("high") == run::Detail::high);
    CHECK_FALSE(run::detail_from_name("ultra").has_value());
}

TEST_CASE("a derived experiment names the cloud; more detail means a finer start") {
    const cloud::Cloud cloud = cloud::sample_shape("sphere", 2000, 1);
    std::int64_t cells = 0;
    for (const run::Detail detail : {run::Detail::low, run::Detail::medium, run::Detail::high}) {
        const config::ConfigNode root = run::derive_experiment("cloud.ply", cloud, detail);
        CHECK(root.at("input").at("cloud").at("file").as_string() == "cloud.ply");
        CHECK(root.at("velocity").at("type").as_string() == "point_cloud");
        CHECK(root.at("initial_mesh").at("cells").as_integer() > cells);
        cells = root.at("initial_mesh").at("cells").as_integer();
    }
}

TEST_CASE("a cloud without volume has no experiment") {
    cloud::Cloud flat;
    for (int i = 0; i < 20; ++i) flat.points.emplace_back(i % 5, i / 5, 3);
    CHECK_THROWS_AS(run::derive_experiment("flat.xyz", flat, run::Detail::low), GeometryError);
}
