// The files of a series: surfaces as .vtp, and the .pvd index.
#include "dsc/io/series.hpp"

#include <fmt/core.h>

#include <dsc/base/error.hpp>
#include <dsc/base/read_file.hpp>
#include <dsc/io/atomic_file.hpp>
#include <dsc/surface/measure.hpp>
#include <dsc/text/words.hpp>

#include "io/vtk_backend.hpp"

namespace dsc::io {
namespace {

void require_surface_size(std::size_t count, std::size_t expected, const std::string& array) {
    if (count == expected) return;
    throw GeometryError("surface.size", "surface",
                        fmt::format("array {} has {} for {}", text::in_quotes(array),
                                    text::counted(count, "value"), expected),
                        "give one for each");
}

void check_arrays(const surface::TriangleMesh& mesh, const SurfaceData& data) {
    for (const DataArray& a : data.cells)
        require_surface_size(a.values.size(), mesh.faces.size(), a.name);
    for (const DataArray& a : data.points)
        require_surface_size(a.values.size(), mesh.points.size(), a.name);
    if (!mesh.colours.empty())
        require_surface_size(mesh.colours.size(), mesh.points.size(), "colour");
    for (const VectorArray& a : data.vectors)
        require_surface_size(a.values.size(), mesh.points.size(), a.name);
}

/// Names of the program need no escapes, but a .pvd is XML and the caller may pass any name.
std::string xml_text(std::string_view text) {
    std::string out;
    for (const char c : text) {
        switch (c) {
            case '&': out += "&amp;"; break;
            case '<': out += "&lt;"; break;
            case '"': out += "&quot;"; break;
            default: out += c;
        }
    }
    return out;
}

}  // namespace

void write_vtp(const std::filesystem::path& file, const surface::TriangleMesh& mesh,
               const SurfaceData& data) {
    surface::require_sound(mesh);
    check_arrays(mesh, data);
    write_file(file, vtk_backend().encode_vtp(mesh, data, file.string()));
}

surface::TriangleMesh read_vtp(const std::filesystem::path& file, SurfaceData* data) {
    return vtk_backend().decode_vtp(read_file(file), file.string(), data);
}

void write_pvd(const std::filesystem::path& file, std::span<const SeriesEntry> entries) {
    std::string text = "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\" "
                       "byte_order=\"LittleEndian\">\n  <Collection>\n";
    for (const SeriesEntry& entry : entries) {
        text += fmt::format("    <DataSet timestep=\"{}\" part=\"0\" file=\"{}\"/>\n", entry.step,
                            xml_text(entry.file));
    }
    write_file(file, text + "  </Collection>\n</VTKFile>\n");
}

}  // namespace dsc::io
