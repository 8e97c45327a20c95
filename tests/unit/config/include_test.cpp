#include <string>

#include <doctest/doctest.h>

#include "support.hpp"

using dsc::config::ConfigNode;
using dsc::config::load_yaml;
using test::Folder;
using test::parse;

TEST_CASE("included maps merge deeply, lists are replaced, the including file wins") {
    const Folder folder("merge");
    folder.write("base/one.yaml", "a: {b: 1, c: {d: 2, e: 3}}\nlist: [1, 2, 3]\nkept: true\n");
    folder.write("base/two.yaml", "a: {b: 10, f: 5}\n");
    const auto file = folder.write("main.yaml", "include: [base/one.yaml, base/two.yaml]\n"
                                                "a: {c: {e: 30}}\n"
                                                "list: [9]\n"
                                                "own: 1\n");
    const ConfigNode node = load_yaml(file);
    CHECK(node == parse("a: {b: 10, c: {d: 2, e: 30}, f: 5}\nlist: [9]\nkept: true\nown: 1\n"));
    CHECK(node.at("a").at("c").at("e").path() == "a.c.e");
    CHECK(folder.shown(node.at("a").at("b").position().describe()) == "DIR/base/two.yaml:1:8");
    CHECK(folder.shown(node.at("a").at("c").at("d").position().describe()) ==
          "DIR/base/one.yaml:1:18");
}

TEST_CASE("names of included files are relative to the file that includes them") {
    const Folder folder("relative");
    folder.write("base/deep/three.yaml", "x: 3\n");
    folder.write("base/two.yaml", "include: deep/three.yaml\ny: 2\n");
    CHECK(load_yaml(folder.write("main.yaml", "include: base/two.yaml\n")) ==
          parse("x: 3\ny: 2\n"));
}

TEST_CASE("a file may be included twice, as long as it does not include itself") {
    const Folder folder("diamond");
    folder.write("base.yaml", "x: 1\ny: 1\n");
    folder.write("left.yaml", "include: base.yaml\nx: 2\n");
    folder.write("right.yaml", "include: base.yaml\ny: 2\n");
    CHECK(load_yaml(folder.write("main.yaml", "include: [left.yaml, right.yaml]\n")) ==
          parse("x: 1\ny: 2\n"));
}

TEST_CASE("another strategy replaces the whole map, the same one merges") {
    const Folder folder("strategy");
    folder.write("base.yaml", "velocity: {type: point_cloud, alpha: 0.3, beta: 1.0}\n");
    CHECK(load_yaml(folder.write("a.yaml",
                                 "include: base.yaml\nvelocity: {type: normal, speed: 2.0}\n")) ==
          parse("velocity: {type: normal, speed: 2.0}\n"));
    CHECK(load_yaml(folder.write(
              "b.yaml", "include: base.yaml\nvelocity: {type: point_cloud, beta: 2.0}\n")) ==
          parse("velocity: {type: point_cloud, alpha: 0.3, beta: 2.0}\n"));
    CHECK(load_yaml(folder.write("c.yaml", "include: base.yaml\nvelocity: {beta: 2.0}\n")) ==
          parse("velocity: {type: point_cloud, alpha: 0.3, beta: 2.0}\n"));
}

TEST_CASE("an include cycle is reported with its files") {
    const Folder folder("cycle");
    folder.write("b.yaml", "include: sub/c.yaml\n");
    folder.write("sub/c.yaml", "x: 1\ninclude: [../a.yaml]\n");
    const auto file = folder.write("a.yaml", "include: b.yaml\n");
    CHECK(folder.shown(test::error_of([&] { load_yaml(file); })) ==
          "DIR/sub/c.yaml:2:11: error: include cycle: DIR/a.yaml -> DIR/b.yaml -> DIR/sub/c.yaml "
          "-> DIR/a.yaml\n"
          "    2 | include: [../a.yaml]\n"
          "      |           ^~~~~~~~~  a file cannot include itself\n"
          "1 error; nothing was run");
    const auto self = folder.write("self.yaml", "include: ./self.yaml\n");
    CHECK(test::code_of([&] { load_yaml(self); }) == "config.include");
}

TEST_CASE("a missing included file is reported where it is named") {
    const Folder folder("missing");
    const auto file = folder.write("a.yaml", "include: [none.yaml, .]\n");
    CHECK(folder.shown(test::error_of([&] { load_yaml(file); })) ==
          "DIR/a.yaml:1:11: error: cannot include 'DIR/none.yaml': the file does not exist\n"
          "    1 | include: [none.yaml, .]\n"
          "      |           ^~~~~~~~~  the name is relative to the including file\n"
          "DIR/a.yaml:1:22: error: cannot include 'DIR/': it is a folder\n"
          "    1 | include: [none.yaml, .]\n"
          "      |                      ^  the name is relative to the including file\n"
          "2 errors; nothing was run");
}

TEST_CASE("a fault inside an included file is reported with that file's place") {
    const Folder folder("inner");
    folder.write("base.yaml", "x: 1\nx: 2\n");
    const auto file = folder.write("a.yaml", "include: base.yaml\n");
    CHECK(folder.shown(test::error_of([&] { load_yaml(file); })) ==
          "DIR/base.yaml:2:1: error: duplicate key 'x', first given in line 1\n"
          "    2 | x: 2\n"
          "      | ^  remove one of the two\n"
          "1 error; nothing was run");
}

TEST_CASE("include takes names of maps only") {
    const Folder folder("kinds");
    folder.write("list.yaml", "[1, 2]\n");
    folder.write("empty.yaml", "");
    for (const std::string text : {"include: 3\n", "include: [a, 3]\n", "include: {a: b}\n",
                                   "include:\n", "include: list.yaml\n"}) {
        CAPTURE(text);
        const auto file = folder.write("a.yaml", text);
        CHECK(test::code_of([&] { load_yaml(file); }) == "config.include");
    }
    CHECK(load_yaml(folder.write("a.yaml", "include: empty.yaml\nx: 1\n")) == parse("x: 1\n"));
}

TEST_CASE("variables expand in the names of included files") {
    const Folder folder("variable");
    folder.write("sub/base.yaml", "x: 1\n");
    const auto options = test::with_variables({{"WHERE", (folder.path() / "sub").string()}});
    CHECK(load_yaml(folder.write("a.yaml", "include: \"${WHERE}/base.yaml\"\n"), options) ==
          parse("x: 1\n"));
}

TEST_CASE("include is a directive of the top level only") {
    CHECK(parse("a: {include: x.yaml}\n").at("a").at("include").as_string() == "x.yaml");
}
