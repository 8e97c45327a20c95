#include <doctest/doctest.h>

#include <dsc/config/yaml.hpp>
#include <dsc/run/reconstruct.hpp>

using namespace dsc;

TEST_CASE("levels of detail have names") {
    for (const run::Detail detail : {run::Detail::low, run::Detail::medium, run::Detail::high}) {
        CHECK(run::detail_from_name(run::detail_name(detail)) == detail);
    }
    CHECK(run::detail_name(run::Detail::high) == "high");
    CHECK_FALSE(run::detail_from_name("ultra").has_value());
}

TEST_CASE("a reconstruction is the file's experiment with the named cloud in place of the sample") {
    const config::ConfigNode file = config::load_yaml(DSC_SOURCE_DIR "/configs/reconstruct/default.yaml");
    const config::ConfigNode root = run::reconstruction_of("/data/cloud.ply", {run::Detail::low, {"a", "b", "c"}});
    const config::ConfigNode& cloud = root.at("input").at("cloud");
    CHECK(cloud.at("file").as_string() == "/data/cloud.ply");
    CHECK(cloud.find("sample") == nullptr);
    CHECK(cloud.at("columns").size() == 3);
    CHECK(root.at("initial_mesh").at("detail").as_string() == "low");
    // Nothing else differs.
    const config::ConfigNode plain = run::reconstruction_of("/data/cloud.ply");
    CHECK(plain.at("input").at("cloud").find("columns") == nullptr);
    config::ConfigNode back = plain.with("initial_mesh", file.at("initial_mesh")).with("input", file.at("input"));
    CHECK(config::to_yaml(back) == config::to_yaml(file));
    CHECK(config::to_yaml(cloud.at("filters")) == config::to_yaml(file.at("input").at("cloud").at("filters")));
}
