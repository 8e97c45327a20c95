#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include <dsc/base/random.hpp>

#include "support.hpp"

using dsc::config::ConfigNode;
using dsc::config::to_yaml;
using test::parse;

namespace {

ConfigNode read_back(const ConfigNode& node) {
    // Without any variable: what looks like one must have been escaped.
    return dsc::config::parse_yaml(to_yaml(node), "b.yaml", test::with_variables({}));
}

std::uint64_t bits(double value) {
    std::uint64_t out = 0;
    std::memcpy(&out, &value, sizeof out);
    return out;
}

std::string random_string(dsc::RandomStream& random) {
    static const std::vector<std::string> pieces = {"a",
                                                    "Z",
                                                    "0",
                                                    "9",
                                                    " ",
                                                    ":",
                                                    "#",
                                                    "-",
                                                    "'",
                                                    "\"",
                                                    "\\",
                                                    "$",
                                                    "{",
                                                    "}",
                                                    "[",
                                                    "]",
                                                    ",",
                                                    "&",
                                                    "*",
                                                    "!",
                                                    "|",
                                                    ">",
                                                    "%",
                                                    "@",
                                                    "`",
                                                    "\n",
                                                    "\t",
                                                    "\r",
                                                    "\x01",
                                                    "\x7f",
                                                    "\xc3\xa9",
                                                    "\xe2\x82\xac",
                                                    "\xf0\x9f\x90\x87",
                                                    "\xc2\x85",
                                                    "\xe2\x80\xa8",
                                                    "\xef\xbb\xbf",
                                                    "true",
                                                    "null",
                                                    "1e3",
                                                    ".",
                                                    "~",
                                                    "<<",
                                                    "---",
                                                    "...",
                                                    "?",
                                                    "=",
                                                    "${",
                                                    "$${",
                                                    "yes"};
    std::string out;
    const std::uint64_t count = random.index(6);
    for (std::uint64_t i = 0; i < count; ++i) out += pieces[random.index(pieces.size())];
    return out;
}

double random_double(dsc::RandomStream& random) {
    while (true) {
        const std::uint64_t pattern = (std::uint64_t{random()} << 32U) | random();
        double value = 0;
        std::memcpy(&value, &pattern, sizeof value);
        if (random.index(2) == 0) value = random.uniform(-10, 10);
        if (std::isfinite(value)) return value;
    }
}

ConfigNode random_tree(dsc::RandomStream& random, int depth) {
    const std::uint64_t kind = random.index(depth > 0 ? 7 : 5);
    if (kind == 0) return ConfigNode();
    if (kind == 1) return ConfigNode(random.index(2) == 0);
    if (kind == 2)
        return ConfigNode(static_cast<std::int64_t>((std::uint64_t{random()} << 32U) | random()));
    if (kind == 3) return ConfigNode(random_double(random));
    if (kind == 4) return ConfigNode(random_string(random));
    const std::uint64_t count = random.index(5);
    if (kind == 5) {
        std::vector<ConfigNode> items;
        for (std::uint64_t i = 0; i < count; ++i) items.push_back(random_tree(random, depth - 1));
        return ConfigNode::list(items);
    }
    ConfigNode map = ConfigNode::map();
    for (std::uint64_t i = 0; i < count; ++i)
        map = map.with(random_string(random), random_tree(random, depth - 1));
    return map;
}

}  // namespace

TEST_CASE("the text is what a person would write") {
    const std::string text = "dsc: 1\n"
                             "name: thesis-teapot\n"
                             "input:\n"
                             "  cloud:\n"
                             "    file: /data/teapot.obj\n"
                             "    filters:\n"
                             "      - type: duplicates\n"
                             "      - type: voxel_grid\n"
                             "        leaf: 0.01\n"
                             "velocity:\n"
                             "  alpha: 0.2\n"
                             "  beta: 0.0003\n"
                             "  radius: null\n"
                             "axis: [0.0, 0.0, 1.0]\n"
                             "observers: []\n"
                             "nested:\n"
                             "  - - a: 1\n"
                             "    - [1, 2]\n"
                             "  - {}\n"
                             "note: \"yes: it's so\"\n";
    CHECK(to_yaml(parse(text)) == text);
}

TEST_CASE("real numbers are short, exact and never look like integers") {
    CHECK(dsc::config::real_text(0.1) == "0.1");
    CHECK(dsc::config::real_text(1) == "1.0");
    CHECK(dsc::config::real_text(-0.0) == "-0.0");
    CHECK(dsc::config::real_text(3e-4) == "0.0003");
    CHECK(dsc::config::real_text(100000) == "100000.0");
    CHECK(dsc::config::real_text(1e300) == "1e+300");
    CHECK(dsc::config::real_text(0.1 + 0.2) == "0.30000000000000004");
    CHECK(test::code_of([] { dsc::config::real_text(std::numeric_limits<double>::infinity()); }) ==
          "config.range");
    CHECK(test::code_of([] { to_yaml(ConfigNode(std::nan(""))); }) == "config.range");
}

TEST_CASE("20,000 random doubles come back bit for bit") {
    dsc::RandomStream random({11, 0, 0, 0});
    int wrong = 0;
    for (int i = 0; i < 20000; ++i) {
        const double value = random_double(random);
        if (bits(parse(dsc::config::real_text(value)).as_real()) != bits(value)) ++wrong;
    }
    CHECK(wrong == 0);
    for (const double value :
         {5e-324, std::numeric_limits<double>::max(), std::numeric_limits<double>::min(), 1e15,
          1e-5, 123456789012345680.0}) {
        CHECK(bits(parse(dsc::config::real_text(value)).as_real()) == bits(value));
    }
}

TEST_CASE("strings come back, whatever they hold") {
    for (const std::string text : {"",
                                   " ",
                                   "a b",
                                   "true",
                                   "False",
                                   "null",
                                   "~",
                                   "1",
                                   "1.5",
                                   "-",
                                   "- a",
                                   "a: b",
                                   "a #b",
                                   "#",
                                   "'",
                                   "\"",
                                   "\\",
                                   "line\nline",
                                   "\ttab",
                                   "\r\n",
                                   "${HOME}",
                                   "$${HOME}",
                                   "$",
                                   "$$",
                                   "${",
                                   "$$${",
                                   "@x",
                                   "`",
                                   "%",
                                   "&a",
                                   "*a",
                                   "!t",
                                   "|",
                                   ">",
                                   "[",
                                   "]",
                                   "{",
                                   "}",
                                   ",",
                                   "?",
                                   "? a",
                                   ":",
                                   "::",
                                   "<<",
                                   "---",
                                   "...",
                                   ".5",
                                   "0123",
                                   "yes",
                                   "y",
                                   "=",
                                   "\x01\x7f",
                                   "\xc3\xa9",
                                   "\xc2\x85",
                                   "\xe2\x80\xa8",
                                   "\xef\xbb\xbf",
                                   "/a/b-c.obj",
                                   "x\xef\xbb\xbfy",
                                   "Null",
                                   ".inf"}) {
        CAPTURE(text);
        CHECK(read_back(ConfigNode(text)) == ConfigNode(text));
        const ConfigNode in_map =
            ConfigNode::map({{"k", text}, {"key " + text, ConfigNode::list({text, text})}});
        CHECK(read_back(in_map) == in_map);
    }
}

TEST_CASE("3,000 random trees come back equal, and their text is stable") {
    dsc::RandomStream random({12, 0, 0, 0});
    for (int i = 0; i < 3000; ++i) {
        const ConfigNode tree = random_tree(random, 5);
        const std::string text = to_yaml(tree);
        CAPTURE(text);
        const ConfigNode again = read_back(tree);
        REQUIRE(again == tree);
        REQUIRE(to_yaml(again) == text);
    }
}

TEST_CASE("what cannot be read back is refused") {
    CHECK(test::code_of([] { to_yaml(ConfigNode("\xff")); }) == "config.text");
    CHECK(test::code_of([] { to_yaml(ConfigNode::map({{"\xff", 1}})); }) == "config.text");
    CHECK(test::code_of([] {
              to_yaml(ConfigNode::map({{"include", "a.yaml"}}));
          }) == "config.include");
}
