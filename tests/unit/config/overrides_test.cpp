#include <string>
#include <vector>

#include <doctest/doctest.h>

#include <dsc/config/overrides.hpp>

#include "support.hpp"

using dsc::config::ConfigNode;
using test::parse;
namespace config = dsc::config;

namespace {

ConfigNode overridden(const std::string& text, const std::vector<std::string>& overrides) {
    return dsc::config::apply_overrides(parse(text), overrides,
                                        test::with_variables({{"HOME", "/home/ada"}}));
}

}  // namespace

TEST_CASE("an override replaces a value, adds a key, makes the maps on its way") {
    CHECK(overridden("a: {b: 1, c: 2}\n", {"a.b=3"}) == parse("a: {b: 3, c: 2}\n"));
    CHECK(overridden("a: {b: 1}\n", {"a.c=x"}) == parse("a: {b: 1, c: x}\n"));
    CHECK(overridden("", {"a.b.c=true"}) == parse("a: {b: {c: true}}\n"));
    CHECK(overridden("a:\n", {"a.b=1"}) == parse("a: {b: 1}\n"));
    CHECK(overridden("s: [{n: 1}, {n: 2}]\n", {"s.1.n=5"}) == parse("s: [{n: 1}, {n: 5}]\n"));
    CHECK(overridden("s: [1, 2]\n", {"s.0=7"}) == parse("s: [7, 2]\n"));
}

TEST_CASE("the value is a YAML scalar or flow collection") {
    CHECK(overridden("", {"a=3"}).at("a").is_integer());
    CHECK(overridden("", {"a=3.0"}).at("a").is_real());
    CHECK(overridden("", {"a='3'"}).at("a").is_string());
    CHECK(overridden("", {"a=3e-4"}).at("a").as_real() == 3e-4);
    CHECK(overridden("", {"a="}).at("a").is_null());
    CHECK(overridden("", {"a=b=c"}).at("a").as_string() == "b=c");
    CHECK(overridden("", {"a=${HOME}/x"}).at("a").as_string() == "/home/ada/x");
    CHECK(overridden("a: {type: x, old: 1}\n", {"a={type: y, list: [1, 2.5]}"}) ==
          parse("a: {type: y, list: [1, 2.5]}\n"));
}

TEST_CASE("the last override wins") {
    CHECK(overridden("a: 1\n", {"a=2", "a=3"}) == parse("a: 3\n"));
    CHECK(overridden("a: 1\n", {"a={b: 1}", "a.b=2"}) == parse("a: {b: 2}\n"));
}

TEST_CASE("an overridden value knows that it came from the command line") {
    const ConfigNode node = overridden("a: {b: 1, c: 2}\n", {"a.b=3", "d.e=[1]"});
    CHECK(node.at("a").at("b").position().describe() == "command line: 'a.b=3'");
    CHECK(node.at("a").at("b").path() == "a.b");
    CHECK(node.at("a").at("c").position().describe() == "a.yaml:1:14");
    CHECK(node.at("d").find_entry("e")->position.from_command_line());
    CHECK(node.at("d").at("e").at(0).path() == "d.e.0");
}

TEST_CASE("malformed overrides are all reported and all refused") {
    CHECK(test::code_of([] { overridden("a: 1\n", {"a=2", "nonsense"}); }) == "config.override");
    for (const std::string bad :
         {"",     "=",         "=1",     ".=1",     "a.=1",   ".a=1",      "a b=1",  "~a",
          "~a=1", "+a=1",      "a",      "a=[",     "a=- 1",  "a=1\nb: 2", "a=\"x",  "a='x\n",
          "a=*x", "a=!!int 3", "a=.nan", "a.0.b=1", "l.-1=1", "l.2=1",     "l.1x=1", "a=\x01"}) {
        CAPTURE(bad);
        CHECK(test::code_of([&] { overridden("a: 1\nl: [1, 2]\n", {bad}); }) == "config.override");
    }
    std::string deep = "a";
    for (int i = 0; i < 100000; ++i) deep += ".a";
    CHECK(test::code_of([&] { overridden("", {deep + "=1"}); }) == "config.override");
}

TEST_CASE("a value from a file keeps its place and that of its key") {
    const ConfigNode sweep = parse("velocity.alpha: 0.3\nschedule.0.steps: 7\nstop.speed: 1\n");
    ConfigNode root = parse("velocity: {type: point_cloud}\nschedule: [{steps: 5}]\n");
    for (const config::ConfigEntry& entry : sweep.entries())
        root = config::with_value(root, entry.key, entry.value, entry.position);
    CHECK(root == parse("velocity: {type: point_cloud, alpha: 0.3}\nschedule: [{steps: 7}]\nstop: "
                        "{speed: 1}\n"));
    const config::ConfigEntry* alpha = root.at("velocity").find_entry("alpha");
    REQUIRE(alpha != nullptr);
    CHECK(alpha->position.describe() == "a.yaml:1:1");
    CHECK(alpha->value.position().describe() == "a.yaml:1:17");
    CHECK(alpha->value.path() == "velocity.alpha");

    const auto fault = [&](const std::string& path) {
        return test::error_of(
            [&] { config::with_value(root, path, ConfigNode(1), sweep.entries()[1].position); });
    };
    CHECK(fault("schedule.4.steps")
              .find("a.yaml:2:1: error: 'schedule' is a list of 1 item; it has no item '4'") == 0);
    CHECK(fault("velocity.alpha.x").find("a.yaml:2:1: error: 'velocity.alpha' is a real number") ==
          0);
    CHECK(fault("velocity..alpha")
              .find("a.yaml:2:1: error: 'velocity..alpha' is not a dotted path") == 0);
}

TEST_CASE("a value on one line reads back as an equal tree") {
    for (const char* text : {"1", "1.0", "-0.001", "true", "~", "plain", "'it''s, {odd}: #'",
                             "\"tab\\t line\\n\"", "'$${HOME}'", "'0.5'", "[]", "{}",
                             "[1, [2.5, a], {b: [~]}]", "{a.b: 1, 'c d': {e: ['x, y']}}"}) {
        const ConfigNode value = parse(std::string("a: ") + text).at("a");
        const std::string flow = config::flow_text(value);
        CAPTURE(flow);
        CHECK(flow.find('\n') == std::string::npos);
        const auto source = std::make_shared<const config::SourceText>(config::SourceText{
            config::SourceText::Kind::command_line, "command line", "a=" + flow});
        CHECK(config::parse_value(source, 2) == value);
    }
}
