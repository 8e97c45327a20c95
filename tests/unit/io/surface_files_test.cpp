#include <clocale>
#include <cmath>

#include <doctest/doctest.h>

#include <dsc/base/log.hpp>
#include <dsc/io/formats.hpp>
#include <dsc/io/read.hpp>
#include <dsc/io/write.hpp>

#include "files.hpp"

using namespace dsc;
using namespace dsc::io;
using surface::TriangleMesh;

namespace {
using Faces = std::vector<std::array<std::uint32_t, 3>>;
const Faces one_face = {{0, 1, 2}};
const std::vector<Vec3> corner = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};

TriangleMesh one_triangle() {
    TriangleMesh mesh;
    mesh.points = corner;
    mesh.faces = one_face;
    return mesh;
}

TriangleMesh read_text(const std::string& name, const std::string& content) {
    const test::Folder folder;
    return read_surface(folder.with(name, content));
}
}  // namespace

TEST_CASE("format table") {
    CHECK(surface_extensions() == ".obj, .ply, .off, .stl, .glb");
    CHECK(readable_surface_extensions() == ".obj, .ply, .off, .stl");
    CHECK(volume_extensions() == ".vtu, .dsc, .msh, .mesh");
    CHECK(readable_volume_extensions() == ".vtu, .dsc");
    CHECK(find_format("a/b.OBJ")->name == "Wavefront OBJ");
    CHECK(find_format("x.vtu")->volume);
    CHECK(find_format("x.xyz") == nullptr);
    CHECK(find_format("obj") == nullptr);
    CHECK(formats().size() == 9);
}

TEST_CASE("obj, off and ply keep every bit") {
    const test::Folder folder;
    const TriangleMesh m = test::awkward_mesh();
    for (const char* name : {"m.obj", "m.off", "m.ply"}) {
        CAPTURE(name);
        write_surface(folder / name, m);
        const TriangleMesh back = read_surface(folder / name);
        CHECK(test::same_bits(back.points, m.points));
        CHECK(back.faces == m.faces);
        const std::string first = test::content_of(folder / name);
        write_surface(folder / name, back);
        CHECK(test::content_of(folder / name) == first);
    }
    CHECK(folder.files() == 3);
}

TEST_CASE("random doubles of all magnitudes survive text") {
    RandomStream random(RandomKey{1, 0, 0, 0});
    TriangleMesh m;
    for (int i = 0; i < 3000; ++i) {
        const auto any = [&] {
            return std::ldexp(random.uniform(-1, 1), static_cast<int>(random.index(2000)) - 1000);
        };
        m.points.emplace_back(any(), any(), any());
    }
    m.faces = one_face;
    const test::Folder folder;
    for (const char* name : {"m.obj", "m.off"}) {
        write_surface(folder / name, m);
        CHECK(test::same_bits(read_surface(folder / name).points, m.points));
    }
}

TEST_CASE("what is written, byte for byte") {
    const test::Folder folder;
    TriangleMesh m;
    m.points = {{0, 0.1, -2.5e-9}, {1e22, 0, 0}, {0, 1, 0}};
    m.faces = one_face;
    write_surface(folder / "m.obj", m);
    CHECK(test::content_of(folder / "m.obj") ==
          "v 0 0.1 -2.5e-09\nv 1e+22 0 0\nv 0 1 0\nf 1 2 3\n");
    write_surface(folder / "m.off", m);
    CHECK(test::content_of(folder / "m.off") ==
          "OFF\n3 1 0\n0 0.1 -2.5e-09\n1e+22 0 0\n0 1 0\n3 0 1 2\n");
    write_surface(folder / "m.ply", m);
    const std::string ply = test::content_of(folder / "m.ply");
    const std::string header =
        "ply\nformat binary_little_endian 1.0\nelement vertex 3\nproperty double x\nproperty "
        "double y\n"
        "property double z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n";
    CHECK(ply.substr(0, header.size()) == header);
    CHECK(ply.size() == header.size() + 3 * 24 + 13);
    write_surface(folder / "m.stl", m);
    CHECK(test::content_of(folder / "m.stl").size() == 84 + 50);
}

TEST_CASE("stl: joined corners, floats, order of first appearance") {
    const test::Folder folder;
    TriangleMesh m;
    m.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0.1, 0, 1}};
    m.faces = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};
    write_surface(folder / "m.stl", m);
    const TriangleMesh back = read_surface(folder / "m.stl");
    REQUIRE(back.points.size() == 4);
    CHECK(back.faces == Faces{{0, 1, 2}, {0, 2, 3}, {2, 1, 3}, {1, 0, 3}});
    CHECK(back.points[3].x() == static_cast<double>(0.1F));
}

TEST_CASE("stl far from the origin is centred before the cast and read back in place") {
    const test::Folder folder;
    TriangleMesh m;
    const Vec3 far(5123456.789, -4000000.125, 3.5e6);
    m.points = {far, far + Vec3(0.001, 0, 0), far + Vec3(0, 0.001, 0), far + Vec3(0, 0, 0.001)};
    m.faces = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};
    write_surface(folder / "m.stl", m);
    CHECK(test::content_of(folder / "m.stl").substr(0, 23) == "dsc surface, add centre");
    const TriangleMesh back = read_surface(folder / "m.stl");
    REQUIRE(back.points.size() == 4);
    // A float at 5e6 would be off by up to 0.25. The centre is rounded to a float, so the rest has
    // a size of up to 0.5.
    for (std::size_t f = 0; f < 4; ++f) {
        for (std::size_t k = 0; k < 3; ++k) {
            CHECK((back.points[back.faces[f][k]] - m.points[m.faces[f][k]]).norm() < 1e-7);
        }
    }
}

TEST_CASE(
    "obj: polygons, negative indices, corners with texture and normal, comments, continued lines") {
    const TriangleMesh m = read_text(
        "m.obj", "# head\nmtllib a.mtl\no thing\nv 0 0 0 1.0\nv 1 0 0 0.5 0.5 0.5\n v\t1 1 0\r\n"
                 "v 0 1 0 # last\nvt 0 0\nvn 0 0 1\ng a b\nusemtl m\ns off\n\n"
                 "f 1 2 3 4\nf -4/1 -3/1/1 -2//1 # fan\nf 1 \\\n 2 \\\n 4\nl 1 2\np 1");
    CHECK(m.points.size() == 4);
    CHECK(m.faces == Faces{{0, 1, 2}, {0, 2, 3}, {0, 1, 2}, {0, 1, 3}});
}

TEST_CASE("obj: faces may come before their vertices, numbers may have a plus sign") {
    const TriangleMesh m = read_text("m.obj", "f 1 2 3\nv 0 0 0\nv +1 0 0\nv 0 +1e0 0");
    CHECK(m.points == corner);
    CHECK(m.faces == one_face);
}

TEST_CASE("off: counts on the first line, comments, colours, polygons") {
    const TriangleMesh m = read_text(
        "m.off",
        "# c\nCOFF 4 2 0 # counts\n\n0 0 0 255 0 0\n1 0 0 0 0 0\n0 1 0 0 0 0\n1 1 0 0 0 0\n"
        "4 0 1 3 2 0.5 0.5 0.5\n# between\n3 0 1 2\n\n");
    CHECK(m.points.size() == 4);
    CHECK(m.faces == Faces{{0, 1, 3}, {0, 3, 2}, {0, 1, 2}});
}

TEST_CASE("ply: text with further elements and properties, floats by their own value") {
    const TriangleMesh m =
        read_text("m.ply", "ply\r\nformat ascii 1.0\r\ncomment made by hand\r\nobj_info "
                           "x\r\nelement material 1\r\nproperty int "
                           "a\r\n"
                           "property list uchar float b\r\nelement vertex 4\r\nproperty uchar "
                           "red\r\nproperty float z\r\n"
                           "property float x\r\nproperty float y\r\nelement face 2\r\nproperty "
                           "list uint8 int32 vertex_index\r\n"
                           "property float quality\r\nend_header\r\n7 2 0.5 nan\r\n9 3 1 2\r\n9 "
                           "0.1 0 0\r\n9 0 1 0\r\n9 0 0 "
                           "1\r\n"
                           "3 0 1 2 nan\r\n4 0 1 2 3 1\r\n");
    CHECK(m.points[0] == Vec3(1, 2, 3));
    CHECK(m.points[1] == Vec3(0, 0, 0.1));
    CHECK(m.faces == Faces{{0, 1, 2}, {0, 1, 2}, {0, 2, 3}});
}

TEST_CASE("ply: big endian, small types, trailing line feed") {
    std::string file = "ply\nformat binary_big_endian 1.0\nelement vertex 3\nproperty short "
                       "x\nproperty float y\nproperty int z\n"
                       "element extra 2\nproperty list ushort double junk\nelement face "
                       "1\nproperty list int ushort vertex_indices\n"
                       "property uchar flag\nend_header\n";
    const auto bytes = [&](std::initializer_list<int> list) {
        for (const int b : list) file += static_cast<char>(b);
    };
    bytes({0xff, 0xfe, 0x3f, 0x80, 0, 0, 0, 0, 1, 0});     // -2, 1, 256
    bytes({0, 1, 0, 0, 0, 0, 0, 0, 0, 0});                 // 1, 0, 0
    bytes({0, 0, 0xc0, 0, 0, 0, 0xff, 0xff, 0xff, 0xff});  // 0, -2, -1
    bytes({0, 0, 0, 1, 0x7f, 0xf8, 0, 0, 0, 0, 0, 0});     // empty list, list of a NaN
    bytes({0, 0, 0, 3, 0, 0, 0, 1, 0, 2, 5, '\n'});        // the face
    const TriangleMesh m = read_text("m.ply", file);
    CHECK(m.points == std::vector<Vec3>{{-2, 1, 256}, {1, 0, 0}, {0, -2, -1}});
    CHECK(m.faces == one_face);
}

TEST_CASE("stl: text, several solids, names, odd spacing") {
    const char* text = "solid first thing\n facet normal 0 0 1\n  outer loop\n   vertex 0 0 0\n   "
                       "vertex 1 0 0\n   vertex 0 1 0\n"
                       "  endloop\n endfacet\nendsolid first\n\nsolid\nfacet normal nan nan "
                       "nan\nouter loop\nvertex 0 1e0 0\n"
                       "vertex 1 0 -0\nvertex 0.1 0.1 5\nendloop\nendfacet\nendsolid";
    const TriangleMesh m = read_text("m.stl", text);
    CHECK(m.points.size() == 4);
    CHECK(m.points[3].x() == 0.1);  // text is not rounded to float
    CHECK(m.faces == Faces{{0, 1, 2}, {2, 1, 3}});
}

TEST_CASE("stl: a binary file that begins with 'solid' is known by its size") {
    const test::Folder folder;
    const TriangleMesh m = one_triangle();
    write_surface(folder / "m.stl", m);
    std::string bytes = test::content_of(folder / "m.stl");
    bytes.replace(0, 11, "solid thing");
    CHECK(read_surface(folder.with("n.stl", bytes)).faces == one_face);
}

TEST_CASE("numbers do not depend on the locale") {
    const char* old = std::setlocale(LC_ALL, nullptr);
    const std::string before = old != nullptr ? old : "C";
    const char* comma = std::setlocale(LC_ALL, "de_DE.UTF-8");
    const TriangleMesh m = read_text("m.obj", "v 0.5 1e3 -.25\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    std::setlocale(LC_ALL, before.c_str());
    CHECK(m.points[0] == Vec3(0.5, 1000, -0.25));
    if (comma == nullptr) MESSAGE("no German locale here: read with the default one");
}

TEST_CASE("a mesh that is not sound is not written") {
    const test::Folder folder;
    TriangleMesh m;
    m.points = corner;
    m.faces = {{0, 1, 3}};
    CHECK_THROWS_WITH_AS(write_surface(folder / "m.obj", m),
                         "surface: face 0 refers to point 3 of 3; remove the face or add the point",
                         GeometryError);
    CHECK(folder.files() == 0);
}

TEST_CASE("an unknown extension is refused by readers and writers") {
    const test::Folder folder;
    const TriangleMesh m = one_triangle();
    const auto written =
        test::refusal(folder / "m.step", [&](const auto& file) { write_surface(file, m); });
    CHECK(written.code == "io.format");
    CHECK(written.message == "FILE: a surface cannot be written with this extension; use one of "
                             ".obj, .ply, .off, .stl, .glb");
    const auto read =
        test::refusal(folder / "m.vtu", [&](const auto& file) { read_surface(file); });
    CHECK(read.code == "io.format");
    CHECK(read.message == "FILE: the extension does not belong to a surface file; give it one of "
                          ".obj, .ply, .off, .stl or convert the file");
}

TEST_CASE("a byte order mark is not part of any surface in text, and stays in a binary stl") {
    const std::string mark = "\xEF\xBB\xBF";
    const std::string obj = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
    const std::string off = "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
    const std::string stl = "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 "
                            "0\nvertex 0 1 0\nendloop\nendfacet\nendsolid\n";
    const std::string ply = "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty "
                            "float y\nproperty float z\n"
                            "element face 1\nproperty list uchar int vertex_indices\nend_header\n0 "
                            "0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
    for (const auto& [name, text] : std::vector<std::pair<const char*, std::string>>{
             {"m.obj", obj}, {"m.off", off}, {"m.stl", stl}, {"m.ply", ply}}) {
        CAPTURE(name);
        CHECK(read_text(name, (mark + text).c_str()).faces == one_face);
        const test::Folder folder;
        const auto wide = test::refusal(folder.with(name, "\xFF\xFE" + text),
                                        [](const auto& f) { read_surface(f); });
        CHECK(wide.code == "io.format");
        CHECK(wide.message ==
              "FILE: the text is in UTF-16 or UTF-32; save it as UTF-8 or plain ASCII");
    }
    const test::Folder folder;
    const TriangleMesh m = one_triangle();
    write_surface(folder / "m.stl", m);
    std::string bytes = test::content_of(folder / "m.stl");
    CHECK(read_surface(folder.with("n.stl", bytes.replace(0, 3, mark))).faces == one_face);
    write_surface(folder / "m.ply", m);
    CHECK(read_surface(folder.with("n.ply", mark + test::content_of(folder / "m.ply"))).faces ==
          one_face);
}

TEST_CASE("stl: the words of the text may be capitals") {
    const TriangleMesh m = read_text("m.stl", "SOLID PART\n FACET NORMAL 0 0 0\n  OUTER LOOP\n "
                                              "VERTEX 0 0 0\n VERTEX 1 0 0\n Vertex 0 1 0\n"
                                              "  ENDLOOP\n ENDFACET\nEndSolid PART\n");
    CHECK(m.faces == one_face);
}

TEST_CASE("ply: strips of triangles turn every other one, -1 and repeated corners begin anew") {
    const std::string head = "ply\nformat ascii 1.0\nelement vertex 5\nproperty float x\nproperty "
                             "float y\nproperty float z\n"
                             "element tristrips 2\nproperty list int int "
                             "vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n1 1 1\n";
    CHECK(read_text("m.ply", (head + "8 0 1 2 3 -1 4 3 2\n5 0 1 2 2 3\n").c_str()).faces ==
          Faces{{0, 1, 2}, {2, 1, 3}, {4, 3, 2}, {0, 1, 2}});
    // A tetrahedron as one strip is closed and has one orientation: its volume is that of the
    // solid.
    const TriangleMesh tet = read_text("m.ply", (head + "6 0 2 1 3 0 2\n0\n").c_str());
    REQUIRE(tet.faces.size() == 4);
    double volume = 0.0;
    for (const auto& f : tet.faces)
        volume += tet.points[f[0]].dot(tet.points[f[1]].cross(tet.points[f[2]])) / 6.0;
    CHECK(volume == doctest::Approx(1.0 / 6.0));
}

TEST_CASE("ply: a list may be broken over lines, an element may not share one") {
    const std::string head = "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty "
                             "float y\nproperty float z\n"
                             "element face 1\nproperty list uchar int vertex_indices\nend_header\n";
    CHECK(read_text("m.ply", (head + "0 0 0\n\n1 0 0\n0 1 0\n3 0\n1 2\n").c_str()).faces ==
          one_face);
}

TEST_CASE("geometry that is not read is reported") {
    std::vector<std::string> said;
    set_log_sink([&](LogLevel, std::string_view text) { said.emplace_back(text); });
    read_text("m.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nl 1 2\nl 2 3\nf 1 2 3\n");
    REQUIRE(said.size() == 1);
    CHECK(said[0].find(":4: lines 'l' are not read") != std::string::npos);
    said.clear();
    read_text("m.ply", "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float "
                       "y\nproperty float z\n"
                       "element face 1\nproperty list uchar int vertex_indices\nelement quads "
                       "1\nproperty list uchar int corners\nend_header\n"
                       "0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n4 0 1 2 2\n");
    set_log_sink({});
    REQUIRE(said.size() == 1);
    CHECK(said[0].find("element 'quads' (1) is not read") != std::string::npos);
}
