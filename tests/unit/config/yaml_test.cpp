#include <string>

#include <doctest/doctest.h>

#include <dsc/config/yaml.hpp>

#include "support.hpp"

using dsc::config::ConfigNode;
using dsc::config::NodeType;
using test::parse;

TEST_CASE("scalars are read as in JSON") {
    const auto type = [](const std::string& text) {
        return parse("a: " + text + "\n").at("a").type();
    };
    for (const char* text : {"0", "-1", "123", "9223372036854775807", "-9223372036854775808"}) {
        CAPTURE(text);
        CHECK(type(text) == NodeType::integer);
    }
    for (const char* text :
         {"0.5", "-0.0", "1e3", "3.0e-4", "1E+2", "9223372036854775808", "1e-300"}) {
        CAPTURE(text);
        CHECK(type(text) == NodeType::real);
    }
    for (const char* text : {"true", "false"}) CHECK(type(text) == NodeType::boolean);
    for (const char* text : {"null", "~", ""}) CHECK(type(text) == NodeType::null);
    for (const char* text :
         {"0123", "0x1F", "0o17",  "1_000",      ".5",  "5.",       "+5",  "yes",
          "no",   "on",   "off",   "True",       "y",   "1e",       "--1", "1.2.3",
          "inf",  "nan",  "12:30", "2024-01-01", "'8'", "\"true\"", "''"}) {
        CAPTURE(text);
        CHECK(type(text) == NodeType::string);
    }
}

TEST_CASE("numbers keep all their digits") {
    CHECK(parse("a: 0.1\n").at("a").as_real() == 0.1);
    CHECK(parse("a: 2.2250738585072014e-308\n").at("a").as_real() == 2.2250738585072014e-308);
    CHECK(parse("a: 1.7976931348623157e308\n").at("a").as_real() == 1.7976931348623157e308);
    CHECK(parse("a: 5000000.123456789\n").at("a").as_real() == 5000000.123456789);
}

TEST_CASE("every node and key knows its line and column, path and quotes") {
    const ConfigNode node = parse("name: thesis\n"
                                  "schedule:\n"
                                  "  - {steps: 50}\n"
                                  "  - refine:\n"
                                  "      type: \"average_area\"\n"
                                  "empty:\n");
    const ConfigNode& type = node.at("schedule").at(1).at("refine").at("type");
    CHECK(type.path() == "schedule.1.refine.type");
    CHECK(type.position().describe() == "a.yaml:5:13");
    CHECK(type.position().length == 14);
    CHECK(type.quoted());
    CHECK(node.at("schedule").at(1).find_entry("refine")->position.describe() == "a.yaml:4:5");
    CHECK(node.at("schedule").at(0).at("steps").position().describe() == "a.yaml:3:13");
    CHECK_FALSE(node.at("name").quoted());
    CHECK(node.at("empty").position().describe() == "a.yaml:6:1");
}

TEST_CASE("columns count characters, not bytes") {
    const ConfigNode node = parse("{\"\xc3\xa9\xe2\x82\xac\": {x: 1}, y: 2}\n");
    CHECK(node.at("y").position().column == 19);
    CHECK(node.at("\xc3\xa9\xe2\x82\xac").at("x").position().column == 12);
}

TEST_CASE("a byte order mark and Windows line ends are read over") {
    const ConfigNode node = parse("\xef\xbb\xbfname: x\r\nseed: 3\r\n");
    CHECK(node == parse("name: x\nseed: 3\n"));
    CHECK(node.at("seed").position().describe() == "a.yaml:2:7");
}

TEST_CASE("anchors and aliases share values, not places in the tree") {
    const ConfigNode node = parse("a: &x {b: [1, 2]}\nc: *x\nd: &y 5\ne: [*y, *x]\n");
    CHECK(node.at("c") == node.at("a"));
    CHECK(node.at("c").at("b").at(1).path() == "c.b.1");
    CHECK(node.at("e").at(1).at("b").at(0).path() == "e.1.b.0");
    CHECK(node.at("e").at(0).as_integer() == 5);
    CHECK(node.at("d").position().describe() == "a.yaml:3:7");
}

TEST_CASE("an empty text is null, a comment is nothing") {
    CHECK(parse("").is_null());
    CHECK(parse("# nothing\n").is_null());
    CHECK(parse("a: 1 # one\n") == ConfigNode::map({{"a", 1}}));
}

TEST_CASE("variables expand in strings, keys and numbers stay as they are") {
    const ConfigNode node = parse("a: \"${HOME}/data\"\n"
                                  "b: '${HOME}${HOME}'\n"
                                  "c: ${HOME}/x\n"
                                  "d: $${HOME} costs $5\n"
                                  "\"${HOME}\": 1\n");
    CHECK(node.at("a").as_string() == "/home/ada/data");
    CHECK(node.at("b").as_string() == "/home/ada/home/ada");
    CHECK(node.at("c").as_string() == "/home/ada/x");
    CHECK(node.at("d").as_string() == "${HOME} costs $5");
    CHECK(node.at("${HOME}").as_integer() == 1);
    CHECK(parse("a: ${HOME}\n").at("a").is_string());
}

TEST_CASE("what a variable holds is taken as it is") {
    const auto options = test::with_variables(
        {{"A", "${B} 1.0 \"#"}, {"B", "no"}, {"N", "5"}, {"E", ""}, {"X", "\xff"}});
    const auto value = [&](const std::string& text) {
        return dsc::config::parse_yaml("a: " + text + "\n", "a.yaml", options).at("a");
    };
    CHECK(value("\"${A}\"").as_string() == "${B} 1.0 \"#");
    CHECK(value("${N}").as_string() == "5");
    CHECK(value("x${E}y").as_string() == "xy");
    CHECK(test::code_of([&] { value("${X}"); }) == "config.variable");
    CHECK(test::code_of([&] { value("${A"); }) == "config.variable");
    CHECK(test::code_of([&] { value("${1A}"); }) == "config.variable");
    CHECK(test::code_of([&] { value("${a-b}"); }) == "config.variable");
}

TEST_CASE("several faults of one text are reported at once") {
    CHECK(test::error_of([] {
              parse("a: .inf\na: 1\nb: ${NOPE}\n");
          }).find("3 errors; nothing was run") != std::string::npos);
}

TEST_CASE("a duplicate key is found in any map, quoted or not") {
    CHECK(test::code_of([] { parse("a: {b: 1, \"b\": 2}\n"); }) == "config.duplicate_key");
    CHECK(test::code_of([] { parse("- {b: 1, c: 3}\n- {b: 1, b: 3}\n"); }) ==
          "config.duplicate_key");
    CHECK(parse("a: {b: 1}\nc: {b: 1}\n").size() == 2);
}

TEST_CASE("a quoted '<<' is a key like any other") {
    CHECK(parse("'<<': 1\n").at("<<").as_integer() == 1);
}

TEST_CASE("a file that cannot be read is a fault of input") {
    const test::Folder folder("unreadable");
    const std::string missing = (folder.path() / "none.yaml").string();
    try {
        dsc::config::load_yaml(missing);
        FAIL("no error");
    } catch (const dsc::IoError& error) {
        CHECK(error.what() == missing + ": cannot read the configuration: the file does not exist; "
                                        "name a readable YAML file");
        CHECK(error.exit_code() == dsc::ExitCode::io);
    }
    CHECK(test::code_of([&] { dsc::config::load_yaml(folder.path()); }) == "io.open");
}

TEST_CASE("a file is read like a text and names itself in positions") {
    const test::Folder folder("plain");
    const auto file = folder.write("a.yaml", "a: 1\nb: [x]\n");
    const ConfigNode node = dsc::config::load_yaml(file);
    CHECK(node == parse("a: 1\nb: [x]\n"));
    CHECK(node.at("b").at(0).position().describe() == file.string() + ":2:5");
}
