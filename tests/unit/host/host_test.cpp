#include <cmath>
#include <sstream>

#include <doctest/doctest.h>

#include <dsc/base/log.hpp>
#include <dsc/base/random.hpp>
#include <dsc/sdk/surfaces.hpp>

#include "support.hpp"

namespace {

using dsc::Vec3;
using dsc::config::ConfigNode;
using dsc::host::Host;
using dsc::plugin::Kind;
using support::fixture;
namespace fs = std::filesystem;

dsc::hooks::StepContext context_of(const dsc::surface::SurfaceView& view, std::uint64_t step) {
    return {.step = step, .surface = view, .box = {}, .to_normalised = {}};
}

template <class Body>
std::string message(Body&& body) {
    try {
        body();
    } catch (const dsc::Error& error) {
        return error.what();
    }
    return {};
}

// Collects log lines while it lives.
class LogCatcher {
public:
    LogCatcher() {
        dsc::set_log_sink([this](dsc::LogLevel level, std::string_view text) {
            if (level >= dsc::LogLevel::info) lines.emplace_back(text);
        });
    }
    ~LogCatcher() { dsc::set_log_sink({}); }
    std::vector<std::string> lines;
};

}  // namespace

TEST_CASE("a good plugin is known by all that it says") {
    Host host;
    host.load(fixture("good"));
    REQUIRE(host.plugins().size() == 1);
    const dsc::plugin::PluginInfo info = host.plugins()[0];
    CHECK(info.name == "good");
    CHECK(info.version == "1.2.3");
    CHECK(info.license == "MIT");
    CHECK(info.summary == "Two strategies without a fault");
    CHECK(info.authors == "A. Author");
    CHECK(info.file == fixture("good"));
    REQUIRE(host.list().size() == 2);
    CHECK(host.list()[0].strategy->id == "upwards");
    CHECK(host.list()[0].strategy->kind == Kind::velocity);
    CHECK(host.list()[0].strategy->summary == "everything goes up");
    CHECK(host.list()[1].strategy->id == "constant");
    CHECK(host.ids("curvature") == std::vector<std::string>{"constant"});
    CHECK(host.ids("nonsense").empty());
    REQUIRE(host.find_schema("velocity", "upwards") != nullptr);
    CHECK(host.find_schema("velocity", "upwards")->names() ==
          std::vector<std::string>{"speed", "curvature"});
    CHECK(host.find_schema("curvature", "upwards") == nullptr);
}

TEST_CASE("its strategies work through the door, nested ones too") {
    Host host;
    host.load(fixture("good"));
    const auto view = dsc::sdk::view_of(dsc::sdk::icosphere(0, 1.0));
    const ConfigNode nested = ConfigNode::map({{"type", "constant"}, {"value", 3.0}});
    const auto velocity = host.create<dsc::hooks::VelocityField>(
        {"upwards", ConfigNode::map({{"speed", 0.25}, {"curvature", nested}})}, "velocity");
    velocity->prepare(context_of(view, 0));
    std::vector<Vec3> out(view.vertex_count());
    velocity->evaluate({0, out.size()}, out);
    for (const Vec3& d : out) CHECK(d == Vec3(0, 0, 0.75));

    std::stringstream state;
    velocity->save(state);
    CHECK(state.str() == "0.25");
}

TEST_CASE("the same file twice is loaded once, by any of its names") {
    Host host;
    host.load(fixture("good"));
    host.load(fixture("good"));
    host.load(fixture("good").parent_path() / ".." / fixture("good").parent_path().filename() /
              "libdsc_good.so");
    const support::TemporaryFolder folder;
    fs::create_symlink(fixture("good"), folder.path() / "libdsc_alias.so");
    host.load(folder.path() / "libdsc_alias.so");
    CHECK(host.plugins().size() == 1);
}

TEST_CASE("hosts are independent of each other") {
    Host first;
    first.load(fixture("good"));
    Host second;
    CHECK(second.list().empty());
    second.load(fixture("good"));
    CHECK(second.list().size() == 2);
    CHECK(second.list()[0].strategy != first.list()[0].strategy);
}

TEST_CASE("a duplicate id is refused, both files are named and nothing stays behind") {
    Host host;
    host.load(fixture("good"));
    const std::string text = message([&] { host.load(fixture("bad_duplicate")); });
    CHECK(text == fixture("bad_duplicate").string() + ": velocity 'upwards' already exists, from " +
                      fixture("good").string() +
                      "; load only one of the two files, or give one strategy a different id");
    CHECK(host.plugins().size() == 1);
    CHECK_FALSE(host.find(Kind::velocity, "bad_duplicate_first"));
}

TEST_CASE("faults of a strategy name it") {
    Host host;
    const fs::path file = fixture("bad_constructor");
    host.load(file);
    const auto who = [&](const std::string& id) {
        return "velocity '" + id + "' (plugin bad_constructor 0.9.0, " + file.string() +
               ", at 'velocity' in the experiment): ";
    };
    const std::string remedy = "; check its parameters or report this to the plugin's authors";
    const auto make = [&](const char* id) {
        return host.create<dsc::hooks::VelocityField>({id, {}}, "velocity");
    };
    CHECK(message([&] { make("refusing"); }) ==
          who("refusing") + "constructor threw: no table for this machine" + remedy);

    const auto view = dsc::sdk::view_of(dsc::sdk::icosphere(0, 1.0));
    std::vector<Vec3> out(view.vertex_count());
    const auto throwing = make("throwing");
    throwing->prepare(context_of(view, 17));
    CHECK(message([&] {
              throwing->evaluate({0, out.size()}, out);
          }) == who("throwing") + "evaluate at step 17 threw: the matrix is singular" + remedy);

    const auto not_a_number = make("not_a_number");
    not_a_number->prepare(context_of(view, 2));
    not_a_number->evaluate({0, 7}, std::span(out).first(7));
    const std::string text = message([&] {
        not_a_number->evaluate({4, 12}, std::span(out).first(8));
    });
    CHECK(text.find(who("not_a_number") + "evaluate at step 2 gave the displacement (0.5, 0.0, "
                                          "nan) to vertex 7 (birth id 7, at (") == 0);
    CHECK_THROWS_AS(not_a_number->evaluate({4, 12}, std::span(out).first(8)), dsc::StrategyError);
}

TEST_CASE("wrong parameters and unknown strategies") {
    Host host;
    host.load(fixture("good"));
    CHECK_THROWS_WITH_AS(host.create<dsc::hooks::VelocityField>(
                             {"upwards", ConfigNode::map({{"speed", 2.0}})}, "velocity"),
                         doctest::Contains("speed"), dsc::ConfigError);
    CHECK(message([&] {
              host.create<dsc::hooks::VelocityField>({"upward", {}}, "velocity");
          }) == "velocity: there is no velocity 'upward'; did you mean 'upwards'? loaded are "
                "upwards; --plugin and DSC_PLUGIN_PATH load others");
    CHECK(message([&] {
              host.create<dsc::hooks::Observer>({"x", {}}, "observers.0");
          }) == "observers.0: there is no observer 'x', and no plugin with a strategy of this kind "
                "is loaded; use --plugin or DSC_PLUGIN_PATH to load one");
}

TEST_CASE("in a folder only libdsc_NAME.so counts, and a named folder may hold nothing bad") {
    const support::TemporaryFolder folder;
    folder.copy("good");
    folder.write("libother.so", "not looked at");
    folder.write("libdsc_.so", "not looked at");
    folder.write("notes.txt", "not looked at");
    Host host;
    const std::vector<dsc::host::SearchEntry> entries = {{folder.path(), "--plugin", true}};
    host.load_all(entries);
    CHECK(host.plugins().size() == 1);

    folder.write("libdsc_bad.so", "text");
    Host strict;
    CHECK(message([&] { strict.load_all(entries); }) ==
          "--plugin: " + (folder.path() / "libdsc_bad.so").string() +
              ": is not a shared library; give the file of a plugin, libdsc_NAME.so");
    Host collecting;
    collecting.load_all(entries, dsc::host::OnFault::collect);
    CHECK(collecting.plugins().size() == 1);
    REQUIRE(collecting.faults().size() == 1);
    CHECK(collecting.faults()[0].error.code() == "plugin.not_elf");
    CHECK(collecting.faults()[0].file == folder.path() / "libdsc_bad.so");
}

TEST_CASE("in a folder that the user did not name a bad library is a warning") {
    const support::TemporaryFolder folder;
    folder.copy("good");
    const fs::path bad = folder.write("libdsc_bad.so", "text");
    const LogCatcher log;
    Host host;
    const std::vector<dsc::host::SearchEntry> entries = {{folder.path(), "user folder", false}};
    host.load_all(entries);
    CHECK(host.plugins().size() == 1);
    REQUIRE(log.lines.size() == 1);
    CHECK(log.lines[0] ==
          "user folder: " + bad.string() +
              ": is not a shared library; give the file of a plugin, libdsc_NAME.so");
}

TEST_CASE(
    "an earlier place is used instead of a later one, but two libraries with one id are an error") {
    const support::TemporaryFolder mine;
    const support::TemporaryFolder theirs;
    const fs::path front = mine.copy("good");
    const fs::path behind = theirs.copy("good");
    const std::vector<dsc::host::SearchEntry> entries = {{front, "--plugin", true},
                                                         {theirs.path(), "user folder", false}};
    {
        const LogCatcher log;
        Host host;
        host.load_all(entries);
        REQUIRE(host.plugins().size() == 1);
        CHECK(host.plugins()[0].file == front);
        CHECK(log.lines ==
              std::vector<std::string>{"using " + front.string() + "; " + behind.string() +
                                       " is ignored (same file name, later on the search path)"});
    }
    theirs.copy("bad_duplicate");
    Host host;
    CHECK(message([&] { host.load_all(entries); }) ==
          "user folder: " + (theirs.path() / "libdsc_bad_duplicate.so").string() +
              ": velocity 'upwards' already exists, from " + front.string() +
              "; load only one of the two files, or give one strategy a different id");
}

TEST_CASE("loading the same places again changes nothing and says nothing") {
    const support::TemporaryFolder folder;
    folder.copy("good");
    folder.write("libdsc_bad.so", "text");
    const std::vector<dsc::host::SearchEntry> entries = {{folder.path(), "user folder", false}};
    const LogCatcher log;
    Host host;
    host.load_all(entries);
    host.load_all(entries);
    CHECK(host.plugins().size() == 1);
    CHECK(host.faults().size() == 1);
    CHECK(log.lines.size() == 1);
}
