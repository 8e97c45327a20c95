// Every way in which a surface file can be wrong ends in one message that is checked here word for
// word.
#include <doctest/doctest.h>

#include <dsc/io/read.hpp>
#include <dsc/io/write.hpp>

#include "files.hpp"

using namespace dsc;
using namespace dsc::io;

namespace {

struct Bad {
    const char* name;
    std::string content;
    std::string code;
    std::string message;
};

void check_all(const std::vector<Bad>& table) {
    const test::Folder folder;
    for (const Bad& bad : table) {
        const auto file = folder.with(bad.name, bad.content);
        const auto found = test::refusal(file, [](const auto& f) { read_surface(f); });
        CAPTURE(bad.content);
        CHECK(found.code == bad.code);
        CHECK(found.message == bad.message);
    }
}

const std::string ply_head = "ply\nformat ascii 1.0\nelement vertex 3\nproperty double x\nproperty "
                             "double y\nproperty double z\n"
                             "element face 1\nproperty list uchar int vertex_indices\nend_header\n";

std::string replaced(std::string text, const std::string& from, const std::string& to) {
    return text.replace(text.find(from), from.size(), to);
}

}  // namespace

TEST_CASE("files that cannot be read at all") {
    const test::Folder folder;
    const auto read = [](const auto& f) { read_surface(f); };
    auto found = test::refusal(folder / "none.obj", read);
    CHECK(found.code == "io.missing");
    CHECK(found.message == "FILE: does not exist; check the path");
    std::filesystem::create_directory(folder / "dir.obj");
    found = test::refusal(folder / "dir.obj", read);
    CHECK(found.code == "io.directory");
    CHECK(found.message == "FILE: is a folder; name a file in it");
    for (const char* content : {"", " \n\t\r\n"}) {
        found = test::refusal(folder.with("empty.ply", content), read);
        CHECK(found.code == "io.empty");
        CHECK(found.message == "FILE: the file is empty; copy or export it again");
    }
    const auto closed = folder.with("closed.obj", "v 0 0 0\n");
    std::filesystem::permissions(closed, std::filesystem::perms::none);
    if (::geteuid() == 0) {
        MESSAGE("skipped for root, who may read everything: unreadable file");
    } else {
        found = test::refusal(closed, read);
        CHECK(found.code == "io.unreadable");
        CHECK(found.message ==
              "FILE: cannot be read: Permission denied; check its permissions and the disk");
    }
}

TEST_CASE("a path through a file does not exist") {
    const test::Folder folder;
    const auto file = folder.with("a.obj", "v 0 0 0\n") / "b.obj";
    CHECK(test::refusal(file, [](const auto& f) { read_surface(f); }).message ==
          "FILE: does not exist; check the path");
}

TEST_CASE("bad obj") {
    const std::string v3 = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
    check_all({
        {"a.obj", v3, "io.no_faces",
         "FILE: contains 3 points and no faces; a surface is needed here; a cloud must be "
         "reconstructed "
         "first"},
        {"a.obj", "v 0 0 0\nv 1 0\nv 0 1 0\nf 1 2 3\n", "io.syntax",
         "FILE:2: vertex with 2 of 3 coordinates; correct the line or export the file again"},
        {"a.obj", v3 + "f 1 2 3\nv 1 0", "io.truncated",
         "FILE:5: vertex with 2 of 3 coordinates; the file is incomplete: copy or export it again"},
        {"a.obj", v3 + "f 1 2", "io.truncated",
         "FILE:4: face with 2 corners, at least 3 are needed; the file is incomplete: copy or "
         "export it again"},
        {"a.obj", v3 + "f 1\nf 1 2 3\n", "io.syntax",
         "FILE:4: face with 1 corner, at least 3 are needed; correct the line or export the file "
         "again"},
        {"a.obj", v3 + "f 1 2 x\n", "io.syntax",
         "FILE:4: 'x' is not an integer; correct the line or export the file again"},
        {"a.obj", v3 + "f 1 2 3/a\n", "io.syntax",
         "FILE:4: '3/a' is not a corner; correct the line or export the file again"},
        {"a.obj", "v 0 0,5 0\n", "io.syntax",
         "FILE:1: '0,5' is not a number; write decimals with a point, not with a comma"},
        {"a.obj", "v 0 0x1 0\n", "io.syntax",
         "FILE:1: '0x1' is not a number; correct the line or export the file again"},
        {"a.obj", "v 0 +-1 0\n", "io.syntax",
         "FILE:1: '+-1' is not a number; correct the line or export the file again"},
        {"a.obj", "v 0 nan 0\n", "io.not_finite",
         "FILE:1: coordinate 'nan' is NaN or infinite; remove the point and its faces or export "
         "the file again"},
        {"a.obj", "#\n\nv 0 -inf 0\n", "io.not_finite",
         "FILE:3: coordinate '-inf' is NaN or infinite; remove the point and its faces or export "
         "the file again"},
        {"a.obj", "v 1e999 0 0\n", "io.not_finite",
         "FILE:1: '1e999' is out of the range of a double; correct the line or export the file "
         "again"},
        {"a.obj", v3 + "f 1 2 0\n", "io.index",
         "FILE:4: vertex index 0; OBJ counts from 1; export the file again"},
        {"a.obj", v3 + "f 1 2 4\nf 1 2 3\n", "io.index",
         "FILE:4: vertex index 4 of 3; correct the line or export the file again"},
        {"a.obj", v3 + "f 1 2 -4\n", "io.index",
         "FILE:4: vertex index -4 reaches back beyond the first of 3; correct the line or export "
         "the file again"},
        {"a.obj", v3 + "f 1 2 4294967299\n", "io.index",
         "FILE:4: vertex index 4294967299 of 3; correct the line or export the file again"},
        {"a.obj", v3 + "f 1 2 99999999999999999999\n", "io.syntax",
         "FILE:4: '99999999999999999999' is not an integer; correct the line or export the file "
         "again"},
        {"a.obj", v3 + "f 1 2 3\nuse", "io.syntax",
         "FILE:5: unknown keyword 'use'; correct the line or export the file again"},
        {"a.obj", "<html><body>\xff not found", "io.syntax",
         "FILE:1: unknown keyword '<html><body>?'; correct the line or export the file again"},
        {"a.obj", std::string(100, 'x') + "\n", "io.syntax",
         "FILE:1: unknown keyword '" + std::string(60, 'x') +
             "...'; correct the line or export the file again"},
        {"a.obj", "v 1 \\\n 2 \\", "io.truncated",
         "FILE:1: vertex with 2 of 3 coordinates; the file is incomplete: copy or export it again"},
    });
}

TEST_CASE("bad off") {
    check_all({
        {"a.off", "PLY\n", "io.syntax",
         "FILE:1: the file starts with 'PLY', not with OFF; check that the file is an OFF file"},
        {"a.off", "# nothing else\n", "io.truncated",
         "FILE:1: the file ends where the word OFF should be; the file is incomplete: copy or "
         "export it again"},
        {"a.off", "OFF BINARY\n", "io.format",
         "FILE:1: binary OFF is not read; export the file as text"},
        {"a.off", "OFF\n", "io.truncated",
         "FILE:1: the file ends where the counts of vertices and faces should be; the file is "
         "incomplete: copy or export it again"},
        {"a.off", "OFF\n1\n", "io.syntax",
         "FILE:2: the number of faces is missing; correct the line or export the file again"},
        {"a.off", "OFF\n-3 1 0\n", "io.count",
         "FILE:2: -3 vertices cannot be in a file of 11 bytes; the file is incomplete: copy or "
         "export it again"},
        {"a.off", "OFF\n3 4000000000 0\n", "io.count",
         "FILE:2: 4000000000 faces cannot be in a file of 19 bytes; the file is incomplete: copy "
         "or export it again"},
        {"a.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n", "io.truncated",
         "FILE:4: the file ends where vertex 2 of 3 should be; the file is incomplete: copy or "
         "export it again"},
        {"a.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n", "io.truncated",
         "FILE:5: the file ends where face 0 of 1 should be; the file is incomplete: copy or "
         "export it again"},
        {"a.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1\n3 0 1 2\n", "io.syntax",
         "FILE:5: vertex with 2 of 3 coordinates; correct the line or export the file again"},
        {"a.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1", "io.truncated",
         "FILE:6: face with 2 of 3 corners; the file is incomplete: copy or export it again"},
        {"a.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n2 0 1\n", "io.syntax",
         "FILE:6: face with 2 corners, at least 3 are needed; correct the line or export the file "
         "again"},
        {"a.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 3\n", "io.index",
         "FILE:6: vertex index 3 of 3; OFF counts from 0; export the file again"},
        {"a.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 -1\n", "io.index",
         "FILE:6: vertex index -1 of 3; OFF counts from 0; export the file again"},
        {"a.off", "OFF\n3 1 0\n0 0 0\n1 0 inf\n0 1 0\n3 0 1 2\n", "io.not_finite",
         "FILE:4: coordinate 'inf' is NaN or infinite; remove the point and its faces or export "
         "the file again"},
        {"a.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n3 0 2 1\n", "io.count",
         "FILE:7: data after the last of 1 face; the counts of the header are wrong: export the "
         "file again"},
        {"a.off", "OFF\n3 0 0\n0 0 0\n1 0 0\n0 1 0\n", "io.no_faces",
         "FILE: contains 3 points and no faces; a surface is needed here; a cloud must be "
         "reconstructed "
         "first"},
    });
}

TEST_CASE("bad ply: the header") {
    const std::string body = "0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
    check_all({
        {"a.ply", "OFF\n", "io.syntax",
         "FILE:1: the first line is not 'ply'; check that the file is a PLY file"},
        {"a.ply", "ply\nformat ascii 1.0\nelement vertex 3\n", "io.truncated",
         "FILE:3: the PLY header has no line 'end_header'; the file is incomplete: copy or export "
         "it again"},
        {"a.ply", "ply\nend_header\n", "io.syntax",
         "FILE:2: the header has no line 'format'; correct the line or export the file again"},
        {"a.ply", replaced(ply_head, "ascii", "utf8") + body, "io.syntax",
         "FILE:2: 'utf8' is not a PLY format; supported are ascii, binary_little_endian and "
         "binary_big_endian; correct the line or export the file again"},
        {"a.ply", replaced(ply_head, "1.0", "2.0") + body, "io.syntax",
         "FILE:2: PLY version '2.0'; only 1.0 is supported; correct the line or export the file "
         "again"},
        {"a.ply", replaced(ply_head, "property double y", "property quad y") + body, "io.syntax",
         "FILE:5: 'quad' is not a PLY type; correct the line or export the file again"},
        {"a.ply", replaced(ply_head, "property double y", "property double") + body, "io.syntax",
         "FILE:5: a property has no name; correct the line or export the file again"},
        {"a.ply", replaced(ply_head, "element vertex 3", "element vertex many") + body, "io.syntax",
         "FILE:3: 'many' is not a count; correct the line or export the file again"},
        {"a.ply", replaced(ply_head, "element vertex 3", "element vertex -3") + body, "io.syntax",
         "FILE:3: '-3' is not a count; correct the line or export the file again"},
        {"a.ply", replaced(ply_head, "element vertex 3", "elephant") + body, "io.syntax",
         "FILE:3: 'elephant' is not an entry of a PLY header; correct the line or export the file "
         "again"},
        {"a.ply", replaced(ply_head, "element vertex 3\n", "") + body, "io.syntax",
         "FILE:3: a property comes before the first element; correct the line or export the file "
         "again"},
        {"a.ply", replaced(ply_head, "property double z\n", "") + body, "io.syntax",
         "FILE:8: element 'vertex' needs each of the properties x, y, z once; correct the line or "
         "export the file again"},
        {"a.ply", replaced(ply_head, "vertex_indices", "corners") + body, "io.syntax",
         "FILE:9: element 'face' needs one list vertex_indices; correct the line or export the "
         "file again"},
        {"a.ply", replaced(ply_head, "uchar int", "uchar float") + body, "io.syntax",
         "FILE:9: vertex indices are fractions; correct the line or export the file again"},
        {"a.ply", replaced(ply_head, "uchar int", "float int") + body, "io.syntax",
         "FILE:8: the length of a list is not an integer; correct the line or export the file "
         "again"},
        {"a.ply", replaced(ply_head, "element vertex", "element vertices") + body, "io.syntax",
         "FILE:9: the header has no element 'vertex'; correct the line or export the file again"},
        {"a.ply", replaced(ply_head, "element face", "element nothing 5\nelement face") + body,
         "io.syntax",
         "FILE:10: element 'nothing' has no properties; correct the line or export the file again"},
        {"a.ply", replaced(ply_head, "vertex 3", "vertex 9000000000000000000") + body,
         "io.truncated",
         "FILE:9: the header announces 9000000000000000000 elements 'vertex', more than a file of "
         "201 bytes can contain; the file is incomplete: copy or export it again"},
        {"a.ply", replaced(ply_head, "property double y", "property list uchar double y") + body,
         "io.syntax",
         "FILE:9: coordinate 'y' is a list; correct the line or export the file again"},
    });
}

TEST_CASE("bad ply: text bodies") {
    check_all({
        {"a.ply", ply_head + "0 0 0\n1 0 0 0.5\n0 1 0 0.5\n3 0 1 2\n", "io.syntax",
         "FILE:11: the line has more values than element 'vertex' has properties; correct the line "
         "or export the file again"},
        {"a.ply", ply_head + "0 0 0\n1 0\n0 1 0\n3 0 1 2\n", "io.syntax",
         "FILE:11: the line has fewer values than element 'vertex' has properties; correct the "
         "line or export the file again"},
        {"a.ply", ply_head + "0 0 0\n1 0 0\n0 1,5 0\n3 0 1 2\n", "io.syntax",
         "FILE:12: '1,5' is not a number; write decimals with a point, not with a comma"},
        {"a.ply", ply_head + "0 0 0\n1 0 0\n0 1\n", "io.truncated",
         "FILE:12: the file ends where a number should be; the file is incomplete: copy or export "
         "it again"},
        {"a.ply", ply_head + "0 0 0\n1 0 0\n0 1 0\n3 0 1\n", "io.truncated",
         "FILE:13: the file ends where an integer should be; the file is incomplete: copy or "
         "export it again"},
        {"a.ply", ply_head + "0 0 0\n1 0 nan\n0 1 0\n3 0 1 2\n", "io.not_finite",
         "FILE:11: coordinate 'nan' is NaN or infinite; remove the point and its faces or export "
         "the file again"},
        {"a.ply", ply_head + "0 0 0\n1 0 0\n0 1 0\n3 0 1 3\n", "io.index",
         "FILE:13: face 0: vertex index 3 of 3; PLY counts from 0; export the file again"},
        {"a.ply", ply_head + "0 0 0\n1 0 0\n0 1 0\n3 0 -1 2\n", "io.index",
         "FILE:13: face 0: vertex index -1 of 3; PLY counts from 0; export the file again"},
        {"a.ply", ply_head + "0 0 0\n1 0 0\n0 1 0\n2 0 1\n", "io.syntax",
         "FILE:13: face 0 with 2 corners, at least 3 are needed; correct the line or export the "
         "file again"},
        {"a.ply", ply_head + "0 0 0\n1 0 0\n0 1 0\n-3 0 1 2\n", "io.count",
         "FILE:13: a list of -3 values; correct the line or export the file again"},
        {"a.ply", ply_head + "0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n3 0 1 2\n", "io.count",
         "FILE:14: data after the last element; the counts of the header are wrong: export the "
         "file again"},
        {"a.ply", replaced(ply_head, "face 1", "face 0") + "0 0 0\n1 0 0\n0 1 0\n", "io.no_faces",
         "FILE: contains 3 points and no faces; a surface is needed here; a cloud must be "
         "reconstructed "
         "first"},
    });
}

TEST_CASE("bad ply: binary bodies") {
    const test::Folder folder;
    surface::TriangleMesh m;
    m.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    m.faces = {{0, 1, 2}};
    write_surface(folder / "good.ply", m);
    const std::string good = test::content_of(folder / "good.ply");
    const std::size_t body = good.find("end_header\n") + 11;
    std::string nan = good, index = good, huge = good;
    nan.replace(body + 24, 8, std::string("\0\0\0\0\0\0\xf8\x7f", 8));
    index.replace(good.size() - 4, 4, std::string("\xff\xff\xff\xff", 4));
    huge = replaced(huge, "uchar int", "uint int");
    huge.replace(huge.size() - 13, 13, std::string("\xff\xff\xff\xff\0\0\0\0\1\0\0\0\2\0\0\0", 16));
    check_all({
        {"a.ply", good.substr(0, good.size() - 3), "io.truncated",
         "FILE: the file ends at byte 254 where 4 bytes should follow byte 253; the file is "
         "incomplete: copy or export it again"},
        {"a.ply", good + "more", "io.count",
         "FILE: data after the last element; the counts of the header are wrong: export the file "
         "again"},
        {"a.ply", nan, "io.not_finite",
         "FILE: the coordinate before byte 204 is NaN or infinite; remove the point and its faces "
         "or export the file again"},
        {"a.ply", index, "io.index",
         "FILE: face 0: vertex index -1 of 3; PLY counts from 0; export the file again"},
        {"a.ply", huge, "io.truncated",
         "FILE: the file ends at byte 259 where 4 bytes should follow byte 259; the file is "
         "incomplete: copy or export it again"},
    });
}

TEST_CASE("bad stl") {
    const test::Folder folder;
    surface::TriangleMesh m;
    m.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    m.faces = {{0, 1, 2}, {2, 1, 0}};
    write_surface(folder / "good.stl", m);
    const std::string good = test::content_of(folder / "good.stl");
    std::string inf = good, hostile = good;
    inf.replace(84 + 50 + 12, 4, std::string("\0\0\x80\x7f", 4));
    hostile.replace(80, 4, std::string("\xff\xff\xff\xff", 4));
    const std::string facet =
        "solid s\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\n";
    check_all({
        {"a.stl", good.substr(0, 50), "io.truncated",
         "FILE: a binary STL of 50 bytes is too short for its 84 bytes of header; the file is "
         "incomplete: copy or export it again"},
        {"a.stl", good.substr(0, 150), "io.truncated",
         "FILE: the header announces 2 facets, 184 bytes in total, but the file has 150; the file "
         "is incomplete: copy or export it again"},
        {"a.stl", good + "x", "io.count",
         "FILE: the header announces 2 facets, 184 bytes in total, but the file has 185; the file "
         "is incomplete: copy or export it again"},
        {"a.stl", hostile, "io.truncated",
         "FILE: the header announces 4294967295 facets, 214748364834 bytes in total, but the file "
         "has 184; the file is incomplete: copy or export it again"},
        {"a.stl", inf, "io.not_finite",
         "FILE: facet 1 at byte 134 has a coordinate that is NaN or infinite; remove the facet or "
         "export the file again"},
        {"a.stl", facet, "io.truncated",
         "FILE:5: the file ends where 'vertex' should be; the file is incomplete: copy or export "
         "it again"},
        {"a.stl", facet + "vertex 0 1\nendloop\n", "io.syntax",
         "FILE:6: vertex with 2 of 3 coordinates; correct the line or export the file again"},
        {"a.stl", facet + "vertex 0 1 inf\n", "io.not_finite",
         "FILE:6: coordinate 'inf' is NaN or infinite; remove the point and its faces or export "
         "the file again"},
        {"a.stl", facet + "vertex 0 1 0\nvertex 0 0 1\n", "io.syntax",
         "FILE:7: 'vertex' where 'endloop' should be; correct the line or export the file again"},
        {"a.stl", facet + "vertex 0 1 0\nendloop\nendfacet\n", "io.truncated",
         "FILE:8: the file ends without 'endsolid'; the file is incomplete: copy or export it "
         "again"},
        {"a.stl", "solid s\nfacets\n", "io.syntax",
         "FILE:2: 'facets' where 'facet' or 'endsolid' should be; correct the line or export the "
         "file again"},
        {"a.stl", "solid s\nendsolid s\n", "io.no_faces",
         "FILE: contains 0 points and no faces; a surface is needed here; a cloud must be "
         "reconstructed "
         "first"},
    });
}
