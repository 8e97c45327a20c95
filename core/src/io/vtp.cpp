// VTK polygons, triangles only, with VTK's own XML reader and writer.
#include <fmt/core.h>
#include <vtkCellData.h>
#include <vtkDoubleArray.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkUnsignedCharArray.h>
#include <vtkXMLPolyDataReader.h>
#include <vtkXMLPolyDataWriter.h>

#include <dsc/base/error.hpp>
#include <dsc/text/reading.hpp>

#include "io/vtk_codecs.hpp"
#include "io/vtk_tools.hpp"
#include "io/vtu_check.hpp"

namespace dsc::io {
namespace {

constexpr const char* colour_array = "colour";

vtkSmartPointer<vtkDoubleArray> make_vectors(const VectorArray& vectors) {
    auto array = vtkSmartPointer<vtkDoubleArray>::New();
    array->SetName(vectors.name.c_str());
    array->SetNumberOfComponents(3);
    array->SetNumberOfTuples(static_cast<vtkIdType>(vectors.values.size()));
    double* to = array->GetPointer(0);
    for (const Vec3& v : vectors.values) to = std::copy(v.data(), v.data() + 3, to);
    return array;
}

/// As bytes; ParaView shows them without a colour map.
vtkSmartPointer<vtkUnsignedCharArray> make_colours(const surface::TriangleMesh& mesh) {
    auto array = vtkSmartPointer<vtkUnsignedCharArray>::New();
    array->SetName(colour_array);
    array->SetNumberOfComponents(3);
    array->SetNumberOfTuples(static_cast<vtkIdType>(mesh.colours.size()));
    unsigned char* to = array->GetPointer(0);
    for (const auto& colour : mesh.colours) to = std::copy(colour.begin(), colour.end(), to);
    return array;
}

void read_colours(vtkFieldData& from, surface::TriangleMesh& mesh) {
    auto* array = vtkUnsignedCharArray::SafeDownCast(from.GetAbstractArray(colour_array));
    const auto points = static_cast<vtkIdType>(mesh.points.size());
    if (array == nullptr || array->GetNumberOfComponents() != 3 ||
        array->GetNumberOfTuples() != points)
        return;
    for (vtkIdType i = 0; i < points; ++i)
        mesh.colours.push_back(
            {array->GetValue(3 * i), array->GetValue(3 * i + 1), array->GetValue(3 * i + 2)});
}

/// VTK trusts the offsets and indices of the file, so they are checked here.
void read_faces(vtkPolyData& polygons, surface::TriangleMesh& mesh, std::string_view file) {
    const vtkIdType count = polygons.GetNumberOfPolys();
    if (polygons.GetNumberOfCells() != count)
        text::fail("io.cell_type", {file, 0}, "it contains points, lines or strips",
                   "export only the triangles");
    if (count == 0) return;
    vtkDataArray* offsets = polygons.GetPolys()->GetOffsetsArray();
    vtkDataArray* corners = polygons.GetPolys()->GetConnectivityArray();
    if (offsets->GetNumberOfValues() != count + 1)
        text::fail("io.truncated", {file, 0}, "offsets are missing", text::copy_again);
    const vtkIdType size = corners->GetNumberOfValues();
    for (vtkIdType f = 0; f < count; ++f) {
        const auto begin = static_cast<vtkIdType>(offsets->GetTuple1(f)),
                   end = static_cast<vtkIdType>(offsets->GetTuple1(f + 1));
        if (begin < 0 || end - begin != 3 || end > size) {
            text::fail("io.cell_type", {file, 0},
                       fmt::format("polygon {} does not have 3 corners", f), "export triangles");
        }
        std::array<std::uint32_t, 3> face{};
        for (vtkIdType k = 0; k < 3; ++k) {
            const double index = corners->GetTuple1(begin + k);
            if (!(index >= 0.0) || index >= static_cast<double>(mesh.points.size())) {
                text::fail("io.index", {file, 0},
                           fmt::format("polygon {} refers to a point that is not one of {}", f,
                                       mesh.points.size()),
                           "export the file again");
            }
            face[static_cast<std::size_t>(k)] = static_cast<std::uint32_t>(index);
        }
        mesh.faces.push_back(face);
    }
}

void read_vectors(vtkFieldData& from, std::size_t elements, std::vector<VectorArray>& out) {
    for (int i = 0; i < from.GetNumberOfArrays(); ++i) {
        vtkDoubleArray* array = doubles_of(from, i, 3, elements);
        if (array == nullptr) continue;
        VectorArray& vectors =
            out.emplace_back(VectorArray{array->GetName(), std::vector<Vec3>(elements)});
        for (std::size_t v = 0; v < elements; ++v)
            array->GetTuple(static_cast<vtkIdType>(v), vectors.values[v].data());
    }
}

surface::TriangleMesh decode_checked(const std::string& content, std::string_view file,
                                     SurfaceData* data) {
    const OneThreadScope one_thread;
    CaptureScope capture;
    vtkNew<vtkXMLPolyDataReader> reader;
    read_content(*reader, content, file, capture);
    vtkPolyData* polygons = reader->GetOutput();
    surface::TriangleMesh mesh;
    mesh.points = points_of(*polygons, file);
    read_faces(*polygons, mesh, file);
    read_colours(*polygons->GetPointData(), mesh);
    if (data == nullptr) return mesh;
    read_arrays(*polygons->GetCellData(), mesh.faces.size(), data->cells);
    read_arrays(*polygons->GetPointData(), mesh.points.size(), data->points);
    read_vectors(*polygons->GetPointData(), mesh.points.size(), data->vectors);
    return mesh;
}

}  // namespace

std::string encode_vtp(const surface::TriangleMesh& mesh, const SurfaceData& data,
                       std::string_view file) {
    const OneThreadScope one_thread;
    vtkNew<vtkPolyData> polygons;
    polygons->SetPoints(make_points(mesh.points));
    polygons->SetPolys(make_cells(mesh.faces));
    for (const DataArray& a : data.cells)
        polygons->GetCellData()->AddArray(make_array<vtkDoubleArray>(a.name.c_str(), a.values));
    for (const DataArray& a : data.points)
        polygons->GetPointData()->AddArray(make_array<vtkDoubleArray>(a.name.c_str(), a.values));
    if (!mesh.colours.empty()) polygons->GetPointData()->AddArray(make_colours(mesh));
    for (const VectorArray& a : data.vectors) polygons->GetPointData()->AddArray(make_vectors(a));
    vtkNew<vtkXMLPolyDataWriter> writer;
    return written(*writer, polygons, data.compressed, file, "leave the series out");
}

surface::TriangleMesh decode_vtp(const std::string& content, std::string_view file,
                                 SurfaceData* data) {
    check_vtu(content, file);
    try {
        return decode_checked(content, file, data);
    } catch (const Error&) {
        throw;
    } catch (const std::exception& error) {
        text::fail("io.count", {file, 0}, std::string("VTK cannot read it: ") + error.what(),
                   text::copy_again);
    }
}

}  // namespace dsc::io
