// Every way in which a volume file can be wrong ends in one message that is checked here word for
// word.
#include <doctest/doctest.h>

#include <dsc/io/read.hpp>
#include <dsc/io/write.hpp>

#include "files.hpp"

using namespace dsc;
using namespace dsc::io;

namespace {

void check_bad(const std::string& name, const std::string& content, const std::string& code,
               const std::string& message) {
    const test::Folder folder;
    const auto found =
        test::refusal(folder.with(name, content), [](const auto& f) { read_volume(f); });
    CAPTURE(content);
    CHECK(found.code == code);
    CHECK(found.message == message);
}

struct VtuParts {
    std::string counts = "NumberOfPoints=\"4\" NumberOfCells=\"1\"";
    std::string labels = "<DataArray type=\"Int32\" Name=\"label\" format=\"ascii\">1</DataArray>";
    std::string points = "0 0 0 1 0 0 0 1 0 0 0 1";
    std::string corners = "0 1 2 3";
    std::string offsets = "4";
    std::string type = "10";
    std::string text() const {
        return "<VTKFile type=\"UnstructuredGrid\" version=\"0.1\" "
               "byte_order=\"LittleEndian\"><UnstructuredGrid><Piece " +
               counts + "><CellData>" + labels +
               "</CellData><Points><DataArray type=\"Float64\" NumberOfComponents=\"3\" "
               "format=\"ascii\">" +
               points +
               "</DataArray></Points><Cells><DataArray type=\"Int64\" Name=\"connectivity\" "
               "format=\"ascii\">" +
               corners +
               "</DataArray><DataArray type=\"Int64\" Name=\"offsets\" format=\"ascii\">" +
               offsets + "</DataArray><DataArray type=\"UInt8\" Name=\"types\" format=\"ascii\">" +
               type + "</DataArray></Cells></Piece></UnstructuredGrid></VTKFile>";
    }
};

}  // namespace

TEST_CASE("bad dsc") {
    const std::string v4 = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n";
    check_bad("a.dsc", v4, "io.no_tets",
              "FILE: no tets among 4 points; a volume is needed here; export the file again");
    check_bad("a.dsc", v4 + "t 0 1 2", "io.truncated",
              "FILE:5: the file ends where an integer should be; the file is incomplete: copy or "
              "export it again");
    check_bad("a.dsc", v4 + "t 0 1 2 3\n", "io.truncated",
              "FILE:5: the file ends where an integer should be; the file is incomplete: copy or "
              "export it again");
    check_bad("a.dsc", "v 0 0", "io.truncated",
              "FILE:1: the file ends where a number should be; the file is incomplete: copy or "
              "export it again");
    check_bad("a.dsc", v4 + "t 0 1 2 4 1\n", "io.index",
              "FILE:5: vertex index 4 of 4; indices count from 0; export the file again");
    check_bad(
        "a.dsc", v4 + "t 0 1 2 -1 1\n", "io.index",
        "FILE:5: vertex index -1 is out of range; indices count from 0; export the file again");
    check_bad("a.dsc", v4 + "t 0 1 2 99999999999 1\n", "io.index",
              "FILE:5: vertex index 99999999999 is out of range; indices count from 0; export the "
              "file again");
    check_bad("a.dsc", v4 + "t 0 1 2 3 -1\n", "io.syntax",
              "FILE:5: label -1 is out of range; labels are 0 (outside) or larger");
    check_bad("a.dsc", v4 + "t 0 1 2 3 1.5\n", "io.syntax",
              "FILE:5: '1.5' is not an integer; correct the line or export the file again");
    check_bad("a.dsc", "v 0 0 0\nv 1 nan 0\n", "io.not_finite",
              "FILE:2: coordinate 'nan' is NaN or infinite; remove the point and its faces or "
              "export the file again");
    check_bad("a.dsc", "v 0 0 0\n# tets\n", "io.syntax",
              "FILE:2: '#' is neither 'v' nor 't'; correct the line or export the file again");
    check_bad("a.dsc", "\n\n", "io.empty", "FILE: the file is empty; copy or export it again");
    check_bad("a.msh", "$MeshFormat\n", "io.write_only",
              "FILE: Gmsh MSH 4.1 files can be written but not read; convert it with meshio to one "
              "of .vtu, .dsc, as share/doc/formats.md shows");
    check_bad("a.MESH", "MeshVersionFormatted 2\n", "io.write_only",
              "FILE: MEDIT mesh files can be written but not read; convert it with meshio to one "
              "of .vtu, .dsc, as share/doc/formats.md shows");
    check_bad("a.tet", "x", "io.format",
              "FILE: the extension does not belong to a volume file; give it one of .vtu, .dsc or "
              "convert the file");
}

/// One tet with inline base64 arrays that zlib has packed, as older programs write it; without
/// PointData.
const std::string packed_vtu =
    "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"0.1\" "
    "byte_order=\"LittleEndian\" compressor=\"vtkZLibDataCompressor\">\n<UnstructuredGrid><Piece "
    "NumberOfPoints=\"4\" NumberOfCells=\"1\">\n"
    "<CellData><DataArray type=\"Int32\" Name=\"label\" NumberOfComponents=\"1\" "
    "format=\"binary\">\n"
    "AQAAAACAAAAEAAAADAAAAA==eJxjZWBgAAAAGAAG\n</DataArray>\n</CellData><Points><DataArray "
    "type=\"Float64\" Name=\"Points\" NumberOfComponents=\"3\" format=\"binary\">\n"
    "AQAAAACAAABgAAAAEgAAAA==eJxjYMAHPtjjlSZCHgB4XQOO\n</DataArray>\n</Points><Cells><DataArray "
    "type=\"Int64\" Name=\"connectivity\" NumberOfComponents=\"1\" format=\"binary\">\n"
    "AQAAAACAAAAgAAAAEwAAAA==eJxjYIAARijNBKWZoTQAAHAABw==\n</DataArray>\n<DataArray type=\"Int64\" "
    "Name=\"offsets\" NumberOfComponents=\"1\" "
    "format=\"binary\">\nAQAAAACAAAAIAAAACwAAAA==eJxjYYAAAAAoAAU=\n"
    "</DataArray>\n<DataArray type=\"UInt8\" Name=\"types\" NumberOfComponents=\"1\" "
    "format=\"binary\">\n"
    "AQAAAACAAAABAAAACQAAAA==eJzjAgAACwAL\n</DataArray>\n</Cells></Piece></UnstructuredGrid></"
    "VTKFile>\n";

std::string changed(std::string text, const std::string& from, const std::string& to) {
    return text.replace(text.find(from), from.size(), to);
}

TEST_CASE("a packed vtu whose headers lie is refused before VTK trusts them") {
    {
        const test::Folder folder;
        const mesh::TetMesh m = read_volume(folder.with("a.vtu", packed_vtu));
        CHECK(m.points == std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}});
        CHECK(m.tets == std::vector<std::array<std::uint32_t, 4>>{{0, 1, 2, 3}});
        CHECK(m.labels == std::vector<mesh::Label>{5});
    }
    const auto header_of = [](const std::string& name) {
        return "FILE: the compressed array '" + name +
               "' has a header that does not fit the file; the file is incomplete: copy or export "
               "it again";
    };
    // No block but a partial one; block size 0; 2^32-1 blocks; cut header.
    check_bad("a.vtu", changed(packed_vtu, "AQAAAACAAAAEAAAADAAAAA==", "AAAAAACAAAAEAAAADAAAAA=="),
              "io.syntax", header_of("label"));
    check_bad("a.vtu", changed(packed_vtu, "AQAAAACAAAAIAAAACwAAAA==", "AQAAAAAAAAAIAAAACwAAAA=="),
              "io.syntax", header_of("offsets"));
    check_bad("a.vtu", changed(packed_vtu, "AQAAAACAAAABAAAACQAAAA==", "/////wCAAAABAAAACQAAAA=="),
              "io.syntax", header_of("types"));
    check_bad("a.vtu",
              changed(packed_vtu, "AQAAAACAAABgAAAAEgAAAA==eJxjYMAHPtjjlSZCHgB4XQOO", "AQAAAACA"),
              "io.syntax", header_of("Points"));
    check_bad("a.vtu", changed(packed_vtu, "\"0.1\"", "\"180\""), "io.syntax",
              "FILE: VTK file version '180'; supported are 0.1 to 2.9; check that it is a VTU file "
              "or export it again");
    check_bad("a.vtu", changed(packed_vtu, "\"binary\"", "\"binbry\""), "io.syntax",
              "FILE: array 'label' has format 'binbry'; supported are ascii, binary, appended; the "
              "file is incomplete: copy or export it again");
    check_bad("a.vtu", changed(packed_vtu, "NumberOfComponents=\"3\"", "NumberOfComponents=\"0\""),
              "io.count",
              "FILE: NumberOfComponents of array 'Points' is '0'; the file is incomplete: copy or "
              "export it again");
    // The label array is cut: VTK notices, and would fall over its own message.
    check_bad("a.vtu", changed(packed_vtu, "eJxjZWBgAAAAGAAG", "eJxjZWBwAAAAGAAG"), "io.syntax",
              "FILE: VTK refuses it: Zlib error while uncompressing data.; the file is incomplete: "
              "copy or export it again");
}

TEST_CASE("bad vtu") {
    CHECK(VtuParts{}.text().size() > 100);
    {
        const test::Folder folder;
        CHECK(read_volume(folder.with("a.vtu", VtuParts{}.text())).tets.size() == 1);
    }
    VtuParts p;
    p.labels.clear();
    check_bad("a.vtu", p.text(), "io.no_labels",
              "FILE: there is no cell array 'label' with one number per tet; add one: 0 outside, 1 "
              "the object, further phases above");
    p = {};
    p.labels = "<DataArray type=\"Float64\" Name=\"label\" format=\"ascii\">0.5</DataArray>";
    check_bad("a.vtu", p.text(), "io.syntax",
              "FILE: cell 0 has a label that is not an integer of at least 0; labels are 0 "
              "(outside) or larger");
    p = {};
    p.corners = "0 1 2 4";
    check_bad("a.vtu", p.text(), "io.index",
              "FILE: cell 0: point index 4 of 4; export the file again");
    p.corners = "0 1 2 -7";
    check_bad("a.vtu", p.text(), "io.index",
              "FILE: cell 0: point index -7 of 4; export the file again");
    p = {};
    p.type = "12";
    check_bad("a.vtu", p.text(), "io.cell_type",
              "FILE: cell 0 has type 12, only tets (10) are read; export only the tets");
    p = {};
    p.offsets = "3";
    check_bad("a.vtu", p.text(), "io.syntax",
              "FILE: cell 0 has offsets that do not name 4 corners; export the file again");
    p = {};
    p.counts = "NumberOfPoints=\"90000000000\" NumberOfCells=\"1\"";
    check_bad("a.vtu", p.text(), "io.count",
              "FILE: NumberOfPoints is '90000000000', more than a file of " +
                  std::to_string(p.text().size()) +
                  " bytes can contain; the file is incomplete: copy or export it again");
    p.counts = "NumberOfPoints=\"4\" NumberOfCells=\"0\"";
    p.labels = p.corners = p.offsets = p.type = "";
    check_bad("a.vtu", p.text(), "io.no_tets",
              "FILE: no tets among 4 points; a volume is needed here; export the file again");
}

TEST_CASE("a vtu that was cut anywhere is refused in one message and nothing is printed") {
    const test::Folder folder;
    write_volume(folder / "good.vtu", test::cube_of_tets());
    const std::string good = test::content_of(folder / "good.vtu");
    for (std::size_t size = 1; size + 40 < good.size(); size += 37) {
        const auto found = test::refusal(folder.with("cut.vtu", good.substr(0, size)),
                                         [](const auto& f) { read_volume(f); });
        CAPTURE(size);
        CAPTURE(found.message);
        CHECK(found.code.substr(0, 3) == "io.");
        CHECK(found.message.substr(0, 5) == "FILE:");
        CHECK(found.message.find('\n') == std::string::npos);
        CHECK(found.message.find("; ") != std::string::npos);
    }
}

TEST_CASE("not a vtu at all") {
    check_bad("a.vtu", "v 0 0 0\n", "io.syntax",
              "FILE: there is no element VTKFile; check that it is a VTU file");
    check_bad("a.vtu", "<VTKFile type=\"UnstructuredGrid\" version=\"0.1\">\n<Unstr", "io.syntax",
              "FILE: VTK refuses it: Error parsing XML in stream at line 2, column 0, byte index "
              "48: unclosed token; the file is incomplete: copy or export it again");
}
