// Surfaces with arrays as .vtp, and the index of a series.
#include <doctest/doctest.h>

#include <dsc/io/series.hpp>

#include "files.hpp"

using namespace dsc;
using namespace dsc::io;

namespace {

SurfaceData arrays() {
    SurfaceData data;
    data.cells.push_back({"label", {1, 2, 3}});
    data.points.push_back({"distance", {0.1, 5e-324, -0.0, 1e300}});
    data.points.push_back({"curvature", {1, 2, 3, 1.0 / 3.0}});
    data.vectors.push_back({"normal", {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0.1, 0.2, 0.3}}});
    return data;
}

}  // namespace

TEST_CASE("vtp: points, faces and arrays come back to the last bit; a second writing gives the "
          "same bytes") {
    const test::Folder folder;
    const surface::TriangleMesh m = test::awkward_mesh();
    write_vtp(folder / "a.vtp", m, arrays());
    SurfaceData back;
    const surface::TriangleMesh read = read_vtp(folder / "a.vtp", &back);
    CHECK(test::same_bits(read.points, m.points));
    CHECK(read.faces == m.faces);
    REQUIRE(back.cells.size() == 1);
    CHECK(back.cells[0].name == "label");
    CHECK(back.cells[0].values == arrays().cells[0].values);
    REQUIRE(back.points.size() == 2);
    CHECK(back.points[0].name == "distance");
    CHECK(back.points[0].values == arrays().points[0].values);
    CHECK(back.points[1].values == arrays().points[1].values);
    REQUIRE(back.vectors.size() == 1);
    CHECK(back.vectors[0].name == "normal");
    CHECK(test::same_bits(back.vectors[0].values, arrays().vectors[0].values));
    write_vtp(folder / "b.vtp", read, back);
    CHECK(test::content_of(folder / "a.vtp") == test::content_of(folder / "b.vtp"));
}

TEST_CASE("vtp: the file is what other programs expect; nothing at all is a surface, too") {
    const test::Folder folder;
    write_vtp(folder / "a.vtp", test::awkward_mesh(), arrays());
    const std::string bytes = test::content_of(folder / "a.vtp");
    for (const char* part : {"type=\"PolyData\"", "byte_order=\"LittleEndian\"",
                             "header_type=\"UInt64\"", "NumberOfPolys=\"3\"", "Name=\"distance\"",
                             "type=\"Float64\" Name=\"Points\"", "encoding=\"raw\""}) {
        CAPTURE(part);
        CHECK(bytes.find(part) != std::string::npos);
    }
    write_vtp(folder / "none.vtp", {});
    CHECK(read_vtp(folder / "none.vtp").faces.empty());
}

TEST_CASE("vtp: colours come back, and are bytes that ParaView shows as they are") {
    const test::Folder folder;
    surface::TriangleMesh m = test::awkward_mesh();
    m.colours = {{255, 0, 7}, {0, 0, 0}, {1, 2, 3}, {254, 255, 128}};
    write_vtp(folder / "a.vtp", m, arrays());
    SurfaceData back;
    const surface::TriangleMesh read = read_vtp(folder / "a.vtp", &back);
    CHECK(read.colours == m.colours);
    CHECK(back.points.size() == 2);
    CHECK(test::content_of(folder / "a.vtp")
              .find("type=\"UInt8\" Name=\"colour\" NumberOfComponents=\"3\"") !=
          std::string::npos);
    m.colours.pop_back();
    CHECK_THROWS_WITH_AS(write_vtp(folder / "a.vtp", m),
                         "surface: array 'colour' has 3 values for 4; give one for each",
                         GeometryError);
}

TEST_CASE("vtp: arrays that do not fit and damaged files are refused") {
    const test::Folder folder;
    SurfaceData data = arrays();
    data.vectors[0].values.pop_back();
    CHECK_THROWS_WITH_AS(write_vtp(folder / "a.vtp", test::awkward_mesh(), data),
                         "surface: array 'normal' has 3 values for 4; give one for each",
                         GeometryError);
    CHECK(folder.files() == 0);
    write_vtp(folder / "a.vtp", test::awkward_mesh(), arrays());
    const std::string bytes = test::content_of(folder / "a.vtp");
    for (const std::size_t size : {std::size_t{0}, std::size_t{200}, bytes.size() / 2}) {
        CAPTURE(size);
        CHECK_THROWS_AS(read_vtp(folder.with("cut.vtp", bytes.substr(0, size))), IoError);
    }
    CHECK(test::refusal(folder / "missing.vtp", [](const auto& f) { read_vtp(f); }).code ==
          "io.missing");
    const std::string text =
        "<VTKFile type=\"PolyData\" version=\"0.1\" byte_order=\"LittleEndian\"><PolyData><Piece "
        "NumberOfPoints=\"4\" NumberOfVerts=\"0\" NumberOfLines=\"0\" NumberOfStrips=\"0\" "
        "NumberOfPolys=\"1\"><Points><DataArray type=\"Float64\" NumberOfComponents=\"3\" "
        "format=\"ascii\">0 0 0 1 0 0 0 1 0 1 1 0</DataArray></Points><Polys><DataArray "
        "type=\"Int64\" Name=\"connectivity\" format=\"ascii\">0 1 CORNERS</DataArray><DataArray "
        "type=\"Int64\" Name=\"offsets\" "
        "format=\"ascii\">OFFSET</DataArray></Polys></Piece></PolyData></VTKFile>";
    const auto polygon = [&](const std::string& corners, const std::string& offset) {
        std::string file = text;
        file.replace(file.find("CORNERS"), 7, corners);
        file.replace(file.find("OFFSET"), 6, offset);
        return test::refusal(folder.with("p.vtp", file), [](const auto& f) { read_vtp(f); });
    };
    CHECK(polygon("2", "3").message == "accepted");
    CHECK(polygon("3 2", "4").code == "io.cell_type");
    CHECK(polygon("4", "3").code == "io.index");
    CHECK(polygon("-1", "3").code == "io.index");
}

TEST_CASE("pvd: one line a state, escaped") {
    const test::Folder folder;
    const std::vector<SeriesEntry> entries = {{0, "surface_000000.vtp"}, {10, "a&<\".vtp"}};
    write_pvd(folder / "a.pvd", entries);
    CHECK(test::content_of(folder / "a.pvd") ==
          "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\" "
          "byte_order=\"LittleEndian\">\n  <Collection>\n"
          "    <DataSet timestep=\"0\" part=\"0\" file=\"surface_000000.vtp\"/>\n"
          "    <DataSet timestep=\"10\" part=\"0\" file=\"a&amp;&lt;&quot;.vtp\"/>\n"
          "  </Collection>\n</VTKFile>\n");
}
