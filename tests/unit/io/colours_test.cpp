// Colours of the vertices of a surface.
#include <doctest/doctest.h>

#include <dsc/io/read.hpp>
#include <dsc/io/write.hpp>

#include "files.hpp"

using namespace dsc;
using namespace dsc::io;
using surface::TriangleMesh;

namespace {

using Colours = std::vector<std::array<std::uint8_t, 3>>;

const std::string ply_points =
    "ply\nformat ascii 1.0\nelement vertex 3\nproperty double x\nproperty "
    "double y\nproperty double z\n";
const std::string ply_faces =
    "element face 1\nproperty list uchar int vertex_indices\nend_header\n";

}  // namespace

TEST_CASE("every colour comes back from OBJ and PLY, and the coordinates with it") {
    const test::Folder folder;
    RandomStream random(RandomKey{5, 0, 0, 0});
    TriangleMesh m;
    for (int i = 0; i < 256; ++i) {
        m.points.emplace_back(random.normal(), random.normal() * 1e9, random.normal() * 1e-9);
        const auto byte = static_cast<std::uint8_t>(i);
        m.colours.push_back({byte, static_cast<std::uint8_t>(255 - i),
                             static_cast<std::uint8_t>(random.index(256))});
        if (i > 1)
            m.faces.push_back(
                {0, static_cast<std::uint32_t>(i - 1), static_cast<std::uint32_t>(i)});
    }
    for (const char* name : {"m.obj", "m.ply"}) {
        CAPTURE(name);
        write_surface(folder / name, m);
        const TriangleMesh back = read_surface(folder / name);
        CHECK(test::same_bits(back.points, m.points));
        CHECK(back.faces == m.faces);
        CHECK(back.colours == m.colours);
        const std::string first = test::content_of(folder / name);
        write_surface(folder / name, back);
        CHECK(test::content_of(folder / name) == first);
    }
    for (const char* name : {"m.off", "m.stl"}) {  // no room for them
        write_surface(folder / name, m);
        CHECK(read_surface(folder / name).colours.empty());
    }
}

TEST_CASE("what is written, byte for byte") {
    const test::Folder folder;
    const TriangleMesh m{
        {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}, {{255, 0, 51}, {0, 0, 0}, {1, 2, 3}}};
    write_surface(folder / "m.obj", m);
    CHECK(test::content_of(folder / "m.obj") ==
          "v 0 0 0 1 0 0.2\nv 1 0 0 0 0 0\nv 0 1 0 0.00392156862745098 0.00784313725490196 "
          "0.011764705882352941\nf 1 2 3\n");
    write_surface(folder / "m.ply", m);
    const std::string ply = test::content_of(folder / "m.ply");
    CHECK(ply.find("property double z\nproperty uchar red\nproperty uchar green\nproperty uchar "
                   "blue\nelement face 1\n") != std::string::npos);
    CHECK(ply.size() == ply.find("end_header\n") + 11 + 3 * 27 + 13);
}

TEST_CASE("OBJ: bytes and fractions, and a surface has all colours or none") {
    const test::Folder folder;
    const auto colours = [&](const std::string& vertices) {
        return read_surface(folder.with("m.obj", vertices + "f 1 2 3\n")).colours;
    };
    CHECK(colours("v 0 0 0 255 128 0\nv 1 0 0 0 0 1\nv 0 1 0 1 1 1\n") ==
          Colours{{255, 128, 0}, {0, 0, 1}, {1, 1, 1}});
    CHECK(colours("v 0 0 0 1 0.5 0\nv 1 0 0 0 0 1 # blue\nv 0 1 0 1 1 1\n") ==
          Colours{{255, 128, 0}, {0, 0, 255}, {255, 255, 255}});
    CHECK(colours("v 0 0 0 1 0.5 0\nv 1 0 0\nv 0 1 0 1 1 1\n").empty());
    CHECK(colours("v 0 0 0\nv 1 0 0 1 1 1\nv 0 1 0 1 1 1\n").empty());
    CHECK(colours("v 0 0 0 1\nv 1 0 0 1\nv 0 1 0 1\n").empty());  // weights
    CHECK(colours("v 0 0 0 1 1 1 1\nv 1 0 0 1 1 1 1\nv 0 1 0 1 1 1 1\n").empty());
    // as before colours were read
    CHECK(colours("v 0 0 0 a b c\nv 1 0 0 nan 0 0\nv 0 1 0 1 1 1\n").empty());
}

TEST_CASE("PLY: bytes only, and all three of them") {
    const test::Folder folder;
    const auto read = [&](const std::string& properties, const std::string& vertices) {
        return read_surface(folder.with("m.ply", ply_points + properties + ply_faces + vertices +
                                                     "3 0 1 2\n"))
            .colours;
    };
    CHECK(read("property uchar green\nproperty uchar red\nproperty float q\nproperty uchar blue\n",
               "0 0 0 1 2 0.5 3\n1 0 0 4 5 0.5 6\n0 1 0 7 8 0.5 255\n") ==
          Colours{{2, 1, 3}, {5, 4, 6}, {8, 7, 255}});
    CHECK(read("property uchar red\nproperty uchar green\n", "0 0 0 1 2\n1 0 0 1 2\n0 1 0 1 2\n")
              .empty());
    CHECK(read("property float red\nproperty float green\nproperty float blue\n",
               "0 0 0 1 1 1\n1 0 0 1 1 1\n0 1 0 1 1 1\n")
              .empty());
    const auto bad = test::refusal(
        folder.with("bad.ply",
                    ply_points + "property uchar red\nproperty uchar green\nproperty uchar blue\n" +
                        ply_faces + "0 0 0 1 2 3\n1 0 0 256 0 0\n0 1 0 0 0 0\n3 0 1 2\n"),
        [](const auto& file) { read_surface(file); });
    CHECK(bad.code == "io.syntax");
    CHECK(
        bad.message ==
        "FILE:14: colour 256 is not a byte (0 to 255); correct the line or export the file again");
}

TEST_CASE("colours that do not fit are not written") {
    const test::Folder folder;
    const TriangleMesh m{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}, {{255, 0, 51}}};
    for (const char* name : {"m.obj", "m.ply", "m.off", "m.stl"}) {
        CHECK_THROWS_WITH_AS(
            write_surface(folder / name, m),
            "surface: the mesh has 1 colour for 3 points; give one per point or none",
            GeometryError);
    }
    CHECK(folder.files() == 0);
}
