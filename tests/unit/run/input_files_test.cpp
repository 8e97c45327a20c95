#include <filesystem>

#include <doctest/doctest.h>

#include <dsc/base/error.hpp>
#include <dsc/run/input_files.hpp>
#include <dsc/run/sha256.hpp>

#include "fakes.hpp"

using namespace dsc;
using dsc::test::Folder;

namespace {

const std::string three = "0 0 0\n1 0 0\n0 1 0\n";
const std::string two = "0 0 0\n5 0 0\n";

}  // namespace

TEST_CASE("a file is hashed as it was at the first call") {
    const Folder folder;
    const auto file = folder.write("abc", "abc");
    run::InputFiles files;
    CHECK(files.sha256(file) == run::sha256("abc"));
    folder.write("abc", "other");
    CHECK(files.sha256(file) == run::sha256("abc"));
    CHECK_THROWS_AS(files.sha256(folder.path() / "none"), IoError);
}

TEST_CASE("the points of a cloud are those that were hashed, also under another name of the file") {
    const Folder folder;
    const auto file = folder.write("a.xyz", three);
    const auto link = folder.path() / "b.xyz";
    std::filesystem::create_symlink(file, link);
    run::InputFiles files;
    CHECK(files.sha256(file) == run::sha256(three));
    folder.write("a.xyz", two);
    CHECK(files.cloud(link, {}).cloud.points.size() == 3);
    CHECK(files.cloud(file, {}).report.points == 3);
    CHECK(files.take_cloud(link, {}).cloud.points.size() == 3);
    // Nothing is kept of a cloud that was handed over.
    CHECK(files.cloud(file, {}).cloud.points.size() == 2);
}

TEST_CASE("a cloud in memory is read like a file and hashed by its numbers") {
    cloud::Cloud cloud = cloud::cloud_of({{1, 2, 3}, {4, 5, 6}}, {{0, 0, 2}, {0, 0, 0}},
                                         {{1, 2, 3}, {255, 0, 7}}, "points");
    CHECK(cloud.normals[0] == Vec3(0, 0, 1));  // as in a file
    run::InputFiles files;
    const auto name = files.add_cloud("points", cloud);
    CHECK(name == "/memory/points");
    CHECK(run::is_memory(name));
    CHECK_FALSE(run::is_memory("/memory"));
    CHECK_FALSE(run::is_memory("/memoryless/points"));
    CHECK(files.exists(name));
    CHECK_FALSE(files.exists("/memory/others"));
    // printf of the doubles 1 to 6, of 0 0 1 0 0 0 and of the bytes 1 2 3 255 0 7 | sha256sum
    std::string bytes;
    for (const double value : {1., 2., 3., 4., 5., 6., 0., 0., 1., 0., 0., 0.})
        bytes.append(reinterpret_cast<const char*>(&value), sizeof(value));
    bytes.append("\x01\x02\x03\xff\x00\x07", 6);
    CHECK(files.sha256(name) == run::sha256(bytes));
    CHECK(files.bytes(name) == bytes.size());
    CHECK(files.take_cloud(name, {}).cloud.points.size() == 2);
    CHECK(files.take_cloud(name, {}).cloud.colours[1] == cloud::Colour{255, 0, 7});  // it is kept
    CHECK(files.cloud(name, {}).report.points == 2);
}

TEST_CASE("normals without a direction are no normals") {
    CHECK(cloud::cloud_of({{1, 2, 3}}, {{0, 0, 0}}, {}, "points").normals.empty());
}

TEST_CASE("a text in memory has a hash and a size") {
    run::InputFiles files;
    files.add_text("/memory/session.py", "abc");
    CHECK(files.sha256("/memory/session.py") == run::sha256("abc"));
    CHECK(files.bytes("/memory/session.py") == 3);
    CHECK_THROWS_AS(files.bytes("/memory/none"), IoError);
}

TEST_CASE("the same file by other columns is another cloud") {
    const Folder folder;
    const auto file = folder.write("a.xyz", "0 1 2\n3 4 5\n6 7 8\n");
    run::InputFiles files;
    CHECK(files.cloud(file, {}).cloud.points[0] == Vec3(0, 1, 2));
    CHECK(files.cloud(file, {"3", "2", "1"}).cloud.points[0] == Vec3(2, 1, 0));
}
