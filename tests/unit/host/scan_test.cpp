#include <doctest/doctest.h>

#include <dsc/host/doctor.hpp>
#include <dsc/host/scan.hpp>

#include "support.hpp"

namespace {

using dsc::host::Examination;
using support::fixture;
using support::refusal;
namespace fs = std::filesystem;

const Examination& failed_step(const std::vector<Examination>& examinations) {
    static const Examination none{"", Examination::Result::ok, "no step failed"};
    for (const Examination& examination : examinations) {
        if (examination.result == Examination::Result::failed) return examination;
    }
    return none;
}

std::vector<Examination> examine(const fs::path& file) { return dsc::host::examine(file, {}); }

}  // namespace

TEST_CASE("a library that crashes, ends the program or hangs when it is loaded does so in another "
          "process") {
    const std::vector<fs::path> files = {fixture("bad_crash"),  fixture("good"),
                                         fixture("bad_exit"),   fixture("bad_hang"),
                                         fixture("bad_throws"), fixture("good")};
    const auto faults = dsc::host::scan(files, std::chrono::milliseconds(1500));
    REQUIRE(faults.size() == 6);
    REQUIRE(faults[0].has_value());
    CHECK(faults[0]->error.code() == "plugin.crash");
#ifndef __SANITIZE_ADDRESS__
    CHECK(std::string(faults[0]->error.what()) ==
          files[0].string() + ": crashes when it is loaded: the child process was ended by signal "
                              "11 (Segmentation fault); report this to the plugin's authors");
#endif
    CHECK_FALSE(faults[1].has_value());
    REQUIRE(faults[2].has_value());
    CHECK(faults[2]->error.cause().find("exited with exit code 0") != std::string::npos);
    REQUIRE(faults[3].has_value());
    CHECK(faults[3]->error.code() == "plugin.hang");
    CHECK(faults[3]->error.cause().find("did not load within 1 s") != std::string::npos);
    REQUIRE(faults[4].has_value());
    CHECK(faults[4]->error.code() == "plugin.enroll");
    CHECK_FALSE(faults[5].has_value());
}

TEST_CASE("a host refuses such a library and lives on") {
    CHECK(refusal(fixture("bad_crash")).code == "plugin.crash");
    dsc::host::Host host;
    CHECK_THROWS_AS(host.load(fixture("bad_exit")), dsc::PluginError);
    host.load(fixture("good"));
    CHECK(host.list().size() == 2);
}

TEST_CASE("the doctor goes the way of a load and stops where it ends") {
    const auto good = examine(fixture("good"));
    CHECK(dsc::host::healthy(good));
    CHECK(good.back().text == "no other plugin on the search path has one of its ids");
    struct Case {
        const char* plugin;
        const char* step;
        const char* text;
    };
    for (const Case& c :
         {Case{"bad_no_entry", "library", "without the symbol dsc_plugin_entry"},
          Case{"bad_abi_old", "build", "was built for ABI"},
          Case{"bad_debug_stl", "build", "dbgstl is '1' in the plugin and '0' in dsc"},
          Case{"bad_symbol", "load", "undefined symbol"}, Case{"bad_crash", "load", "crashes when"},
          Case{"bad_throws", "register", "failed to register"},
          Case{"bad_schema", "register", "failed to register"}}) {
        CAPTURE(c.plugin);
        const auto examinations = examine(fixture(c.plugin));
        CHECK_FALSE(dsc::host::healthy(examinations));
        CHECK(failed_step(examinations).step == c.step);
        CHECK(failed_step(examinations).text.find(c.text) != std::string::npos);
        CHECK((examinations.back().result == Examination::Result::not_reached ||
               c.step == std::string("names")));
    }
    const support::TemporaryFolder folder;
    CHECK(failed_step(examine(folder.path() / "none.so")).step == "file");
    CHECK(failed_step(examine(folder.write("libdsc_text.so", "not a library"))).step == "library");
    const fs::path open = folder.copy("good");
    fs::permissions(open, fs::perms::all);
    CHECK(failed_step(examine(open)).step == "permissions");
}

TEST_CASE("the doctor finds a plugin that has the same ids") {
    const std::vector<dsc::host::SearchEntry> search = {
        {fixture("bad_duplicate"), "--plugin", true}};
    const auto examinations = dsc::host::examine(fixture("good"), search);
    CHECK(failed_step(examinations).step == "names");
    CHECK(failed_step(examinations).text.find("already exists") != std::string::npos);
}
