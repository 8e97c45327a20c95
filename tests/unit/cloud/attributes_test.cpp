// What files give besides positions: normals, colours of every kind, the scanner's place; and the
// list of it all.
#include <doctest/doctest.h>

#include <dsc/base/random.hpp>
#include <dsc/cloud/read.hpp>
#include <dsc/cloud/write.hpp>

#include "files.hpp"

using dsc::Vec3;
using namespace dsc::cloud;

namespace {

using Colours = std::vector<Colour>;
using Normals = std::vector<Vec3>;

class Files {
public:
    Cloud read(std::string_view name, std::string_view text,
               const std::vector<std::string>& columns = {}) {
        return read_cloud(folder_.write(name, text), &report_, {columns});
    }
    /// "x: position, nx: normal, quality: -"
    std::string properties(std::string_view name, std::string_view text) {
        read(name, text);
        std::string all;
        for (const FoundProperty& p : report_.properties)
            all += (all.empty() ? "" : ", ") + p.name + ": " + (p.use.empty() ? "-" : p.use);
        return all;
    }

private:
    test::Folder folder_;
    ReadReport report_;
};

/// An ascii PLY of two points, (1 2 3) and (4 5 6), with these further properties.
std::string ply_file(std::string_view properties, std::string_view first, std::string_view second) {
    std::string text = "ply\nformat ascii 1.0\nelement vertex 2\nproperty float x\nproperty float "
                       "y\nproperty float z\n";
    text.append(properties)
        .append("end_header\n1 2 3 ")
        .append(first)
        .append("\n4 5 6 ")
        .append(second)
        .append("\n");
    return text;
}

std::string ply_colours(const std::string& type, std::string_view first, std::string_view second,
                        const std::string& prefix = "") {
    std::string properties;
    for (const char* channel : {"red", "green", "blue"})
        properties += "property " + type + " " + prefix + channel + "\n";
    return ply_file(properties, first, second);
}

std::string pcd_file(const std::string& fields, const std::string& sizes, const std::string& types,
                     const std::string& rows, const std::string& place = "0 0 0", int height = 1) {
    std::string count;
    for (std::size_t i = 0;
         i <= static_cast<std::size_t>(std::count(fields.begin(), fields.end(), ' ')); ++i)
        count += " 1";
    return "VERSION 0.7\nFIELDS " + fields + "\nSIZE " + sizes + "\nTYPE " + types + "\nCOUNT" +
           count + "\nWIDTH " + std::to_string(2 / height) + "\nHEIGHT " + std::to_string(height) +
           "\nVIEWPOINT " + place + " 1 0 0 0\nPOINTS 2\nDATA ascii\n" + rows;
}

}  // namespace

TEST_CASE("PLY: colours of every type") {
    Files files;
    const Colours expected{{255, 128, 0}, {0, 0, 1}};
    CHECK(files.read("a.ply", ply_colours("uchar", "255 128 0", "0 0 1")).colours == expected);
    CHECK(files.read("a.ply", ply_colours("uchar", "255 128 0", "0 0 1", "diffuse_")).colours ==
          expected);
    CHECK(files.read("a.ply", ply_colours("ushort", "65535 32896 0", "0 0 257")).colours ==
          expected);
    CHECK(files.read("a.ply", ply_colours("uint16", "255 128 0", "0 0 1")).colours ==
          expected);  // bytes in wider numbers
    CHECK(files.read("a.ply", ply_colours("uint16", "1 1 0", "0 0 1")).colours ==
          Colours{{1, 1, 0}, {0, 0, 1}});
    CHECK(files.read("a.ply", ply_colours("float", "1 0.5 0", "0 0 0.00392157")).colours ==
          expected);
    CHECK(files.read("a.ply", ply_colours("double", "255 128 0", "0 0 1")).colours == expected);
    CHECK(files.read("a.ply", ply_colours("float", "1 0.5 nan", "0 -1 0")).colours ==
          Colours{{255, 128, 0}, {0, 0, 0}});
    CHECK(
        files.read("a.ply", ply_file("property uint16 red\nproperty uint16 green\n", "9 9", "9 9"))
            .colours.empty());
}

TEST_CASE("intensities are greys where there are no colours") {
    Files files;
    CHECK(files.read("a.ply", ply_file("property float intensity\n", "0.5", "2.5")).colours ==
          Colours{{0, 0, 0}, {255, 255, 255}});
    CHECK(files.read("a.ply", ply_file("property float scalar_Intensity\n", "2", "1")).colours ==
          Colours{{255, 255, 255}, {0, 0, 0}});
    CHECK(files.read("a.csv", "x,y,z,Intensity\n1,2,3,10\n4,5,6,20\n7,8,9,15\n").colours ==
          Colours{{0, 0, 0}, {255, 255, 255}, {128, 128, 128}});
    CHECK(
        files.read("a.pcd", pcd_file("x y z intensity", "4 4 4 4", "F F F F", "1 2 3 7\n4 5 6 7\n"))
            .colours == Colours{{0, 0, 0}, {0, 0, 0}});
    CHECK(files.read("a.csv", "x,y,z,intensity,r,g,b\n1,2,3,10,1,2,3\n4,5,6,20,4,5,6\n").colours ==
          Colours{{1, 2, 3}, {4, 5, 6}});
}

TEST_CASE("PCD: colours packed, apart, and as a decimal number") {
    Files files;
    const Colours expected{{255, 128, 0}, {0, 0, 1}};
    CHECK(
        files
            .read("a.pcd", pcd_file("x y z rgb", "4 4 4 4", "F F F U", "1 2 3 16744448\n4 5 6 1\n"))
            .colours == expected);
    CHECK(files
              .read("a.pcd", pcd_file("x y z r g b", "4 4 4 1 1 1", "F F F U U U",
                                      "1 2 3 255 128 0\n4 5 6 0 0 1\n"))
              .colours == expected);
    CHECK(files
              .read("a.pcd", pcd_file("x y z r g b", "4 4 4 2 2 2", "F F F U U U",
                                      "1 2 3 65535 32896 0\n4 5 6 0 0 257\n"))
              .colours == expected);
}

TEST_CASE("normals of PLY and PCD, scaled to unit vectors; one without a direction is zero") {
    Files files;
    const std::string properties = "property float nx\nproperty float ny\nproperty float nz\n";
    const Normals expected{{0, 0, 1}, {0.6, 0.8, 0}};
    CHECK(files.read("a.ply", ply_file(properties, "0 0 1", "3 4 0")).normals == expected);
    const std::string fields = "x y z normal_x normal_y normal_z", types = "F F F F F F";
    CHECK(files.read("a.pcd", pcd_file(fields, "4 4 4 8 8 8", types, "1 2 3 0 0 1\n4 5 6 3 4 0\n"))
              .normals == expected);
    CHECK(files.read("a.ply", ply_file(properties, "nan 0 1", "3 4 0")).normals ==
          Normals{{0, 0, 0}, {0.6, 0.8, 0}});
    CHECK(files.read("a.ply", ply_file(properties, "0 0 0", "1e-30 0 0")).normals ==
          Normals{{0, 0, 0}, {1, 0, 0}});
    CHECK(files.read("a.ply", ply_file(properties, "0 0 0", "nan nan nan")).normals.empty());
    CHECK(files.read("a.ply", ply_file("property float nx\nproperty float ny\n", "0 1", "1 0"))
              .normals.empty());
    // A point that is dropped takes its normal with it.
    CHECK(
        files.read("a.pcd", pcd_file(fields, "4 4 4 4 4 4", types, "nan 2 3 0 0 1\n4 5 6 0 1 0\n"))
            .normals == Normals{{0, 1, 0}});
}

TEST_CASE("normals of text clouds: named, and unit vectors without a name") {
    Files files;
    const Normals expected{{0, 0, 1}, {0.6, 0.8, 0}};
    CHECK(files.read("a.csv", "x,y,z,nx,ny,nz\n1,2,3,0,0,1\n4,5,6,.6,.8,0\n").normals == expected);
    CHECK(files.read("a.txt", "//X Y Z R G B Nx Ny Nz\n1 2 3 9 9 9 0 0 1\n4 5 6 9 9 9 3 4 0\n")
              .normals == expected);
    CHECK(files.read("a.csv", "normal_z,normal_y,normal_x,x,y,z\n1,0,0,1,2,3\n0,.8,.6,4,5,6\n")
              .normals == expected);
    CHECK(files.read("a.csv", "x,y,z,nx,ny,nz\n1,2,3,.6,.8,0\n4,5,6,,,\n").normals ==
          Normals{{0.6, 0.8, 0}, {0, 0, 0}});
    const Cloud six = files.read("a.xyz", "1 2 3 0 0 1\n4 5 6 0.6 0.8 0\n");
    CHECK(six.normals == expected);
    CHECK(six.colours.empty());
    const Cloud nine = files.read("a.xyz", "1 2 3 255 0 0 0 0 1\n4 5 6 9 9 9 0.6 0.8 0\n");
    CHECK(nine.normals == expected);
    CHECK(nine.colours == Colours{{255, 0, 0}, {9, 9, 9}});
    const Cloud other = files.read("a.xyz", "1 2 3 0 0 1 255 0 0\n4 5 6 0.6 0.8 0 9 9 9\n");
    CHECK(other.normals == expected);
    CHECK(other.colours == nine.colours);
    CHECK(files.read("a.xyz", "1 2 3 0 0 1\n4 5 6 0.6 0.7 0\n").normals.empty());
    CHECK(files.read("a.xyz", "1 2 3 0 0 1\n4 5 6\n").normals.empty());
    CHECK(files.read("a.xyz", "1 2 3 0 0 1\n4 5 6 0 1 0\n", {"1", "2", "3"}).normals.empty());
}

TEST_CASE("normals of OBJ: one per point in order, or by the corners of faces") {
    Files files;
    const Normals expected{{0, 0, 1}, {0.6, 0.8, 0}, {1, 0, 0}};
    CHECK(
        files.read("a.obj", "vn 0 0 1\nv 1 2 3\nvn 3 4 0\nv 4 5 6\nvn 2 0 0\nv 7 8 8\n").normals ==
        expected);
    CHECK(files
              .read("a.obj",
                    "v 1 2 3\nv 4 5 6\nv 7 8 8\nvn 2 0 0\nvn 0 0 1\nvn 3 4 0\nf 1//2 2//3 3//1\n")
              .normals == expected);
    CHECK(files
              .read("a.obj", "v 1 2 3\nv 4 5 6\nv 7 8 8\nvn 2 0 0\nvn 0 0 1\nvn 3 4 0\nf -3/1/-2 "
                             "-2/1/-1 -1/1/-3\n")
              .normals == expected);
    // Two normals at one point: their mean. A corner that names nothing is none.
    CHECK(files
              .read("a.obj",
                    "v 1 2 3\nv 4 5 6\nvn 0 0 1\nvn 0 2 0\nf 1//1 2//1 9//1\nf 1//2 1//7 1/1/x\n")
              .normals == Normals{Vec3(0, 1, 1).normalized(), {0, 0, 1}});
    CHECK(files.read("a.obj", "v 1 2 3\nv 4 5 6\nvn 0 0 1\n").normals.empty());
    test::Folder folder;
    const auto path = folder.write("a.obj", "v 1 2 3\nvn 0 1\n");
    CHECK(folder.strip(test::error_of([&] { read_cloud(path); })) ==
          "io.syntax 6: a.obj:2: the normal has fewer than 3 numbers; a 'vn' line is 'vn x y z'; "
          "the file may be cut off, write it again");
}

TEST_CASE("PCD: where the scanner stood") {
    Files files;
    const auto sensor = [&](const std::string& place, int height) {
        return files
            .read("a.pcd", pcd_file("x y z", "4 4 4", "F F F", "1 2 3\n4 5 6\n", place, height))
            .sensor;
    };
    REQUIRE(sensor("0 0 0", 1).has_value());
    CHECK_FALSE(sensor("0 0 0", 1)->stated);
    CHECK(sensor("0 0 0", 2)->stated);
    CHECK(sensor("1 -2 0.5", 1)->stated);
    CHECK(sensor("1 -2 0.5", 1)->position == Vec3(1, -2, 0.5));
    CHECK_FALSE(sensor("nan 0 0", 1).has_value());
    CHECK_FALSE(files.read("a.ply", ply_file("", "", "")).sensor.has_value());
}

TEST_CASE("every property is listed with its use") {
    Files files;
    CHECK(files.properties(
              "a.ply",
              ply_file("property float nx\nproperty float ny\nproperty float nz\nproperty uchar "
                       "red\nproperty uchar green\nproperty uchar blue\nproperty float quality\n",
                       "0 0 1 9 9 9 7", "0 0 1 9 9 9 7")) ==
          "x: position, y: position, z: position, nx: normal, ny: normal, nz: normal, red: colour, "
          "green: colour, blue: colour, quality: -");
    CHECK(files.properties("a.ply",
                           ply_file("property float nx\nproperty float ny\nproperty float nz\n",
                                    "0 0 0", "0 0 0")) ==
          "x: position, y: position, z: position, nx: -, ny: -, nz: -");
    CHECK(files.properties("a.pcd", pcd_file("x y z rgb intensity", "4 4 4 4 4", "F F F U F",
                                             "1 2 3 9 1\n4 5 6 1 1\n")) ==
          "x: position, y: position, z: position, rgb: colour, intensity: -");
    CHECK(files.properties("a.csv", "id,X,Y,Z,intensity\n1,2,3,4,5\n2,3,4,5,6\n") ==
          "id: -, X: position, Y: position, Z: position, intensity: colour (grey)");
    CHECK(files.properties("a.xyz", "1 2 3 0 0 1\n4 5 6 0 1 0\n") ==
          "x: position, y: position, z: position, nx: normal, ny: normal, nz: normal");
    CHECK(files.properties("a.xyz", "1 2 3 0.5\n4 5 6 7\n") ==
          "x: position, y: position, z: position, column 4: -");
    CHECK(files.properties("a.obj", "v 1 2 3 1 0 0\nv 4 5 6 0 0 1\nvn 0 0 1\nvn 0 1 0\n") ==
          "x: position, y: position, z: position, r: colour, g: colour, b: colour, nx: normal, ny: "
          "normal, nz: normal");
}

TEST_CASE("normals and colours come back from every format, bit for bit") {
    const test::Folder folder;
    dsc::RandomStream random({3, 0, 0, 0});
    Cloud cloud;
    for (int i = 0; i < 300; ++i) {
        cloud.points.emplace_back(random.normal(), random.normal(), random.normal());
        cloud.normals.push_back(
            Vec3(random.normal(), random.normal(), random.normal()).normalized());
        cloud.colours.push_back({static_cast<std::uint8_t>(random.index(256)), 2, 255});
    }
    const Colours colours = cloud.colours;
    for (const bool coloured : {true, false}) {
        cloud.colours = coloured ? colours : Colours();
        for (const char* name : {"a.ply", "a.pcd", "a.csv", "a.xyz", "a.obj"}) {
            CAPTURE(name);
            write_cloud(folder.path(name), cloud);
            const Cloud again = read_cloud(folder.path(name));
            CHECK(again.points == cloud.points);
            CHECK(again.normals == cloud.normals);
            CHECK(again.colours == cloud.colours);
        }
    }
}
