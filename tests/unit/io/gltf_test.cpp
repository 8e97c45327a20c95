// Binary glTF as VTK's reader, which is not ours, reads it.
#include <cmath>

#include <doctest/doctest.h>
#include <vtkCompositeDataIterator.h>
#include <vtkDataArray.h>
#include <vtkGLTFReader.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>

#include <dsc/io/read.hpp>
#include <dsc/io/write.hpp>

#include "files.hpp"

using namespace dsc;
using namespace dsc::io;
using surface::TriangleMesh;

namespace {

/// The unit cube with 12 faces, its lowest corner at `corner`.
TriangleMesh cube(const Vec3& corner = Vec3::Zero()) {
    TriangleMesh m;
    for (int i = 0; i < 8; ++i)
        m.points.push_back(corner + Vec3(i & 1, (i >> 1) & 1, (i >> 2) & 1));
    m.faces = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
               {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
    return m;
}

/// A sphere of radius 1: latitude, longitude.
TriangleMesh sphere(std::uint32_t rings, std::uint32_t sectors) {
    TriangleMesh m;
    m.points.emplace_back(0, 0, 1);
    for (std::uint32_t r = 1; r < rings; ++r) {
        for (std::uint32_t s = 0; s < sectors; ++s) {
            const double a = M_PI * r / rings, b = 2 * M_PI * s / sectors;
            m.points.emplace_back(std::sin(a) * std::cos(b), std::sin(a) * std::sin(b),
                                  std::cos(a));
        }
    }
    m.points.emplace_back(0, 0, -1);
    const auto at = [&](std::uint32_t r, std::uint32_t s) { return 1 + r * sectors + s % sectors; };
    const auto last = static_cast<std::uint32_t>(m.points.size() - 1);
    for (std::uint32_t s = 0; s < sectors; ++s) {
        m.faces.push_back({0, at(0, s), at(0, s + 1)});
        m.faces.push_back({at(rings - 2, s), last, at(rings - 2, s + 1)});
        for (std::uint32_t r = 0; r + 2 < rings; ++r) {
            m.faces.push_back({at(r, s), at(r + 1, s), at(r + 1, s + 1)});
            m.faces.push_back({at(r, s), at(r + 1, s + 1), at(r, s + 1)});
        }
    }
    return m;
}

vtkSmartPointer<vtkPolyData> read_by_vtk(const std::filesystem::path& file) {
    vtkNew<vtkGLTFReader> reader;
    reader->SetFileName(file.c_str());
    reader->Update();
    vtkMultiBlockDataSet* blocks = reader->GetOutput();
    REQUIRE(blocks != nullptr);
    vtkSmartPointer<vtkCompositeDataIterator> it;
    it.TakeReference(blocks->NewIterator());
    it->InitTraversal();
    REQUIRE(!it->IsDoneWithTraversal());
    vtkSmartPointer<vtkPolyData> found = vtkPolyData::SafeDownCast(it->GetCurrentDataObject());
    REQUIRE(found != nullptr);
    it->GoToNextItem();
    REQUIRE(it->IsDoneWithTraversal());
    return found;
}

Vec3 point_of(vtkPolyData* data, vtkIdType i) { return Eigen::Map<Vec3>(data->GetPoint(i)); }

Vec3 normal_of(vtkPolyData* data, vtkIdType i) {
    Vec3 n;
    data->GetPointData()->GetNormals()->GetTuple(i, n.data());
    return n;
}

/// The volume that the triangles enclose, from the corners as VTK has them.
double volume_of(vtkPolyData* data) {
    double sum = 0.0;
    for (vtkIdType c = 0; c < data->GetNumberOfCells(); ++c) {
        vtkIdType size = 0;
        const vtkIdType* ids = nullptr;
        data->GetCellPoints(c, size, ids);
        REQUIRE(size == 3);
        sum += point_of(data, ids[0]).dot(point_of(data, ids[1]).cross(point_of(data, ids[2])));
    }
    return sum / 6;
}

}  // namespace

TEST_CASE("glb: a cube has the normals of its sides and keeps its orientation") {
    const test::Folder folder;
    write_surface(folder / "cube.glb", cube());
    const auto data = read_by_vtk(folder / "cube.glb");
    CHECK(data->GetNumberOfCells() == 12);
    CHECK(data->GetNumberOfPoints() == 24);  // each of 8 corners on three sides
    CHECK(volume_of(data) == doctest::Approx(1));
    for (vtkIdType i = 0; i < data->GetNumberOfPoints(); ++i) {
        const Vec3 n = normal_of(data, i);
        const Vec3 p = point_of(data, i);
        CHECK(n.cwiseAbs().maxCoeff() == 1.0);
        CHECK(n.cwiseAbs().sum() == 1.0);
        CHECK(n.dot(p - Vec3(0.5, 0.5, 0.5)) == 0.5);  // it points outwards
    }
}

TEST_CASE("glb: a smooth surface keeps its points") {
    const test::Folder folder;
    const TriangleMesh m = sphere(16, 24);
    write_surface(folder / "sphere.glb", m);
    const auto data = read_by_vtk(folder / "sphere.glb");
    CHECK(data->GetNumberOfPoints() == static_cast<vtkIdType>(m.points.size()));
    for (vtkIdType i = 0; i < data->GetNumberOfPoints(); ++i)
        CHECK((normal_of(data, i) - point_of(data, i)).norm() < 0.05);
}

TEST_CASE("glb: far from the origin the differences stay exact") {
    const test::Folder folder;
    const Vec3 corner(5.0e5, 4.2e6, 300);
    write_surface(folder / "far.glb", cube(corner));
    const auto data = read_by_vtk(folder / "far.glb");
    // The reader adds the translation of the node in floats; the differences are what counts.
    const std::string content = test::content_of(folder / "far.glb");
    CHECK(content.find("\"translation\":[500000.5,4200000.5,300.5]") != std::string::npos);
    CHECK(content.find("\"max\":[0.5,0.5,0.5],\"min\":[-0.5,-0.5,-0.5]") != std::string::npos);
    CHECK(data->GetNumberOfCells() == 12);
}

TEST_CASE("glb: colours are linear, attributes keep their names, others are left out") {
    const test::Folder folder;
    TriangleMesh m = cube();
    for (std::size_t i = 0; i < m.points.size(); ++i)
        m.colours.push_back({255, 188, static_cast<std::uint8_t>(i)});
    const std::vector<double> support = {0, 0.125, 0.25, 0.375, 0.5, 0.625, 0.75, 1};
    std::vector<double> holed = support;
    holed[3] = std::nan("");
    write_surface(folder / "a.glb", m, {{"support", support}, {"holed", holed}});
    const std::string content = test::content_of(folder / "a.glb");
    CHECK(content.find("_SUPPORT") != std::string::npos);
    CHECK(content.find("_HOLED") == std::string::npos);
    const auto data = read_by_vtk(folder / "a.glb");
    vtkDataArray* array = data->GetPointData()->GetArray("_SUPPORT");
    REQUIRE(array != nullptr);
    vtkDataArray* colours = data->GetPointData()->GetScalars();
    if (colours == nullptr) colours = data->GetPointData()->GetArray("COLOR_0");
    REQUIRE(colours != nullptr);
    for (vtkIdType i = 0; i < data->GetNumberOfPoints(); ++i) {
        const Vec3 p = point_of(data, i);
        const auto point = static_cast<std::size_t>(p.x() + 2 * p.y() + 4 * p.z());
        CHECK(array->GetTuple1(i) == support[point]);
        CHECK(colours->GetComponent(i, 0) == doctest::Approx(1));
        // 188 of 255 in sRGB is half of the light (IEC 61966-2-1).
        CHECK(colours->GetComponent(i, 1) == doctest::Approx(0.5029).epsilon(0.001));
    }
}

TEST_CASE("glb: the file announces its own size, and dsc does not read it") {
    const test::Folder folder;
    write_surface(folder / "cube.glb", cube());
    const std::string content = test::content_of(folder / "cube.glb");
    REQUIRE(content.substr(0, 4) == "glTF");
    const auto number = [&](std::size_t at) {
        std::uint32_t n = 0;
        for (std::size_t k = 4; k-- > 0;) n = 256 * n + static_cast<std::uint8_t>(content[at + k]);
        return n;
    };
    CHECK(number(4) == 2);
    CHECK(number(8) == content.size());
    CHECK(number(12) % 4 == 0);
    CHECK(content.size() % 4 == 0);
    const auto refused =
        test::refusal(folder / "cube.glb", [](const auto& file) { read_surface(file); });
    CHECK(refused.code == "io.write_only");
    CHECK(refused.message ==
          "FILE: binary glTF files can be written but not read; convert it with Blender or trimesh "
          "to one of .obj, .ply, .off, .stl");
}

TEST_CASE("formats of floats refuse coordinates that a float cannot store") {
    const test::Folder folder;
    TriangleMesh m = cube();
    m.points[6].y() = 1e39;
    for (const char* name : {"m.glb", "m.stl"}) {
        CAPTURE(name);
        try {
            write_surface(folder / name, m);
            FAIL("accepted");
        } catch (const GeometryError& error) {
            CHECK(error.code() == "surface.range");
            CHECK(std::string(error.what()).find("point 6 has a coordinate above 3.4e38") !=
                  std::string::npos);
        }
    }
    CHECK(folder.files() == 0);
}
