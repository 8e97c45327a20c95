// VTK unstructured grids of tets with VTK's own XML reader and writer.
#include <cmath>
#include <limits>

#include <fmt/core.h>
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkCellType.h>
#include <vtkDoubleArray.h>
#include <vtkIntArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkSmartPointer.h>
#include <vtkTypeInt64Array.h>
#include <vtkUnsignedCharArray.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLUnstructuredGridReader.h>
#include <vtkXMLUnstructuredGridWriter.h>

#include <dsc/base/error.hpp>
#include <dsc/geometry/quality.hpp>
#include <dsc/text/reading.hpp>
#include <dsc/text/words.hpp>

#include "io/vtk_codecs.hpp"
#include "io/vtk_tools.hpp"
#include "io/vtu_check.hpp"

namespace dsc::io {
namespace {

vtkSmartPointer<vtkUnstructuredGrid> make_grid(const mesh::TetMesh& mesh) {
    auto grid = vtkSmartPointer<vtkUnstructuredGrid>::New();
    grid->SetPoints(make_points(mesh.points));
    grid->SetCells(VTK_TETRA, make_cells(mesh.tets));
    return grid;
}

std::vector<double> qualities(const mesh::TetMesh& mesh) {
    std::vector<double> out;
    out.reserve(mesh.tets.size());
    for (const auto& [a, b, c, d] : mesh.tets) {
        out.push_back(
            geometry::tet_quality(mesh.points[a], mesh.points[b], mesh.points[c], mesh.points[d]));
    }
    return out;
}

/// VTK trusts the offsets and indices of the file, so they are checked here.
void read_tets(vtkUnstructuredGrid& grid, mesh::TetMesh& mesh, std::string_view file) {
    const vtkIdType count = grid.GetNumberOfCells();
    if (count == 0) return;
    const vtkCellArray* cells = grid.GetCells();
    vtkDataArray* offsets = const_cast<vtkCellArray*>(cells)->GetOffsetsArray();
    vtkDataArray* corners = const_cast<vtkCellArray*>(cells)->GetConnectivityArray();
    vtkUnsignedCharArray* types = grid.GetCellTypesArray();
    if (types == nullptr || types->GetNumberOfValues() != count ||
        offsets->GetNumberOfValues() != count + 1) {
        text::fail("io.truncated", {file, 0}, "cell types or offsets are missing",
                   text::copy_again);
    }
    const vtkIdType size = corners->GetNumberOfValues();
    mesh.tets.reserve(static_cast<std::size_t>(count));
    for (vtkIdType t = 0; t < count; ++t) {
        if (types->GetValue(t) != VTK_TETRA) {
            text::fail(
                "io.cell_type", {file, 0},
                fmt::format("cell {} has type {}, only tets (10) are read", t, types->GetValue(t)),
                "export only the tets");
        }
        const auto begin = static_cast<vtkIdType>(offsets->GetTuple1(t)),
                   end = static_cast<vtkIdType>(offsets->GetTuple1(t + 1));
        if (begin < 0 || end - begin != 4 || end > size) {
            text::fail("io.syntax", {file, 0},
                       fmt::format("cell {} has offsets that do not name 4 corners", t),
                       "export the file again");
        }
        std::array<std::uint32_t, 4> tet{};
        for (vtkIdType k = 0; k < 4; ++k) {
            const double index = corners->GetTuple1(begin + k);
            if (!(index >= 0.0) || index >= static_cast<double>(mesh.points.size())) {
                text::fail("io.index", {file, 0},
                           fmt::format("cell {}: point index {} of {}", t,
                                       static_cast<long long>(index), mesh.points.size()),
                           "export the file again");
            }
            tet[static_cast<std::size_t>(k)] = static_cast<std::uint32_t>(index);
        }
        mesh.tets.push_back(tet);
    }
}

void read_labels(vtkUnstructuredGrid& grid, mesh::TetMesh& mesh, std::string_view file) {
    vtkDataArray* labels = grid.GetCellData()->GetArray("label");
    if (labels == nullptr || labels->GetNumberOfComponents() != 1) {
        text::fail("io.no_labels", {file, 0},
                   "there is no cell array 'label' with one number per tet",
                   "add one: 0 outside, 1 the object, further phases above");
    }
    if (labels->GetNumberOfTuples() != static_cast<vtkIdType>(mesh.tets.size())) {
        text::fail("io.truncated", {file, 0},
                   fmt::format("cell array 'label' has {} values for {}",
                               labels->GetNumberOfTuples(), text::counted(mesh.tets.size(), "tet")),
                   text::copy_again);
    }
    mesh.labels.reserve(mesh.tets.size());
    for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
        const double value = labels->GetTuple1(static_cast<vtkIdType>(t));
        if (!(value >= 0.0) || value > std::numeric_limits<mesh::Label>::max() ||
            value != std::floor(value)) {
            text::fail("io.syntax", {file, 0},
                       fmt::format("cell {} has a label that is not an integer of at least 0", t),
                       "labels are 0 (outside) or larger");
        }
        mesh.labels.push_back(static_cast<mesh::Label>(value));
    }
}

mesh::TetMesh decode_checked(const std::string& content, std::string_view file,
                             std::vector<DataArray>* points) {
    const OneThreadScope one_thread;
    CaptureScope capture;
    vtkNew<vtkXMLUnstructuredGridReader> reader;
    read_content(*reader, content, file, capture);
    vtkUnstructuredGrid* grid = reader->GetOutput();
    mesh::TetMesh mesh;
    mesh.points = points_of(*grid, file);
    read_tets(*grid, mesh, file);
    if (!mesh.tets.empty()) read_labels(*grid, mesh, file);
    if (points != nullptr) read_arrays(*grid->GetPointData(), mesh.points.size(), *points);
    return mesh;
}

}  // namespace

mesh::TetMesh decode_vtu(const std::string& content, std::string_view file,
                         std::vector<DataArray>* points) {
    check_vtu(content, file);
    try {
        return decode_checked(content, file, points);
    } catch (const Error&) {
        throw;
    } catch (const std::exception& error) {
        text::fail("io.count", {file, 0}, std::string("VTK cannot read it: ") + error.what(),
                   text::copy_again);
    }
}

std::string encode_vtu(const mesh::TetMesh& mesh, const VolumeData& data, std::string_view file) {
    const OneThreadScope one_thread;
    const auto grid = make_grid(mesh);
    grid->GetCellData()->AddArray(make_array<vtkIntArray>("label", mesh.labels));
    grid->GetCellData()->AddArray(make_array<vtkDoubleArray>("quality", qualities(mesh)));
    grid->GetCellData()->SetActiveScalars("label");
    for (const DataArray& a : data.cells)
        grid->GetCellData()->AddArray(make_array<vtkDoubleArray>(a.name.c_str(), a.values));
    for (const DataArray& a : data.points) {
        grid->GetPointData()->AddArray(make_array<vtkDoubleArray>(a.name.c_str(), a.values));
    }
    vtkNew<vtkXMLUnstructuredGridWriter> writer;
    return written(*writer, grid, data.compressed, file, "write a .dsc instead");
}

}  // namespace dsc::io
