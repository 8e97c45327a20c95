#include <doctest/doctest.h>

#include <dsc/base/random.hpp>
#include <dsc/cloud/read.hpp>
#include <dsc/cloud/write.hpp>

#include "files.hpp"

using dsc::cloud::Cloud;

TEST_CASE("what is written reads back bit for bit") {
    const test::Folder folder;
    dsc::RandomStream random({7, 0, 0, 0});
    Cloud cloud;
    for (int i = 0; i < 500; ++i) {
        const double x = random.uniform(5e6, 5e6 + 1), y = random.normal() * 1e-7,
                     z = -random.uniform() * 1e300;
        cloud.points.emplace_back(x, y, z);
        std::array<std::uint8_t, 3> colour;
        for (std::uint8_t& c : colour) c = static_cast<std::uint8_t>(random.index(256));
        cloud.colours.push_back(colour);
    }
    for (const std::string name :
         {"a.xyz", "a.txt", "a.asc", "a.pts", "a.csv", "a.obj", "a.ply", "a.PLY", "a.pcd"}) {
        CAPTURE(name);
        dsc::cloud::write_cloud(folder.path(name), cloud);
        const Cloud again = dsc::cloud::read_cloud(folder.path(name));
        CHECK(again.points == cloud.points);
        CHECK(again.colours == cloud.colours);
        const std::string first = test::slurp(folder.path(name));
        dsc::cloud::write_cloud(folder.path(name), again);
        CHECK(test::slurp(folder.path(name)) == first);
    }
    cloud.colours.clear();
    // over the old files
    for (const std::string name : {"a.xyz", "a.csv", "a.obj", "a.ply", "a.pcd"}) {
        dsc::cloud::write_cloud(folder.path(name), cloud);
        const Cloud again = dsc::cloud::read_cloud(folder.path(name));
        CHECK(again.points == cloud.points);
        CHECK(again.colours.empty());
    }
}

TEST_CASE("a failed write names its cause and leaves nothing behind") {
    const test::Folder folder;
    const Cloud cloud{{{1, 2, 3}}};
    const auto error = [&](std::string_view name) {
        return folder.strip(
            test::error_of([&] { dsc::cloud::write_cloud(folder.path(name), cloud); }));
    };
    const std::string accepted = "accepted are .pcd .ply .obj .xyz .txt .asc .pts .csv";
    CHECK(error("a.stl") == "io.format 6: a.stl: clouds cannot be written as '.stl'; " + accepted);
    CHECK(error("a") == "io.format 6: a: the file's name has no extension; " + accepted);
    CHECK(error("none/a.xyz") == "io.write 6: none/a.xyz: cannot be written: No such file or "
                                 "directory; create the folder first or name another one");
    std::filesystem::create_directory(folder.path("taken.xyz"));
    CHECK(error("taken.xyz") == "io.write 6: taken.xyz: is a directory; name a file");
    std::size_t files = 0;
    for ([[maybe_unused]] const auto& entry : std::filesystem::directory_iterator(folder.path(".")))
        ++files;
    CHECK(files == 1);
}
