// Unit normals of the vertices of a surface, as viewers read them.
#include <doctest/doctest.h>

#include <dsc/io/read.hpp>
#include <dsc/io/write.hpp>
#include <dsc/surface/measure.hpp>

#include "files.hpp"

using namespace dsc;
using namespace dsc::io;
using surface::TriangleMesh;

namespace {

/// A regular tetrahedron round the origin: the normal of a vertex is along its position.
TriangleMesh regular_tetrahedron() {
    return {{{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}},
            {{0, 1, 2}, {0, 3, 1}, {0, 2, 3}, {1, 3, 2}}};
}

}  // namespace

TEST_CASE("normals of vertices are written, byte for byte") {
    const test::Folder folder;
    const TriangleMesh m{
        {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}, {{255, 0, 51}, {0, 0, 0}, {0, 0, 0}}};
    const std::vector<Vec3> normals = {{0, 0, 1}, {0, 0.6, 0.8}, {0, 0, 1}};
    write_surface(folder / "m.obj", m, {}, normals);
    CHECK(test::content_of(folder / "m.obj") ==
          "v 0 0 0 1 0 0.2\nv 1 0 0 0 0 0\nv 0 1 0 0 0 0\nvn 0 0 1\nvn 0 0.6 0.8\nvn 0 0 1\nf 1//1 "
          "2//2 3//3\n");
    write_surface(folder / "m.ply", m, {{"gap", {1, 2, 3}}}, normals);
    const std::string ply = test::content_of(folder / "m.ply");
    CHECK(ply.find("property double z\nproperty float nx\nproperty float ny\nproperty float "
                   "nz\nproperty uchar red\nproperty uchar green\nproperty uchar blue\nproperty "
                   "double gap\nelement face 1\n") != std::string::npos);
    CHECK(ply.size() == ply.find("end_header\n") + 11 + 3 * (24 + 12 + 3 + 8) + 13);
}

TEST_CASE("a surface with normals reads back as the same surface") {
    const test::Folder folder;
    const TriangleMesh m = regular_tetrahedron();
    const std::vector<Vec3> normals = surface::vertex_normals(m);
    for (std::size_t i = 0; i < 4; ++i)
        CHECK(normals[i].dot(m.points[i].normalized()) == doctest::Approx(1.0));
    for (const char* name : {"m.obj", "m.ply", "m.off", "m.stl"}) {
        CAPTURE(name);
        write_surface(folder / name, m, {}, normals);
        const TriangleMesh back = read_surface(folder / name);
        CHECK(back.points.size() == 4);
        CHECK(back.faces.size() == 4);
        if (std::string(name) != "m.stl") {
            CHECK(test::same_bits(back.points, m.points));
            CHECK(back.faces == m.faces);
        }
    }
    std::vector<DataArray> further;
    read_surface(folder / "m.ply", &further);
    CHECK(further.empty());
}

TEST_CASE("normals that do not fit are not written") {
    const test::Folder folder;
    const std::vector<Vec3> three(3, Vec3(0, 0, 1));
    for (const char* name : {"m.obj", "m.ply", "m.off", "m.stl"}) {
        CHECK_THROWS_WITH_AS(
            write_surface(folder / name, regular_tetrahedron(), {}, three),
            "surface: the mesh has 3 normals for 4 points; give one per point or none",
            GeometryError);
    }
    CHECK(folder.files() == 0);
}
