// Text that nobody wrote in good faith: every one ends with a ConfigError or a tree, soon and with
// little memory.
#include <string>

#include <doctest/doctest.h>

#include <dsc/base/random.hpp>

#include "support.hpp"

using test::code_of;
using test::parse;

namespace {

std::string repeated(const std::string& piece, int times) {
    std::string out;
    for (int i = 0; i < times; ++i) out += piece;
    return out;
}

}  // namespace

TEST_CASE("deep nesting is refused at the limit") {
    const auto nested = [](int depth) { return repeated("[", depth) + repeated("]", depth); };
    CHECK_NOTHROW(parse(nested(64)));
    CHECK(code_of([&] { parse(nested(65)); }) == "config.too_deep");
    CHECK(code_of([&] { parse(nested(400000)); }) == "config.too_deep");
    CHECK(code_of([&] { parse(repeated("{a: ", 100000)); }) == "config.too_deep");
    std::string blocks;
    for (int i = 0; i < 200; ++i) blocks += std::string(static_cast<std::size_t>(i), ' ') + "a:\n";
    CHECK(code_of([&] { parse(blocks); }) == "config.too_deep");
    CHECK(code_of([&] { parse(repeated("- ", 300000)); }) == "config.too_deep");
}

TEST_CASE("an alias bomb is refused before it grows") {
    std::string text = "a0: &a0 [x, x, x, x, x, x, x, x, x, x]\n";
    for (int i = 1; i < 20; ++i) {
        const std::string previous = "*a" + std::to_string(i - 1);
        text += "a" + std::to_string(i) + ": &a" + std::to_string(i) + " [" + previous +
                repeated(", " + previous, 9) + "]\n";
    }
    CHECK(code_of([&] { parse(text); }) == "config.too_large");
}

TEST_CASE("aliases cannot hide depth or cycles") {
    std::string text = "a0: &a0 [1]\n";
    for (int i = 1; i < 100; ++i) {
        text += "a" + std::to_string(i) + ": &a" + std::to_string(i) + " [*a" +
                std::to_string(i - 1) + "]\n";
    }
    CHECK(code_of([&] { parse(text); }) == "config.too_deep");
    CHECK(code_of([] { parse("a: &a [*a]\n"); }) == "config.yaml");
    CHECK(code_of([] { parse("a: &a {b: *a}\n"); }) == "config.yaml");
    CHECK(code_of([] { parse("a: *a\n"); }) == "config.yaml");
    CHECK(code_of([] { parse("&a a: 1\n*a : 2\n"); }) == "config.yaml");
}

TEST_CASE("binary junk is refused with the place of the first bad byte") {
    CHECK(test::error_of([] { parse(std::string("a: 1\nb: \0x\n", 11)); }) ==
          "a.yaml:2:4: error: malformed YAML: the byte 0x00 is not text\n"
          "    2 | b:  x\n"
          "      |    ^  a configuration must be a text file in UTF-8\n"
          "1 error; nothing was run");
    CHECK(code_of([] { parse("a: \xff\xfe\n"); }) == "config.yaml");
    CHECK(code_of([] { parse("a: \xc0\xaf\n"); }) == "config.yaml");      // overlong
    CHECK(code_of([] { parse("a: \xed\xa0\x80\n"); }) == "config.yaml");  // a surrogate
    CHECK(code_of([] { parse("a: \x1b[2J\n"); }) == "config.yaml");
    CHECK(code_of([] {
              parse("\xff\xfe"
                    "a\0:\0");
          }) == "config.yaml");  // UTF-16
}

TEST_CASE("size and number of values are limited") {
    CHECK(code_of([] { parse("a: " + std::string(2000000, 'x')); }) == "config.too_large");
    CHECK(code_of([] { parse("[" + repeated("1,", 150000) + "1]"); }) == "config.too_large");
    const test::Folder folder("large");
    const auto file = folder.write("a.yaml", "a: " + std::string(2000000, 'x'));
    CHECK(code_of([&] { dsc::config::load_yaml(file); }) == "config.too_large");
}

TEST_CASE("files that include many others run into the same limits") {
    const test::Folder folder("includes");
    for (int i = 0; i < 40; ++i) {
        const std::string next = "f" + std::to_string(i + 1) + ".yaml";
        folder.write("f" + std::to_string(i) + ".yaml", "include: [" + next + ", " + next + "]\n");
    }
    folder.write("f40.yaml", "x: 1\n");
    CHECK(code_of([&] { dsc::config::load_yaml(folder.path() / "f0.yaml"); }) == "config.include");
    CHECK(test::error_of([&] {
              dsc::config::load_yaml(folder.path() / "f30.yaml");
          }).find("more than 100 files are included") != std::string::npos);
    CHECK(dsc::config::load_yaml(folder.path() / "f36.yaml").at("x").as_integer() == 1);
}

TEST_CASE("long keys in deep trees cost no more than their text") {
    std::string text;
    for (std::size_t depth = 0; depth < 60; ++depth)
        text += std::string(depth, ' ') + std::string(1000, 'k') + ":\n";
    text += std::string(60, ' ') + "[" + repeated("1,", 90000) + "1]\n";
    const auto tree = parse(text);
    dsc::config::ConfigNode node = tree;
    for (int depth = 0; depth < 60; ++depth) node = node.entries()[0].value;
    CHECK(node.size() == 90001);
    CHECK(node.at(90000).path().size() == 60 * 1001 + 5);
}

TEST_CASE("thousands of unknown keys are reported briefly") {
    std::string text;
    for (int i = 0; i < 20000; ++i) text += "k" + std::to_string(i) + ": 1\n";
    const std::string message = test::error_in(text);
    CHECK(message.size() < 100000);
    CHECK(message.find("20001 errors; nothing was run") != std::string::npos);
}

TEST_CASE("20,000 mutations of an experiment: a tree or a ConfigError, nothing else") {
    const std::string seed =
        "include: []\nname: \"x\\n\" # c\nv: &a {type: 'p''q', k: [1, 2.5, -3e4, ~], r: null}\n"
        "s:\n  - {steps: 50}\n  - refine: *a\n  - |\n    block\n  - >-\n    folded\n? q\n: "
        "${HOME}\n";
    static const std::string pieces = "[]{}:,-?#&*!|>'\"%@`$ \n\t\\~<=.0aeE+\xc3\xa9";
    dsc::RandomStream random({13, 0, 0, 0});
    int trees = 0, errors = 0;
    for (int i = 0; i < 20000; ++i) {
        std::string text = seed;
        const std::uint64_t changes = 1 + random.index(4);
        for (std::uint64_t c = 0; c < changes; ++c) {
            const std::size_t at = random.index(text.size());
            const char piece = pieces[random.index(pieces.size())];
            switch (random.index(4)) {
                case 0: text[at] = piece; break;
                case 1: text.insert(at, 1, piece); break;
                case 2: text.erase(at, 1 + random.index(4)); break;
                default: text.resize(at + 1); break;
            }
        }
        try {
            parse(text);
            ++trees;
        } catch (const dsc::ConfigError&) {
            ++errors;
        }
    }
    CHECK(trees + errors == 20000);
    CHECK(trees > 100);
    CHECK(errors > 1000);
}
