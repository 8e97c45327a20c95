// Every way in which a cloud file may be bad, with the whole text of the error.
#include <cstdint>
#include <cstring>

#include <unistd.h>

#include <doctest/doctest.h>

#include <dsc/cloud/read.hpp>

#include "files.hpp"

namespace {

/// Code, exit code and message of reading `bytes` as file `name`, without the folder.
std::string read_error(const test::Folder& folder, std::string_view name, std::string_view bytes) {
    const auto path = folder.write(name, bytes);
    return folder.strip(test::error_of([&] { dsc::cloud::read_cloud(path); }));
}

std::string read_error(const test::Folder& folder, std::string_view name) {
    return folder.strip(test::error_of([&] { dsc::cloud::read_cloud(folder.path(name)); }));
}

std::string pcd(std::string_view points, std::string_view data, std::string_view fields = "x y z",
                std::string_view sizes = "8 8 8", std::string_view types = "F F F",
                std::string_view counts = "1 1 1") {
    std::string text = "VERSION 0.7\nFIELDS ";
    text.append(fields).append("\nSIZE ").append(sizes).append("\nTYPE ").append(types);
    text.append("\nCOUNT ").append(counts).append("\nWIDTH ").append(points);
    text.append("\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS ").append(points);
    return text.append("\nDATA ").append(data).append("\n");
}

constexpr std::string_view xyz = "property double x\nproperty double y\nproperty double z\n";

std::string ply(std::string_view format, std::string_view points, std::string_view more = "",
                std::string_view properties = xyz) {
    std::string text = "ply\nformat ";
    text.append(format)
        .append(" 1.0\nelement vertex ")
        .append(points)
        .append("\n")
        .append(properties)
        .append(more);
    return text.append("end_header\n");
}

const std::string obj_remedy =
    "a 'v' line is 'v x y z' or 'v x y z r g b'; the file may be cut off, write it again";
const std::string xyz_remedy =
    "a point needs x, y and z, separated by blanks, commas or semicolons; the file may be cut off";
const std::string finite_remedy =
    "is not a finite number; remove the point or write its true coordinates";
const std::string cut = "; the file is cut off, write it again";
const std::string again = "; save the cloud again";
const std::string header = "; correct the line or export the file again";
const std::string alone = "; save the points with only x, y and z";

}  // namespace

TEST_CASE("files that cannot be read are refused") {
    const test::Folder folder;
    for (const std::string extension : {"xyz", "obj", "ply", "pcd"}) {
        const std::string missing = "missing." + extension, empty = "empty." + extension,
                          sub = "folder." + extension;
        CHECK(read_error(folder, missing) ==
              "io.missing 6: " + missing + ": does not exist; check the path");
        CHECK(read_error(folder, empty, "") ==
              "io.empty 6: " + empty + ": the file is empty; write the cloud again");
        std::filesystem::create_directory(folder.path(sub));
        CHECK(read_error(folder, sub) ==
              "io.directory 6: " + sub + ": is a folder; name a file in it");
    }
    folder.write("file", "x");
    CHECK(read_error(folder, "file/inside.xyz") ==
          "io.missing 6: file/inside.xyz: does not exist; check the path");
    // Even root cannot read the start of this one.
    std::filesystem::create_symlink("/proc/self/mem", folder.path("memory.xyz"));
    CHECK(read_error(folder, "memory.xyz") ==
          "io.unreadable 6: memory.xyz: cannot be read: Input/output error; check its permissions "
          "and the disk");
    std::filesystem::create_symlink("/dev/zero", folder.path("zero.ply"));
    CHECK(read_error(folder, "zero.ply") ==
          "io.unreadable 6: zero.ply: is not a regular file; copy its content into a file first");
    if (::geteuid() == 0) {
        MESSAGE("skipped: permissions do not hold for root");
    } else {
        std::filesystem::permissions(folder.write("locked.obj", "v 1 2 3\n"),
                                     std::filesystem::perms::none);
        CHECK(read_error(folder, "locked.obj") ==
              "io.unreadable 6: locked.obj: cannot be read: Permission denied; check its "
              "permissions and the disk");
    }
}

TEST_CASE("formats that are not read are refused with a way out") {
    const test::Folder folder;
    const std::string accepted = "accepted are .pcd .ply .obj .xyz .txt .asc .pts .csv";
    CHECK(read_error(folder, "scan.las", "LASF") ==
          "io.format 6: scan.las: las files are not supported; convert it first: pdal translate "
          "scan.las scan.ply");
    CHECK(read_error(folder, "scan.LAZ", "LASF") ==
          "io.format 6: scan.LAZ: laz files are not supported; convert it first: pdal translate "
          "scan.LAZ scan.ply");
    CHECK(read_error(folder, "scan.e57", "ASTM-E57") ==
          "io.format 6: scan.e57: e57 files are not supported; convert it first: pdal translate "
          "scan.e57 scan.ply, or save it as PLY with CloudCompare");
    CHECK(read_error(folder, "scan.stl", "solid") ==
          "io.format 6: scan.stl: '.stl' is not a supported cloud format; " + accepted);
    CHECK(read_error(folder, "scan", "1 2 3") ==
          "io.format 6: scan: the file's name has no extension; " + accepted);
}

TEST_CASE("bad OBJ files") {
    const test::Folder folder;
    CHECK(read_error(folder, "a.obj", "# nothing\nf 1 2 3\nvn 0 0 1\n") ==
          "io.no_points 6: a.obj: the file has no points; a cloud in OBJ has a line 'v x y z' for "
          "each point");
    CHECK(read_error(folder, "a.obj", "v 1 2 3\nv 4 5") ==
          "io.syntax 6: a.obj:2: the vertex has 2 numbers; " + obj_remedy);
    CHECK(read_error(folder, "a.obj", "v 1 2 3\nv\nv 1 2 3\n") ==
          "io.syntax 6: a.obj:2: the vertex has 0 numbers; " + obj_remedy);
    CHECK(read_error(folder, "a.obj", "v 1 2 3 1 0\n") ==
          "io.syntax 6: a.obj:1: the vertex has 5 numbers; " + obj_remedy);
    CHECK(read_error(folder, "a.obj", "v 1 2 3 1 0 1\nv 1 2 3 1") ==
          "io.syntax 6: a.obj:2: the vertex has 4 numbers, the previous one has more; " +
              obj_remedy);
    CHECK(read_error(folder, "a.obj", "v 1 2 3\nv 1 2 -\n") ==
          "io.syntax 6: a.obj:2: '-' is not a number; a point needs three numbers");
    CHECK(read_error(folder, "a.obj", "v 1,5 2 3\n") ==
          "io.syntax 6: a.obj:1: '1,5' is not a number; write decimals with a point, not with a "
          "comma");
    CHECK(read_error(folder, "a.obj", "v 1 2 3\r\n\r\nv 1 nan 3\r\n") ==
          "io.non_finite 6: a.obj:3: 'nan' " + finite_remedy);
    CHECK(read_error(folder, "a.obj", "v 1 2 -inf\n") ==
          "io.non_finite 6: a.obj:1: '-inf' " + finite_remedy);
    CHECK(read_error(folder, "a.obj", "v 1 2 1e999\n") ==
          "io.non_finite 6: a.obj:1: '1e999' " + finite_remedy);
    CHECK(read_error(folder, "a.obj", std::string("v 1 2 \0\x01zz\n", 11)) ==
          "io.syntax 6: a.obj:1: '??zz' is not a number; a point needs three numbers");
}

TEST_CASE("bad XYZ files") {
    const test::Folder folder;
    CHECK(read_error(folder, "a.xyz", "# only\n\n// comments\nx y z\n") ==
          "io.no_points 6: a.xyz: the file has no points; a text cloud has one line 'x y z' per "
          "point");
    CHECK(read_error(folder, "a.txt", "1 2 3\n4 5\n") ==
          "io.syntax 6: a.txt:2: the line has 2 columns; " + xyz_remedy);
    CHECK(read_error(folder, "a.asc", "1 2 3 255 0 0\n4 5 6 25") ==
          "io.syntax 6: a.asc:2: the line has 4 columns, the previous one has more; " + xyz_remedy);
    CHECK(read_error(folder, "a.csv", "x,y,z\n1,,3\n") ==
          "io.syntax 6: a.csv:2: column 2 is empty; a point needs x, y and z");
    CHECK(read_error(folder, "a.csv", "x;y;z\n4,5;5,5;6,5\n") ==
          "io.syntax 6: a.csv:2: '4,5' is not a number; write decimals with a point, not with a "
          "comma");
    CHECK(read_error(folder, "a.xyz", "1.5 2.5 3.5\n1,5 2,5 3,5\n") ==
          "io.syntax 6: a.xyz:2: '1,5' is not a number; write decimals with a point, not with a "
          "comma");
    CHECK(read_error(folder, "a.csv", "1.5;2.5;3.5\n4;5 6;7;8\n") ==
          "io.syntax 6: a.csv:2: '5 6' is not a number; a point needs three numbers");
    CHECK(read_error(folder, "a.xyz", "1 2 3\nx y z\n") ==
          "io.syntax 6: a.xyz:2: 'x' is not a number; a point needs three numbers");
    CHECK(read_error(folder, "a.xyz", "1 2 3\n4 5 NaN\n") ==
          "io.non_finite 6: a.xyz:2: 'NaN' " + finite_remedy);
    CHECK(read_error(folder, "a.xyz", "inf 2 3\n4 5 6\n") ==
          "io.non_finite 6: a.xyz:1: 'inf' " + finite_remedy);
    CHECK(read_error(folder, "a.pts", "3\n1 2 3\n4 5 6\n") ==
          "io.truncated 6: a.pts:1: the count line announces 3 points, the file has 2" + cut);
    CHECK(read_error(folder, "a.pts", "18446744073709551615\n1 2 3\n") ==
          "io.truncated 6: a.pts:1: the count line announces 18446744073709551615 points, the file "
          "has 1" +
              cut);
    CHECK(read_error(folder, "a.pts", "1\n1 2 3\n4 5 6\n") ==
          "io.syntax 6: a.pts:1: the count line announces 1 point, the file has 2; correct the "
          "count");
}

TEST_CASE("bad PCD headers") {
    const test::Folder folder;
    const std::string three = "1 2 3\n4 5 6\n7 8 9\n";
    const auto error = [&](const std::string& text) {
        return read_error(folder, "a.pcd", text + three);
    };
    REQUIRE(error(pcd("3", "ascii")) == "no error");
    CHECK(error("hello\n") ==
          "io.syntax 6: a.pcd:1: 'hello' is not an entry of a PCD header" + again);
    CHECK(read_error(folder, "a.pcd", "VERSION 0.7\nFIELDS x y z\n") ==
          "io.truncated 6: a.pcd: the PCD header has no line DATA; the file is truncated or not a "
          "PCD file; write it again");
    CHECK(error(pcd("0", "ascii")) == "io.no_points 6: a.pcd: the file has no points" + again);
    CHECK(error(pcd("-3", "ascii")) ==
          "io.syntax 6: a.pcd:6: '-3' is not a count between 0 and 2147483647" + again);
    CHECK(error(pcd("99999999999", "ascii")) ==
          "io.syntax 6: a.pcd:6: '99999999999' is not a count between 0 and 2147483647" + again);
    CHECK(error(pcd("3", "ascii", "x y w")) ==
          "io.syntax 6: a.pcd:10: a point needs the fields x, y and z exactly once; 'z' does not "
          "occur exactly once" +
              again);
    CHECK(error(pcd("3", "ascii", "x y z", "8 8")) ==
          "io.syntax 6: a.pcd:3: SIZE has 2 values, FIELDS has 3" + again);
    CHECK(error(pcd("3", "ascii", "x y z", "8 8 3")) ==
          "io.syntax 6: a.pcd:3: field 'z' has size 3; supported are 1, 2, 4 and 8" + again);
    CHECK(error(pcd("3", "ascii", "x y z", "8 8 2")) ==
          "io.syntax 6: a.pcd:4: field 'z' has the unknown type 'F' of 2 bytes" + again);
    CHECK(error(pcd("3", "ascii", "x y z", "8 8 8", "F F F", "1 1 999999")) ==
          "io.syntax 6: a.pcd:5: '999999' is not a count between 0 and 100000" + again);
    CHECK(error(pcd("3", "ascii", "x y z i", "8 8 8 4", "F F F F", "1 1 1 0")) ==
          "io.syntax 6: a.pcd:5: field 'i' has count 0" + again);
    CHECK(error(pcd("3", "zipped")) == "io.syntax 6: a.pcd:10: 'zipped' is not a kind of PCD data; "
                                       "supported are ascii, binary and binary_compressed" +
                                           again);
    CHECK(error("FIELDS x y z\nTYPE F F F\nSIZE 8 8 8\n") ==
          "io.syntax 6: a.pcd:3: 'SIZE' occurs twice or in the wrong order" + again);
    CHECK(
        error("FIELDS x y z\nSIZE 8 8 8\nTYPE F F F\nWIDTH 2\nHEIGHT 2\nPOINTS 3\nDATA ascii\n") ==
        "io.syntax 6: a.pcd:7: WIDTH 2 x HEIGHT 2 is not POINTS 3" + again);
    CHECK(error("FIELDS x y z\nSIZE 8 8 8\nWIDTH 3\nHEIGHT 1\nPOINTS 3\nDATA ascii\n") ==
          "io.syntax 6: a.pcd:6: FIELDS, SIZE or TYPE is missing" + again);
    CHECK(error("FIELDS x y z\nSIZE 8 8 8\nTYPE F F F\nWIDTH 3\nHEIGHT 1\nDATA ascii\n") ==
          "io.syntax 6: a.pcd:6: WIDTH, HEIGHT or POINTS is missing" + again);
}

TEST_CASE("bad PCD data") {
    const test::Folder folder;
    const auto error = [&](const std::string& text) { return read_error(folder, "a.pcd", text); };
    CHECK(error(pcd("5", "ascii") + "1 2 3\n4 5 6\n7 8 9\n") ==
          "io.truncated 6: a.pcd: the header announces 5 points, the file contains 3" + cut);
    CHECK(error(pcd("3", "ascii") + "1 2 3\n4 5 6\n7 8") ==
          "io.truncated 6: a.pcd:13: the point has 2 values, the header requires 3; the file may "
          "be cut off, write it again");
    CHECK(error(pcd("3", "ascii") + "1 2 3\n4 five 6\n7 8 9\n") ==
          "io.syntax 6: a.pcd:12: 'five' is not a number; write its true coordinate");
    CHECK(error(pcd("2", "binary") + std::string(47, 'a')) ==
          "io.truncated 6: a.pcd: the header announces 2 points, the file contains 1" + cut);
    CHECK(error(pcd("2147483647", "binary") + std::string(48, 'a')) ==
          "io.truncated 6: a.pcd: the header announces 2147483647 points, the file contains 2" +
              cut);

    const auto compressed = [&](std::uint32_t packed, std::uint32_t unpacked, std::size_t held) {
        std::string bytes(8 + held, '\0');
        std::memcpy(bytes.data(), &packed, 4);
        std::memcpy(bytes.data() + 4, &unpacked, 4);
        return pcd("2", "binary_compressed") + bytes;
    };
    CHECK(error(pcd("2", "binary_compressed") + "abc") ==
          "io.truncated 6: a.pcd: the header announces 2 points, the file contains 0" + cut);
    CHECK(error(compressed(40, 48, 39)) ==
          "io.truncated 6: a.pcd: the compressed data have 39 of 40 bytes" + cut);
    CHECK(error(compressed(40, 4000000000, 40)) ==
          "io.syntax 6: a.pcd: the compressed data claim to have 4000000000 bytes, the header's 2 "
          "points need 48; the file is damaged, write it again");
    CHECK(error(compressed(40, 48, 40)) ==
          "io.syntax 6: a.pcd: PCL's PCD reader does not accept the file; save the cloud again, "
          "for instance as PLY with x, y and z only");
    CHECK(error(pcd("1", "binary_compressed", "x y z _", "4 4 4 1", "F F F U", "1 1 1 4") +
                std::string(40, 'a')) ==
          "io.syntax 6: a.pcd:10: a padding field '_' in compressed data cannot be read" + again);
}

TEST_CASE("bad PLY headers") {
    const test::Folder folder;
    const auto error = [&](const std::string& text) {
        return read_error(folder, "a.ply", text + "1 2 3\n4 5 6\n");
    };
    REQUIRE(error(ply("ascii", "2")) == "no error");
    CHECK(error("PK\x03\x04\n") ==
          "io.syntax 6: a.ply:1: the first line is not 'ply'; check that the file is a PLY file");
    CHECK(read_error(folder, "a.ply", "ply\nformat ascii 1.0\nelement vertex 2\n") ==
          "io.truncated 6: a.ply:3: the PLY header has no line 'end_header'; the file is "
          "incomplete: copy or export it again");
    CHECK(error(ply("ascii", "0")) == "io.no_points 6: a.ply: the file has no points" + again);
    CHECK(error("ply\nformat ascii 1.0\nend_header\n") ==
          "io.no_points 6: a.ply: the file has no points" + again);
    CHECK(error("ply\nend_header\n") ==
          "io.syntax 6: a.ply:2: the header has no line 'format'" + header);
    CHECK(error("ply\nformat ascii 1.0\nproperty double x\n") ==
          "io.syntax 6: a.ply:3: a property comes before the first element" + header);
    CHECK(error(ply("ascii", "-2")) == "io.syntax 6: a.ply:3: '-2' is not a count" + header);
    CHECK(error(ply("ascii", "99999999999999999999")) ==
          "io.syntax 6: a.ply:3: '99999999999999999999' is not a count" + header);
    CHECK(error(ply("ascii", "99999999999")) ==
          "io.syntax 6: a.ply:3: 99999999999 elements 'vertex' are too many; at most 2147483647 "
          "can be read" +
              again);
    CHECK(error(ply("binary", "2")) ==
          "io.syntax 6: a.ply:2: 'binary' is not a PLY format; supported are ascii, "
          "binary_little_endian and binary_big_endian" +
              header);
    CHECK(error(ply("ascii", "2", "element empty 1000000000\n")) ==
          "io.syntax 6: a.ply: element 'empty' has no properties" + again);
    CHECK(error(ply("ascii", "2", "element vertex 3\n")) ==
          "io.syntax 6: a.ply:7: element 'vertex' occurs twice" + again);
    CHECK(error(ply("ascii", "2", "property float x\n")) ==
          "io.syntax 6: a.ply:7: property 'x' occurs twice" + again);
    CHECK(error(ply("ascii", "2", "", "property double x\nproperty real y\n")) ==
          "io.syntax 6: a.ply:5: 'real' is not a PLY type" + header);
    CHECK(error(ply("ascii", "2", "wrong\n")) ==
          "io.syntax 6: a.ply:7: 'wrong' is not an entry of a PLY header" + header);
    CHECK(error(ply("ascii", "2", "", "property double x\nproperty double y\n")) ==
          "io.format 6: a.ply: the points do not have each of x, y and z" + alone);
}

TEST_CASE("bad PLY data") {
    const test::Folder folder;
    const std::string two = "1 2 3\n4 5 6\n";
    const std::string face = "element face 1\nproperty list uchar int vertex_indices\n";
    const std::string face_cut =
        "io.truncated 6: a.ply: the header announces 1 of 'face', the file contains 0" + cut;
    const auto error = [&](const std::string& text) { return read_error(folder, "a.ply", text); };
    REQUIRE(error(ply("ascii", "2", face) + two + "3 0 1 1\n") == "no error");
    CHECK(error(ply("ascii", "4") + two) ==
          "io.truncated 6: a.ply: the header announces 4 points, the file contains 2" + cut);
    CHECK(error(ply("ascii", "2") + "1 2 3\n4 5") ==
          "io.truncated 6: a.ply:9: the line ends before 'z' of element 'vertex'; the file may be "
          "cut off, write it again");
    CHECK(error(ply("ascii", "2") + "1 2 3\n4 5 six\n") ==
          "io.syntax 6: a.ply:9: 'six' is not a number" + again);
    CHECK(error(ply("ascii", "2") + "1 2 3\n4 5 6 7\n") ==
          "io.syntax 6: a.ply:9: the line has more values than element 'vertex' has properties" +
              again);
    CHECK(error(ply("ascii", "2", face) + two) == face_cut);
    CHECK(error(ply("ascii", "2", face) + two + "3 0 1\n") ==
          "io.truncated 6: a.ply:12: the line ends before 'vertex_indices' of element 'face'; the "
          "file may be cut off, write it again");
    CHECK(error(ply("ascii", "2", face) + two + "-1 0 1\n") ==
          "io.syntax 6: a.ply:12: '-1' is not the length of a list" + again);
    for (const char* format : {"binary_little_endian", "binary_big_endian"}) {
        CHECK(error(ply(format, "3") + std::string(71, 'a')) ==
              "io.truncated 6: a.ply: the header announces 3 points, the file contains 2" + cut);
        CHECK(error(ply(format, "2147483647") + std::string(48, 'a')) ==
              "io.truncated 6: a.ply: the header announces 2147483647 points, the file contains 2" +
                  cut);
        CHECK(error(ply(format, "2", face) + std::string(48, 'a') + "\x03" +
                    std::string(11, 'b')) == face_cut);
        CHECK(error(ply(format, "2", face) + std::string(48, 'a')) == face_cut);
    }
}

TEST_CASE("PLY layouts that PCL puts into the wrong place are refused") {
    const test::Folder folder;
    const auto error = [&](const std::string& properties, const std::string& body) {
        return read_error(folder, "a.ply",
                          ply("ascii", "1", "", properties + std::string(xyz)) + body);
    };
    CHECK(error("property uchar alpha\n", "9 1 2 3\n") ==
          "io.format 6: a.ply: the points have alpha without colours before it" + alone);
    CHECK(error("property uchar red\n", "9 1 2 3\n") ==
          "io.format 6: a.ply: the colours of the points are not red, green, blue in a row" +
              alone);
    CHECK(
        error("property uchar blue\nproperty uchar green\nproperty uchar red\n", "9 9 9 1 2 3\n") ==
        "io.format 6: a.ply: the colours of the points are not red, green, blue in a row" + alone);
    CHECK(error("property list uchar int v\n", "0 1 2 3\n") ==
          "io.format 6: a.ply: the points have a list, 'v'" + alone);
    const std::string grid = "PLY files with a range grid are not supported; save only the points, "
                             "for instance with MeshLab or CloudCompare";
    CHECK(read_error(
              folder, "a.ply",
              ply("ascii", "1", "element range_grid 4\nproperty list uchar int vertex_indices\n") +
                  "1 2 3\n") == "io.format 6: a.ply:7: " + grid);
}
