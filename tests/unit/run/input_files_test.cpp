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

TEST_CASE("the same file by other columns is another cloud") {
    const Folder folder;
    const auto file = folder.write("a.xyz", "0 1 2\n3 4 5\n6 7 8\n");
    run::InputFiles files;
    CHECK(files.cloud(file, {}).cloud.points[0] == Vec3(0, 1, 2));
    CHECK(files.cloud(file, {"3", "2", "1"}).cloud.points[0] == Vec3(2, 1, 0));
}
