#include <algorithm>
#include <string>

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

TEST_CASE(
    "a reconstruction is its level's experiment with the named cloud in place of the sample") {
    for (const run::Detail detail : {run::Detail::low, run::Detail::medium, run::Detail::high}) {
        const std::string name(run::detail_name(detail));
        const config::ConfigNode file =
            config::load_yaml(DSC_SOURCE_DIR "/configs/reconstruct/" + name + ".yaml");
        const config::ConfigNode root =
            run::reconstruction_of("/data/cloud.ply", {detail, {"a", "b", "c"}});
        const config::ConfigNode& cloud = root.at("input").at("cloud");
        CHECK(cloud.at("file").as_string() == "/data/cloud.ply");
        CHECK(cloud.find("sample") == nullptr);
        CHECK(cloud.at("columns").size() == 3);
        if (detail != run::Detail::medium)
            CHECK(root.at("initial_mesh").at("detail").as_string() == name);
        // Nothing else differs.
        const config::ConfigNode plain = run::reconstruction_of("/data/cloud.ply", {detail});
        CHECK(plain.at("input").at("cloud").find("columns") == nullptr);
        CHECK(config::to_yaml(plain.with("input", file.at("input"))) == config::to_yaml(file));
        CHECK(config::to_yaml(cloud.at("filters")) ==
              config::to_yaml(file.at("input").at("cloud").at("filters")));
    }
}

TEST_CASE("levels of detail differ in nothing but the number of vertices") {
    const auto text = [](run::Detail detail) {
        std::string yaml = config::to_yaml(run::reconstruction_of("/data/cloud.ply", {detail}));
        for (const std::string word : {"detail: low", "detail: high"}) {
            for (std::size_t at = yaml.find(word); at != std::string::npos; at = yaml.find(word))
                yaml.erase(at, word.size());
        }
        yaml.erase(
            std::remove_if(yaml.begin(), yaml.end(),
                           [](char c) { return c == ' ' || c == '\n' || c == ',' || c == '-'; }),
            yaml.end());
        return yaml;
    };
    CHECK(text(run::Detail::low) == text(run::Detail::medium));
    CHECK(text(run::Detail::high) == text(run::Detail::medium));
}
