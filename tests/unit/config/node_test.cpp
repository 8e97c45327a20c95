#include <cstdint>
#include <limits>
#include <string>

#include <doctest/doctest.h>

#include "support.hpp"

using dsc::config::ConfigNode;
using dsc::config::NodeType;

namespace {

ConfigNode sample() {
    return ConfigNode::map({{"type", "grid"},
                            {"cells", 30},
                            {"axis", ConfigNode::list({0.0, 0.5, 1.0})},
                            {"inner", ConfigNode::map({{"on", true}, {"none", ConfigNode()}})}});
}

}  // namespace

TEST_CASE("nodes made by code have their types, values and paths") {
    const ConfigNode node = sample();
    CHECK(node.type() == NodeType::map);
    CHECK(node.size() == 4);
    CHECK(node.path().empty());
    CHECK(node.at("type").as_string() == "grid");
    CHECK(node.at("cells").as_integer() == 30);
    CHECK(node.at("cells").as_real() == 30.0);
    CHECK(node.at("axis").at(1).as_real() == 0.5);
    CHECK(node.at("axis").at(1).path() == "axis.1");
    CHECK(node.at("inner").at("on").as_boolean());
    CHECK(node.at("inner").at("on").path() == "inner.on");
    CHECK(node.at("inner").at("none").is_null());
    CHECK_FALSE(node.position().known());
    CHECK(node.position().describe() == "built in");
    CHECK(node.find("nothing") == nullptr);
    CHECK(node.at("cells").find("nothing") == nullptr);
}

TEST_CASE("every integer type converts, too large ones are refused") {
    CHECK(ConfigNode(std::uint8_t{7}).as_integer() == 7);
    CHECK(ConfigNode(std::size_t{7}).is_integer());
    CHECK(ConfigNode(std::numeric_limits<std::int64_t>::min()).as_integer() ==
          std::numeric_limits<std::int64_t>::min());
    CHECK(test::code_of([] { return ConfigNode{std::numeric_limits<std::uint64_t>::max()}; }) ==
          "config.range");
}

TEST_CASE("a real number is an integer only where it is exactly one") {
    CHECK(ConfigNode(1e3).as_integer() == 1000);
    CHECK(test::error_of([] { ConfigNode(1.5).as_integer(); }) ==
          "built in: error: the value is a real number, not an integer\n1 error; nothing was run");
    CHECK(test::code_of([] { ConfigNode(1e17).as_integer(); }) == "config.type");
}

TEST_CASE("a wrong access names the value and its place") {
    const ConfigNode node = test::parse("a:\n  b: [1, x]\n");
    CHECK(test::error_of([&] { node.at("a").at("b").at(1).as_real(); }) ==
          "a.yaml:2:10: error: 'a.b.1' is a string, not a number\n"
          "    2 |   b: [1, x]\n"
          "      |          ^\n"
          "1 error; nothing was run");
    CHECK(test::code_of([&] { node.at("c"); }) == "config.missing");
    CHECK(test::code_of([&] { node.at("a").at("b").at(2); }) == "config.missing");
    CHECK(test::code_of([&] { node.at("a").at("b").at("c"); }) == "config.type");
}

TEST_CASE("changes make a new tree and leave the old one") {
    const ConfigNode old = sample();
    const ConfigNode changed =
        old.with("cells", 40).with("extra", ConfigNode::map({{"deep", 1}})).without("type");
    CHECK(old == sample());
    CHECK(changed.entries()[0].key == "cells");
    CHECK(changed.at("cells").as_integer() == 40);
    CHECK(changed.at("extra").at("deep").path() == "extra.deep");
    CHECK(changed.find("type") == nullptr);
    const ConfigNode list = old.at("axis").with_item(2, 7);
    CHECK(list.at(2).as_integer() == 7);
    CHECK(list.at(2).path() == "axis.2");
    CHECK(test::code_of([&] { list.with_item(3, 1); }) == "config.missing");
    CHECK(test::code_of([&] { list.with("a", 1); }) == "config.type");
    CHECK(ConfigNode().with("a", 1) == ConfigNode::map({{"a", 1}}));
}

TEST_CASE("a tree can be moved to another path") {
    const ConfigNode node = sample().with_path("velocity.curvature");
    CHECK(node.path() == "velocity.curvature");
    CHECK(node.at("inner").at("on").path() == "velocity.curvature.inner.on");
    CHECK(node == sample());
}

TEST_CASE("equality looks at values, their types and their order") {
    CHECK(ConfigNode(1) != ConfigNode(1.0));
    CHECK(ConfigNode("1") != ConfigNode(1));
    CHECK(ConfigNode::map({{"a", 1}, {"b", 2}}) != ConfigNode::map({{"b", 2}, {"a", 1}}));
    CHECK(ConfigNode::list({1, 2}) != ConfigNode::list({1}));
    CHECK(ConfigNode::map() != ConfigNode::list());
    CHECK(ConfigNode() == ConfigNode());
}

TEST_CASE("a map refuses a key twice") {
    CHECK(test::code_of([] { ConfigNode::map({{"a", 1}, {"a", 2}}); }) == "config.duplicate_key");
}
