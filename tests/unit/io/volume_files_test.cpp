#include <cmath>

#include <doctest/doctest.h>

#include <dsc/io/read.hpp>
#include <dsc/io/write.hpp>

#include "files.hpp"

using namespace dsc;
using namespace dsc::io;
using mesh::TetMesh;

TEST_CASE("dsc and vtu keep every bit, and a second writing the same bytes") {
    const test::Folder folder;
    TetMesh m = test::cube_of_tets();
    m.points.emplace_back(5e-324, 1.7976931348623157e308, -0.0);  // no tet uses it
    for (const char* name : {"m.dsc", "m.vtu"}) {
        CAPTURE(name);
        write_volume(folder / name, m);
        const TetMesh back = read_volume(folder / name);
        CHECK(test::same_bits(back.points, m.points));
        CHECK(back.tets == m.tets);
        CHECK(back.labels == m.labels);
        const std::string first = test::content_of(folder / name);
        write_volume(folder / name, back);
        CHECK(test::content_of(folder / name) == first);
    }
}

TEST_CASE("many random tets through both formats") {
    RandomStream random(RandomKey{1, 0, 0, 0});
    TetMesh m;
    for (std::uint32_t i = 0; i < 4000; ++i) {
        const Vec3 at(random.normal(), random.normal(), random.normal());
        m.points.insert(m.points.end(),
                        {at, at + Vec3(1, 0, random.uniform()), at + Vec3(0, 1, random.uniform()),
                         at + Vec3(0, 0, 2 + random.uniform())});
        m.tets.push_back({4 * i, 4 * i + 1, 4 * i + 2, 4 * i + 3});
        m.labels.push_back(static_cast<mesh::Label>(random.index(4)));
    }
    const test::Folder folder;
    for (const char* name : {"m.dsc", "m.vtu"}) {
        write_volume(folder / name, m);
        const TetMesh back = read_volume(folder / name);
        CHECK(test::same_bits(back.points, m.points));
        CHECK(back.tets == m.tets);
        CHECK(back.labels == m.labels);
    }
}

TEST_CASE("dsc: what is written, byte for byte") {
    const test::Folder folder;
    TetMesh m;
    m.points = {{0, 0, 0}, {0.1, 0, 0}, {0, 1e22, 0}, {0, 0, 3}};
    m.tets = {{0, 1, 2, 3}};
    m.labels = {7};
    write_volume(folder / "m.dsc", m);
    CHECK(test::content_of(folder / "m.dsc") ==
          "v 0 0 0\nv 0.1 0 0\nv 0 1e+22 0\nv 0 0 3\nt 0 1 2 3 7\n");
}

TEST_CASE("dsc: any order, any white space, no last tet twice") {
    const test::Folder folder;
    const TetMesh m =
        read_volume(folder.with("m.dsc", "t 3 2 1 0 1 v 0 0 0\r\n\r\nv 1 0 0\tv 0 1 0\nv 0 0 1"));
    CHECK(m.points.size() == 4);
    CHECK(m.tets == std::vector<std::array<std::uint32_t, 4>>{{3, 2, 1, 0}});
    CHECK(m.labels == std::vector<mesh::Label>{1});
}

TEST_CASE("vtu: the file is what other programs expect") {
    const test::Folder folder;
    const TetMesh m = test::cube_of_tets();
    VolumeData data;
    data.cells.push_back({"age", {0, 1, 2, 3, 4, 5}});
    data.points.push_back({"speed", {0, 1, 2, 3, 4, 5, 6, 7}});
    write_volume(folder / "m.vtu", m, data);
    const std::string bytes = test::content_of(folder / "m.vtu");
    for (const char* part :
         {"type=\"UnstructuredGrid\"", "byte_order=\"LittleEndian\"", "header_type=\"UInt64\"",
          "encoding=\"raw\"", "Name=\"label\"", "Name=\"quality\"", "Name=\"age\"",
          "Name=\"speed\"", "type=\"Float64\" Name=\"Points\"", "<CellData Scalars=\"label\">"}) {
        CAPTURE(part);
        CHECK(bytes.find(part) != std::string::npos);
    }
    CHECK(bytes.find("compressor") == std::string::npos);
    CHECK(read_volume(folder / "m.vtu").labels == m.labels);
}

TEST_CASE("vtu: compressed on request, with the same content") {
    const test::Folder folder;
    const TetMesh m = test::cube_of_tets();
    VolumeData data;
    data.points.push_back({"zero", std::vector<double>(m.points.size(), 0.0)});
    write_volume(folder / "raw.vtu", m, data);
    data.compressed = true;
    write_volume(folder / "packed.vtu", m, data);
    const std::string packed = test::content_of(folder / "packed.vtu");
    CHECK(packed.find("compressor=\"vtkZLibDataCompressor\"") != std::string::npos);
    std::vector<DataArray> raw_arrays, packed_arrays;
    const TetMesh raw = read_volume(folder / "raw.vtu", &raw_arrays);
    const TetMesh unpacked = read_volume(folder / "packed.vtu", &packed_arrays);
    CHECK(raw.points == unpacked.points);
    CHECK(raw.tets == unpacked.tets);
    CHECK(raw.labels == unpacked.labels);
    REQUIRE(packed_arrays.size() == 1);
    CHECK(packed_arrays.front().values == raw_arrays.front().values);
}

TEST_CASE("vtu: text arrays, float points and integers of another width are read") {
    const test::Folder folder;
    const TetMesh m = read_volume(folder.with(
        "m.vtu", "<VTKFile type=\"UnstructuredGrid\" version=\"0.1\" "
                 "byte_order=\"LittleEndian\"><UnstructuredGrid>"
                 "<Piece NumberOfPoints=\"4\" NumberOfCells=\"1\">"
                 "<CellData><DataArray type=\"UInt8\" Name=\"label\" "
                 "format=\"ascii\">3</DataArray></CellData>"
                 "<Points><DataArray type=\"Float32\" NumberOfComponents=\"3\" format=\"ascii\">0 "
                 "0 0 1 0 0 0 1 0 0 0 1"
                 "</DataArray></Points><Cells><DataArray type=\"Int32\" Name=\"connectivity\" "
                 "format=\"ascii\">0 1 2 3</DataArray>"
                 "<DataArray type=\"Int32\" Name=\"offsets\" format=\"ascii\">4</DataArray>"
                 "<DataArray type=\"UInt8\" Name=\"types\" format=\"ascii\">10</DataArray></Cells>"
                 "</Piece></UnstructuredGrid></VTKFile>"));
    CHECK(m.points[1] == Vec3(1, 0, 0));
    CHECK(m.tets == std::vector<std::array<std::uint32_t, 4>>{{0, 1, 2, 3}});
    CHECK(m.labels == std::vector<mesh::Label>{3});
}

TEST_CASE("a tet that is not exactly positive is not written") {
    const test::Folder folder;
    TetMesh m = test::cube_of_tets();
    std::swap(m.tets[2][0], m.tets[2][1]);
    std::swap(m.tets[4][0], m.tets[4][1]);
    const std::string place = (folder / "m.vtu").string();
    const std::string text =
        place + ": not written, 2 tets of 6 not positive, the first is tet 2; orient the tets "
                "(adopt does) or use units in which their volume is not rounded to 0";
    CHECK_THROWS_WITH_AS(write_volume(folder / "m.vtu", m), text.c_str(), GeometryError);

    // Flat by one unit in the last place of the largest coordinate: a plain determinant cannot
    // tell, the exact one can.
    m = {};
    m.points = {{1e8, 0, 0}, {1e8 + 1, 0, 0}, {1e8, 1, 0}, {1e8, 0, 0x1p-1000}};
    m.tets = {{0, 1, 2, 3}};
    m.labels = {1};
    CHECK_NOTHROW(write_volume(folder / "thin.dsc", m));
    m.points[3].z() = 0.0;
    CHECK_THROWS_AS(write_volume(folder / "flat.dsc", m), GeometryError);
    CHECK(folder.files() == 1);
}

TEST_CASE("arrays and indices that do not fit are refused") {
    const test::Folder folder;
    TetMesh m = test::cube_of_tets();
    m.labels.pop_back();
    CHECK_THROWS_WITH_AS(write_volume(folder / "m.dsc", m),
                         "volume: the array of labels has 5 values for 6; give one for each",
                         GeometryError);
    m = test::cube_of_tets();
    VolumeData data;
    data.points.push_back({"speed", {1}});
    CHECK_THROWS_WITH_AS(write_volume(folder / "m.vtu", m, data),
                         "volume: point array 'speed' has 1 value for 8; give one for each",
                         GeometryError);
    m.tets[1][2] = 8;
    CHECK_THROWS_WITH_AS(
        write_volume(folder / "m.dsc", m),
        "volume: tet 1 refers to point 8, but there are 8 points; correct or remove this tet",
        GeometryError);
    m = test::cube_of_tets();
    m.points[5].x() = std::nan("");
    CHECK_THROWS_WITH_AS(write_volume(folder / "m.dsc", m),
                         "volume: point 5 is NaN or infinite; correct or remove this point",
                         GeometryError);
    CHECK(folder.files() == 0);
    const auto found = test::refusal(folder / "m.obj",
                                     [&](const auto& f) { write_volume(f, test::cube_of_tets()); });
    CHECK(
        found.message ==
        "FILE: a volume cannot be written with this extension; use one of .vtu, .dsc, .msh, .mesh");
}
