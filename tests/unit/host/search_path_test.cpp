#include <map>

#include <doctest/doctest.h>

#include "support.hpp"

namespace {

namespace fs = std::filesystem;
using dsc::host::SearchEntry;
using dsc::host::SearchOptions;

dsc::config::Environment environment(std::map<std::string, std::string> values) {
    return [values = std::move(values)](const std::string& name) -> std::optional<std::string> {
        const auto found = values.find(name);
        return found == values.end() ? std::nullopt : std::optional(found->second);
    };
}

}  // namespace

TEST_CASE("the order of the search path") {
    const support::TemporaryFolder home;
    const fs::path users = home.path() / ".local" / "share" / "dsc" / "plugins";
    fs::create_directories(users);
    SearchOptions options;
    options.command_line = {"/a/libdsc_a.so"};
    options.experiment = {"/b"};
    options.environment =
        environment({{"DSC_PLUGIN_PATH", "/c::/d/libdsc_d.so:"}, {"HOME", home.path().string()}});
    const std::vector<SearchEntry> entries = search_path(options);
    REQUIRE(entries.size() == 6);
    const char* origins[] = {"--plugin",        "plugins",     "DSC_PLUGIN_PATH",
                             "DSC_PLUGIN_PATH", "user folder", "installed folder"};
    const fs::path paths[] = {"/a/libdsc_a.so", "/b",  "/c",
                              "/d/libdsc_d.so", users, DSC_BUILTIN_PLUGINS};
    for (std::size_t i = 0; i < entries.size(); ++i) {
        CHECK(entries[i].origin == origins[i]);
        CHECK(entries[i].required == (i < 4));
        CHECK(fs::weakly_canonical(entries[i].path) == fs::weakly_canonical(paths[i]));
    }
}

TEST_CASE("XDG_DATA_HOME goes before the home folder, relative values do not count") {
    const support::TemporaryFolder data;
    fs::create_directories(data.path() / "dsc" / "plugins");
    SearchOptions options;
    options.environment =
        environment({{"XDG_DATA_HOME", data.path().string()}, {"HOME", "/nowhere"}});
    REQUIRE(search_path(options).size() == 2);
    CHECK(search_path(options)[0].path == data.path() / "dsc" / "plugins");
    options.environment = environment({{"XDG_DATA_HOME", "data"}, {"HOME", "home"}});
    CHECK(search_path(options).size() == 1);
}

TEST_CASE("the current folder is nobody's plugin folder") {
    const support::TemporaryFolder here;
    here.copy("good");
    const fs::path before = fs::current_path();
    fs::current_path(here.path());
    SearchOptions options;
    options.environment = environment({});
    const std::vector<SearchEntry> entries = search_path(options);
    fs::current_path(before);
    REQUIRE(entries.size() == 1);
    CHECK(entries[0].origin == "installed folder");

    options.environment = environment({{"DSC_PLUGIN_PATH", "/a:."}});
    CHECK_THROWS_WITH_AS(search_path(options),
                         "DSC_PLUGIN_PATH: '.' is relative, so its meaning would depend on the "
                         "current folder; write an absolute path",
                         dsc::PluginError);
}

TEST_CASE("the built-in strategies are found beside the core library") {
    CHECK(fs::equivalent(dsc::host::installed_folder(), DSC_BUILTIN_PLUGINS));
    SearchOptions options;
    options.environment = environment({});
    dsc::host::Host host;
    host.load_all(search_path(options));
    CHECK(host.find(dsc::plugin::Kind::initial_mesh, "grid"));
}
