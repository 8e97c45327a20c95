// Golden texts: what a user reads. Every message is asserted whole.
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include <dsc/config/overrides.hpp>

#include "support.hpp"

using test::error_in;
using test::error_of;
using test::parse;

TEST_CASE("unknown key, with the one that was meant") {
    CHECK(error_in("name: x\n"
                   "velocity: {type: point_cloud, alhpa: 0.3}\n") ==
          "a.yaml:2:31: error: unknown key 'alhpa' in velocity 'point_cloud'\n"
          "    2 | velocity: {type: point_cloud, alhpa: 0.3}\n"
          "      |                               ^~~~~  did you mean 'alpha'? (real, (0, 1], "
          "default 0.2)\n"
          "      note: accepted keys: type, alpha, beta, k, radius, curvature\n"
          "1 error; nothing was run");
}

TEST_CASE("unknown key that belongs elsewhere") {
    CHECK(error_in("velocity:\n"
                   "  type: point_cloud\n"
                   "  speed: 3\n") ==
          "a.yaml:3:3: error: unknown key 'speed' in velocity 'point_cloud'\n"
          "    3 |   speed: 3\n"
          "      |   ^~~~~  'speed' belongs to velocity 'normal'\n"
          "      note: accepted keys: type, alpha, beta, k, radius, curvature\n"
          "1 error; nothing was run");
    CHECK(error_in("velocity: {type: normal}\n"
                   "thickness: 3\n") ==
          "a.yaml:2:1: error: unknown key 'thickness' in the experiment\n"
          "    2 | thickness: 3\n"
          "      | ^~~~~~~~~  'thickness' belongs to 'topology' of the experiment\n"
          "      note: accepted keys: name, seed, cloud, axis, levels, surface, sizes, topology, "
          "schedule, velocity, estimators\n"
          "1 error; nothing was run");
}

TEST_CASE("wrong types, each with a hint at what was meant") {
    CHECK(error_in("velocity:\n"
                   "  type: point_cloud\n"
                   "  k: 2.5\n"
                   "  beta: \"3\"\n"
                   "  alpha: .5\n"
                   "  radius: 0123\n"
                   "topology: {open: yes}\n"
                   "name: 3\n"
                   "schedule: {steps: 3}\n") ==
          "a.yaml:3:6: error: 'velocity.k' must be an integer, not 2.5\n"
          "    3 |   k: 2.5\n"
          "      |      ^~~  accepted: integer, [1, 512], default 8\n"
          "a.yaml:4:9: error: 'velocity.beta' must be a number, not the string '3'\n"
          "    4 |   beta: \"3\"\n"
          "      |         ^~~  remove the quotes\n"
          "a.yaml:5:10: error: 'velocity.alpha' must be a number, not the string '.5'\n"
          "    5 |   alpha: .5\n"
          "      |          ^~  write 0.5\n"
          "a.yaml:6:11: error: 'velocity.radius' must be a number, not the string '0123'\n"
          "    6 |   radius: 0123\n"
          "      |           ^~~~  write 123\n"
          "a.yaml:7:18: error: 'topology.open' must be true or false, not the string 'yes'\n"
          "    7 | topology: {open: yes}\n"
          "      |                  ^~~  write true\n"
          "a.yaml:8:7: error: 'name' must be a string, not 3\n"
          "    8 | name: 3\n"
          "      |       ^  put it in quotes\n"
          "a.yaml:9:11: error: 'schedule' must be a list, not a map\n"
          "    9 | schedule: {steps: 3}\n"
          "      |           ^  write [{...}], or '- ' before each item\n"
          "7 errors; nothing was run");
}

TEST_CASE("out of range, closed and open ends") {
    CHECK(error_in("velocity: {type: point_cloud, alpha: 0, k: 513}\n"
                   "seed: -1\n"
                   "levels: [0.5, 2.5]\n") ==
          "a.yaml:1:38: error: 'velocity.alpha': 0 is not above 0\n"
          "    1 | velocity: {type: point_cloud, alpha: 0, k: 513}\n"
          "      |                                      ^  accepted: real, (0, 1], default 0.2\n"
          "a.yaml:1:44: error: 'velocity.k': 513 is above the maximum 512\n"
          "    1 | velocity: {type: point_cloud, alpha: 0, k: 513}\n"
          "      |                                            ^~~  accepted: integer, [1, 512], "
          "default 8\n"
          "a.yaml:2:7: error: 'seed': -1 is below the minimum 0\n"
          "    2 | seed: -1\n"
          "      |       ^~  accepted: integer, default 1\n"
          "a.yaml:3:15: error: 'levels.1': 2.5 is above the maximum 2\n"
          "    3 | levels: [0.5, 2.5]\n"
          "      |               ^~~  accepted: list of reals, at most 4 items, [0, 2], default "
          "[0.5, 1]\n"
          "4 errors; nothing was run");
}

TEST_CASE("bad choice, wrong number of items, wrong extension") {
    CHECK(error_in("velocity:\n"
                   "  type: point_cloud\n"
                   "  curvature: {type: implicit_fairing, area: rign}\n"
                   "surface: [obj, plyy]\n"
                   "axis: [0, 1]\n"
                   "cloud: scan.las\n") ==
          "a.yaml:3:45: error: 'velocity.curvature.area': 'rign' is not one of mixed, ring\n"
          "    3 |   curvature: {type: implicit_fairing, area: rign}\n"
          "      |                                             ^~~~  did you mean 'ring'?\n"
          "a.yaml:4:16: error: 'surface.1': 'plyy' is not one of obj, ply, off\n"
          "    4 | surface: [obj, plyy]\n"
          "      |                ^~~~  did you mean 'ply'?\n"
          "a.yaml:5:7: error: 'axis' must have exactly 3 items, not 2\n"
          "    5 | axis: [0, 1]\n"
          "      |       ^  accepted: vector of 3 reals, default [0, 0, 1]\n"
          "a.yaml:6:8: error: 'cloud': 'scan.las' cannot be used here; the file's name must end in "
          ".obj or .ply\n"
          "    6 | cloud: scan.las\n"
          "      |        ^~~~~~~~\n"
          "4 errors; nothing was run");
}

TEST_CASE("unknown strategy") {
    CHECK(error_in("velocity:\n"
                   "  type: point_clod\n"
                   "estimators: [{type: gauss}]\n") ==
          "a.yaml:2:9: error: unknown velocity 'point_clod'\n"
          "    2 |   type: point_clod\n"
          "      |         ^~~~~~~~~~  did you mean 'point_cloud'?\n"
          "      note: known velocity strategies: normal, point_cloud\n"
          "a.yaml:3:21: error: unknown curvature 'gauss'\n"
          "    3 | estimators: [{type: gauss}]\n"
          "      |                     ^~~~~\n"
          "      note: known curvature strategies: angular_defect, implicit_fairing\n"
          "2 errors; nothing was run");
}

TEST_CASE("a strategy without its type") {
    CHECK(error_in("velocity: normal\n") ==
          "a.yaml:1:11: error: 'velocity' must be a velocity strategy {type: ID, ...}, not the "
          "string 'normal'\n"
          "    1 | velocity: normal\n"
          "      |           ^~~~~~  write {type: normal}\n"
          "      note: known velocity strategies: normal, point_cloud\n"
          "1 error; nothing was run");
    CHECK(error_in("velocity: {alpha: 0.3}\n") ==
          "a.yaml:1:11: error: 'velocity' does not say which velocity to use: 'type' is missing\n"
          "    1 | velocity: {alpha: 0.3}\n"
          "      |           ^\n"
          "      note: known velocity strategies: normal, point_cloud\n"
          "1 error; nothing was run");
}

TEST_CASE("missing and empty values") {
    CHECK(error_in("name: x\n"
                   "seed:\n") == "a.yaml:1:1: error: 'velocity' is missing in the experiment\n"
                                 "    1 | name: x\n"
                                 "      | ^  velocity strategy, required\n"
                                 "      note: Velocity field.\n"
                                 "a.yaml:2:1: error: 'seed' has no value\n"
                                 "    2 | seed:\n"
                                 "      | ^~~~  accepted: integer, default 1\n"
                                 "2 errors; nothing was run");
    CHECK(error_in("# nothing yet\n") == "a.yaml: error: 'velocity' is missing in the experiment\n"
                                         "      note: velocity strategy, required\n"
                                         "      note: Velocity field.\n"
                                         "1 error; nothing was run");
}

TEST_CASE("failed cross check") {
    CHECK(error_in("velocity: {type: point_cloud, beta: 1.0}\n") ==
          "a.yaml:1:37: error: velocity 'point_cloud': beta above 0 needs a curvature\n"
          "    1 | velocity: {type: point_cloud, beta: 1.0}\n"
          "      |                                     ^~~\n"
          "1 error; nothing was run");
}

TEST_CASE("old and new name together") {
    CHECK(error_in("velocity: {type: point_cloud, neighbours: 3, k: 4}\n") ==
          "a.yaml:1:31: error: 'neighbours' is the old name of 'k', and both are given\n"
          "    1 | velocity: {type: point_cloud, neighbours: 3, k: 4}\n"
          "      |                               ^~~~~~~~~~  remove 'neighbours'\n"
          "1 error; nothing was run");
}

TEST_CASE("malformed YAML") {
    CHECK(error_in("name: x\n"
                   "a: b: c\n") == "a.yaml:2:5: error: malformed YAML: illegal map value\n"
                                   "    2 | a: b: c\n"
                                   "      |     ^  put text that contains ': ' in quotes\n"
                                   "1 error; nothing was run");
    CHECK(error_in("name: x\n"
                   "levels: [1, 2\n"
                   "seed: 3\n") ==
          "a.yaml:3:5: error: malformed YAML: end of sequence flow not found\n"
          "    3 | seed: 3\n"
          "      |     ^  is the '[' in line 2 closed?\n"
          "1 error; nothing was run");
    CHECK(error_in("topology:\n"
                   "\topen: true\n") == "a.yaml:2:6: error: malformed YAML: illegal map value\n"
                                        "    2 |  open: true\n"
                                        "      |      ^  indent with blanks, not tabs\n"
                                        "1 error; nothing was run");
    CHECK(error_in("cloud: {file: ${DSC_DATA}/x.obj}\n") ==
          "a.yaml:1:16: error: malformed YAML: end of map flow not found\n"
          "    1 | cloud: {file: ${DSC_DATA}/x.obj}\n"
          "      |                ^  put text with ${...} in quotes\n"
          "1 error; nothing was run");
}

TEST_CASE("a quote that is not closed, with and without a newline at the end of the file") {
    const std::string message =
        "a.yaml:2:7: error: malformed YAML: the quote that starts here is not closed\n"
        "    2 | name: 'x\n"
        "      |       ^\n"
        "1 error; nothing was run";
    CHECK(error_in("seed: 3\nname: 'x\n") == message);
    CHECK(error_in("name: \"x") == "a.yaml:1:9: error: malformed YAML: illegal EOF in scalar\n"
                                   "    1 | name: \"x\n"
                                   "      |         ^\n"
                                   "1 error; nothing was run");
}

TEST_CASE("duplicate key, naming both lines") {
    CHECK(error_in("name: a\n"
                   "seed: 1\n"
                   "name: b\n") ==
          "a.yaml:3:1: error: duplicate key 'name', first given in line 1\n"
          "    3 | name: b\n"
          "      | ^~~~  remove one of the two\n"
          "1 error; nothing was run");
}

TEST_CASE("merge key") {
    CHECK(error_in("a: &x {b: 1}\n"
                   "c:\n"
                   "  <<: *x\n") == "a.yaml:3:3: error: the merge key '<<' is not supported\n"
                                    "    3 |   <<: *x\n"
                                    "      |   ^~  use 'include: FILE' at the top of the file\n"
                                    "1 error; nothing was run");
}

TEST_CASE("numbers that are not finite") {
    CHECK(error_in("a: .inf\n"
                   "b: -.NaN\n"
                   "c: 1e999\n") == "a.yaml:1:4: error: '.inf' is not a finite number\n"
                                    "    1 | a: .inf\n"
                                    "      |    ^~~~  write a finite decimal number\n"
                                    "a.yaml:2:4: error: '-.NaN' is not a finite number\n"
                                    "    2 | b: -.NaN\n"
                                    "      |    ^~~~~  write a finite decimal number\n"
                                    "a.yaml:3:4: error: '1e999' does not fit a double\n"
                                    "    3 | c: 1e999\n"
                                    "      |    ^~~~~  write a finite decimal number\n"
                                    "3 errors; nothing was run");
}

TEST_CASE("tag, second document, list as a key") {
    CHECK(error_in("a: !!str 3\n") ==
          "a.yaml:1:4: error: the YAML tag 'tag:yaml.org,2002:str' is not supported\n"
          "    1 | a: !!str 3\n"
          "      |    ^  write the value without a tag; quotes make a string\n"
          "1 error; nothing was run");
    CHECK(error_in("a: 1\n---\nb: 1\n") ==
          "a.yaml:2:1: error: malformed YAML: a second document starts here\n"
          "    2 | ---\n"
          "      | ^  a configuration is one document\n"
          "1 error; nothing was run");
    CHECK(error_in("[1]: 2\n") ==
          "a.yaml:1:1: error: malformed YAML: a list or map cannot be a key\n"
          "    1 | [1]: 2\n"
          "      | ^  put text with braces or brackets in quotes\n"
          "1 error; nothing was run");
}

TEST_CASE("unset variable") {
    CHECK(error_in("velocity: {type: normal}\n"
                   "cloud: \"${MY_DATA}/x.obj\"\n") ==
          "a.yaml:2:8: error: the environment variable 'MY_DATA' is not set\n"
          "    2 | cloud: \"${MY_DATA}/x.obj\"\n"
          "      |        ^~~~~~~~~~~~~~~~~~  set it: export MY_DATA=...\n"
          "1 error; nothing was run");
}

TEST_CASE("the message for an unset DSC_DATA says what it is and where the clouds are") {
    CHECK(error_in("cloud: \"${DSC_DATA}/teapot.obj\"\n") ==
          "a.yaml:1:8: error: the environment variable 'DSC_DATA' is not set\n"
          "    1 | cloud: \"${DSC_DATA}/teapot.obj\"\n"
          "      |        ^~~~~~~~~~~~~~~~~~~~~~~~  set it: export DSC_DATA=...\n"
          "      note: DSC_DATA is the folder with the thesis' clouds bunny.obj, teapot.obj and "
          "cow.obj\n"
          "      note: they are public models: the Stanford bunny "
          "(graphics.stanford.edu/data/3Dscanrep), the teapot and the cow (the common OBJ test "
          "models)\n"
          "1 error; nothing was run");
}

TEST_CASE("malformed name of a variable") {
    CHECK(error_in("name: a${}\n") ==
          "a.yaml:1:7: error: '${' does not start the name of a variable\n"
          "    1 | name: a${}\n"
          "      |       ^~~~  write ${NAME}, or $${ for a literal '${'\n"
          "1 error; nothing was run");
}

TEST_CASE("a file that is not a map") {
    CHECK(error_in("just text\n") ==
          "a.yaml:1:1: error: the experiment must be a map, not the string 'just text'\n"
          "    1 | just text\n"
          "      | ^~~~~~~~~  accepted keys: name, seed, cloud, axis, levels, surface, sizes, "
          "topology, schedule, velocity, estimators\n"
          "1 error; nothing was run");
}

TEST_CASE("faults of overrides name the override") {
    const auto error = [](const std::vector<std::string>& overrides) {
        return error_of([&] {
            test::resolve(dsc::config::apply_overrides(
                parse("velocity: {type: point_cloud}\nschedule: [{steps: 3}]\n"), overrides));
        });
    };
    CHECK(error({"velocity.k=0", "velocity.apha=1"}) ==
          "command line: 'velocity.apha=1': error: unknown key 'apha' in velocity 'point_cloud'\n"
          "      note: did you mean 'alpha'? (real, (0, 1], default 0.2)\n"
          "      note: accepted keys: type, alpha, beta, k, radius, curvature\n"
          "command line: 'velocity.k=0': error: 'velocity.k': 0 is below the minimum 1\n"
          "      note: accepted: integer, [1, 512], default 8\n"
          "2 errors; nothing was run");
    CHECK(error({"x", "+a=3", "a..b=3", "schedule.1.steps=3", "velocity.type.a=3", "name=a: b",
                 "name=#x", "velocity.k=[1", "cloud=${NOPE}"}) ==
          "command line: 'x': error: malformed override: no '=' in it\n"
          "      note: write path.to.key=value\n"
          "command line: '+a=3': error: malformed override: it starts with '+'\n"
          "      note: write path.to.key=value; every key of the schema is allowed\n"
          "command line: 'a..b=3': error: malformed override: 'a..b' is not a dotted path\n"
          "      note: write path.to.key=value\n"
          "command line: 'schedule.1.steps=3': error: malformed override: 'schedule' is a list of "
          "1 item; it has no item '1'\n"
          "      note: items are numbered from 0 to 0\n"
          "command line: 'velocity.type.a=3': error: malformed override: 'velocity.type' is a "
          "string; it has no key 'a'\n"
          "command line: 'name=a: b': error: malformed YAML: expected a scalar, [list] or {map}\n"
          "      note: put text with ': ' or '- ' in quotes\n"
          "command line: 'name=#x': error: malformed override: its value is a comment\n"
          "      note: put a value with '#' in quotes\n"
          "command line: 'velocity.k=[1': error: malformed YAML: end of sequence flow not found\n"
          "      note: is the '[' closed?\n"
          "command line: 'cloud=${NOPE}': error: the environment variable 'NOPE' is not set\n"
          "      note: set it: export NOPE=...\n"
          "9 errors; nothing was run");
}
