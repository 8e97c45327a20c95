// Every experiment in configs/ is right.
#include <algorithm>
#include <filesystem>

#include <doctest/doctest.h>

#include "process.hpp"

using dsc::test::Cli;
using dsc::test::Result;
namespace fs = std::filesystem;

TEST_CASE("each experiment in configs/ passes --check and prints what reproduces it") {
    Cli cli;
    // A check reads the clouds, it does not look into them: any file of the name will do.
    for (const char* name : {"bunny.obj", "teapot.obj", "cow.obj"})
        cli.write(std::string("clouds/") + name, "v 0 0 0\n");
    cli.environment["DSC_DATA"] = (cli.folder() / "clouds").string();
    std::vector<fs::path> configs;
    for (const auto& entry :
         fs::recursive_directory_iterator(fs::path(DSC_SOURCE_DIR) / "configs")) {
        const bool sweep = entry.path().parent_path().filename() == "sweeps";
        if (entry.path().extension() == ".yaml" && !sweep) configs.push_back(entry.path());
    }
    std::sort(configs.begin(), configs.end());
    CHECK(configs.size() >= 4);
    for (const fs::path& config : configs) {
        CAPTURE(config);
        const Result check = cli.dsc({"run", config.string(), "--check"});
        CHECK(check.code == 0);
        CHECK(check.err.empty());
        CHECK(check.out.find(": valid, ") != std::string::npos);
        const Result printed = cli.dsc({"run", config.string(), "--print-config"});
        CHECK(printed.code == 0);
        std::string text = printed.out;
        for (std::size_t at = 0; (at = text.find("DIR/", at)) != std::string::npos;)
            text.replace(at, 3, cli.folder().string());
        cli.write("again.yaml", text);
        CHECK(cli.dsc({"run", "again.yaml", "--print-config"}).out == printed.out);
        CHECK_FALSE(cli.exists("runs"));
    }
}

TEST_CASE("each sweep in configs/sweeps passes --check, which writes nothing") {
    const Cli cli;
    std::size_t sweeps = 0;
    for (const auto& entry : fs::directory_iterator(fs::path(DSC_SOURCE_DIR) / "configs/sweeps")) {
        CAPTURE(entry.path());
        const Result check = cli.dsc({"sweep", "expand", entry.path().string(), "--check"});
        CHECK(check.code == 0);
        CHECK(check.err.empty());
        CHECK(check.out.find(": valid, ") != std::string::npos);
        ++sweeps;
    }
    CHECK(sweeps >= 1);
    CHECK(fs::is_empty(cli.folder()));
}
