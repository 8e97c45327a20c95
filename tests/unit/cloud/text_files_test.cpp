#include <doctest/doctest.h>

#include <dsc/cloud/read.hpp>

#include "files.hpp"

using dsc::Vec3;
using dsc::cloud::Cloud;
using dsc::cloud::read_cloud;

namespace {
// Millimetres and less beside five million metres: floats would round these to half metres.
const std::vector<Vec3> far_points{{5000000.001, -5000000.002, 5123456.789},
                                   {5000000.0010000005, 4999999.9990000002, 0.1}};
const std::string far_lines[] = {"5000000.001 -5000000.002 5123456.789",
                                 "5000000.0010000005 4999999.9990000002 0.1"};

std::vector<Vec3> read(const test::Folder& folder, std::string_view name, std::string_view text) {
    return read_cloud(folder.write(name, text)).points;
}
}  // namespace

TEST_CASE("text keeps doubles far from the origin") {
    const test::Folder folder;
    CHECK(read(folder, "a.obj", "v " + far_lines[0] + "\nv " + far_lines[1] + "\n") == far_points);
    for (const char* name : {"a.xyz", "a.txt", "a.asc", "a.pts", "a.csv"})
        CHECK(read(folder, name, far_lines[0] + "\n" + far_lines[1] + "\n") == far_points);
}

TEST_CASE("OBJ: only vertices are read; colours are kept if all vertices have them") {
    const test::Folder folder;
    const std::vector<Vec3> expected{{1, 2, 3}, {-4, 5e-3, 6}};
    CHECK(read(folder, "a.obj",
               "\xEF\xBB\xBF# made by hand\no thing\nv 1 2 3\nvt 0 0\nvn 0 0 1\n\n\tv  -4\t+5e-3 6 "
               "# end\nf "
               "1 2 1\n") == expected);
    CHECK(read(folder, "a.OBJ", "v 1 2 3 1\rv -4 0.005 6 1") == expected);
    CHECK(read(folder, "a.obj", "v 1 2 3\r\nv -4 0.005 6\r\n") == expected);

    dsc::cloud::ReadReport report;
    const Cloud fractions =
        read_cloud(folder.write("b.obj", "v 1 2 3 1 0.5 0\nv 1 2 4 0 0 1\n"), &report);
    CHECK(report.format == "OBJ");
    CHECK(report.points == 2);
    CHECK(report.dropped_non_finite == 0);
    CHECK(fractions.source == folder.path("b.obj").string());
    REQUIRE(fractions.colours.size() == 2);
    CHECK(fractions.colours[0] == std::array<std::uint8_t, 3>{255, 128, 0});
    const Cloud bytes = read_cloud(folder.write("b.obj", "v 1 2 3 255 128 0\nv 1 2 4 0 0 1\n"));
    REQUIRE(bytes.colours.size() == 2);
    CHECK(bytes.colours[0] == std::array<std::uint8_t, 3>{255, 128, 0});
    CHECK(bytes.colours[1] == std::array<std::uint8_t, 3>{0, 0, 1});
    CHECK(read_cloud(folder.write("b.obj", "v 1 2 3 1 0 0\nv 1 2 4\n")).colours.empty());
}

TEST_CASE("XYZ: separators, headers, comments, further columns and counts") {
    const test::Folder folder;
    const std::vector<Vec3> expected{{1, 2, 3}, {-4, 5.5, 6}};
    for (const char* text : {
             "1 2 3\n-4 5.5 6\n",
             "1 2 3\n-4 5.5 6",
             "1\t2\t3\r\n-4\t5.5\t6\r\n",
             "  1   2 3  \n\n -4 5.5 6 \n\n",
             "1,2,3\n-4,5.5,6\n",
             "1, 2, 3,\n-4 ,\t5.5, 6,\n",
             "1;2;3\n-4; 5.5 ;6\n",
             "x y z\n1 2 3\n-4 5.5 6\n",
             "\"X\";\"Y\";\"Z\";\"Intensity\"\n1;2;3;77\n-4;5.5;6;78\n",
             "//X,Y,Z\n# note\n1,2,3\n// more\n-4,5.5,6\n",
             "1 2 3 255 0 0 label\n-4 5.5 6 0 255 0 label\n",
             "1 2 3\n-4 5.5 6 9\n",
             "+1 2.0e0 3.\n-4 +5.5 6\n",
             "2\n1 2 3\n-4 5.5 6\n",
             "1\n1 2 3 0.5\n1\n-4 5.5 6 0.5\n",
         })
        CHECK_MESSAGE(read(folder, "a.pts", text) == expected, text);
    CHECK(read(folder, "tiny.xyz", "1e-400 0 -0\n").front() == Vec3(0, 0, 0));
    dsc::cloud::ReadReport report;
    read_cloud(folder.path("tiny.xyz"), &report);
    CHECK(report.format == "XYZ");
    CHECK(report.points == 1);
}
