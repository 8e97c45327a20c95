// Writes surfaces and volumes: checks, and chooses the format.
#include "dsc/io/write.hpp"

#include <fmt/core.h>

#include <dsc/base/error.hpp>
#include <dsc/geometry/predicates.hpp>
#include <dsc/io/atomic_file.hpp>
#include <dsc/io/formats.hpp>
#include <dsc/surface/measure.hpp>
#include <dsc/text/reading.hpp>
#include <dsc/text/words.hpp>

#include "io/codecs.hpp"
#include "io/vtk_backend.hpp"

namespace dsc::io {
namespace {

const Format& require_format(const std::filesystem::path& file, bool Format::*kind,
                             const std::string& what, const std::string& accepted) {
    const Format* format = find_format(file);
    if (format == nullptr || !(format->*kind)) {
        text::fail("io.format", {file.string(), 0},
                   "a " + what + " cannot be written with this extension",
                   "use one of " + accepted);
    }
    return *format;
}

void require_volume_size(std::size_t count, std::size_t expected, const std::string& what) {
    if (count == expected) return;
    throw GeometryError(
        "volume.size", "volume",
        fmt::format("{} has {} for {}", what, text::counted(count, "value"), expected),
        "give one for each");
}

void check_arrays(const mesh::TetMesh& mesh, const VolumeData& data) {
    require_volume_size(mesh.labels.size(), mesh.tets.size(), "the array of labels");
    for (const DataArray& a : data.cells)
        require_volume_size(a.values.size(), mesh.tets.size(),
                            "cell array " + text::in_quotes(a.name));
    for (const DataArray& a : data.points) {
        require_volume_size(a.values.size(), mesh.points.size(),
                            "point array " + text::in_quotes(a.name));
    }
}

void check_points(const mesh::TetMesh& mesh) {
    for (std::size_t i = 0; i < mesh.points.size(); ++i) {
        if (mesh.points[i].allFinite()) continue;
        throw GeometryError("volume.not_finite", "volume",
                            fmt::format("point {} is NaN or infinite", i),
                            "correct or remove this point");
    }
}

/// The formats store complete doubles, so the numbers in memory are the numbers that are written.
void check_tets(const mesh::TetMesh& mesh, const std::string& file) {
    std::size_t wrong = 0, first = 0;
    for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
        const auto& [a, b, c, d] = mesh.tets[t];
        if (std::max({a, b, c, d}) >= mesh.points.size()) {
            throw GeometryError(
                "volume.index", "volume",
                fmt::format("tet {} refers to point {}, but there are {}", t,
                            std::max({a, b, c, d}), text::counted(mesh.points.size(), "point")),
                "correct or remove this tet");
        }
        if (geometry::orient3d(mesh.points[a], mesh.points[b], mesh.points[c], mesh.points[d]) > 0)
            continue;
        if (wrong++ == 0) first = t;
    }
    if (wrong == 0) return;
    throw GeometryError(
        "volume.inverted", file,
        fmt::format("not written, {} of {} not positive, the first is tet {}",
                    text::counted(wrong, "tet"), mesh.tets.size(), first),
        "orient the tets (adopt does) or use units in which their volume is not rounded to 0");
}

void require_colours(const surface::TriangleMesh& mesh) {
    if (mesh.colours.empty() || mesh.colours.size() == mesh.points.size()) return;
    throw GeometryError(
        "surface.colours", "surface",
        fmt::format("the mesh has {} for {}", text::counted(mesh.colours.size(), "colour"),
                    text::counted(mesh.points.size(), "point")),
        "give one per point or none");
}

void require_fit(const surface::TriangleMesh& mesh, const std::vector<DataArray>& points,
                 const std::vector<Vec3>& normals) {
    if (!normals.empty() && normals.size() != mesh.points.size())
        throw GeometryError(
            "surface.size", "surface",
            fmt::format("the mesh has {} for {}", text::counted(normals.size(), "normal"),
                        text::counted(mesh.points.size(), "point")),
            "give one per point or none");
    for (const DataArray& a : points) {
        if (a.values.size() == mesh.points.size()) continue;
        throw GeometryError("surface.size", "surface",
                            fmt::format("array {} has {} for {}", text::in_quotes(a.name),
                                        text::counted(a.values.size(), "value"),
                                        text::counted(mesh.points.size(), "point")),
                            "give one per point");
    }
}

/// .stl and .glb contain floats.
void require_float_range(const std::filesystem::path& file, const surface::TriangleMesh& mesh) {
    for (std::size_t i = 0; i < mesh.points.size(); ++i) {
        if (mesh.points[i].cast<float>().allFinite()) continue;
        throw GeometryError(
            "surface.range", file.string(),
            fmt::format("point {} has a coordinate above 3.4e38, the largest float", i),
            "use smaller units, or a format of doubles such as .ply");
    }
}

}  // namespace

void write_surface(const std::filesystem::path& file, const surface::TriangleMesh& mesh,
                   const std::vector<DataArray>& points, const std::vector<Vec3>& normals) {
    const Format& format = require_format(file, &Format::surface, "surface", surface_extensions());
    surface::require_sound(mesh);
    require_colours(mesh);
    require_fit(mesh, points, normals);
    if (format.extension == ".stl" || format.extension == ".glb") require_float_range(file, mesh);
    write_file(file, format.extension == ".obj"   ? encode_obj(mesh, normals)
                     : format.extension == ".ply" ? encode_ply(mesh, points, normals)
                     : format.extension == ".off" ? encode_off(mesh)
                     : format.extension == ".glb" ? encode_glb(mesh, points)
                                                  : encode_stl(mesh));
}

void write_volume(const std::filesystem::path& file, const mesh::TetMesh& mesh,
                  const VolumeData& data) {
    const Format& format = require_format(file, &Format::volume, "volume", volume_extensions());
    check_arrays(mesh, data);
    check_points(mesh);
    check_tets(mesh, file.string());
    write_file(file, format.extension == ".dsc"   ? encode_dsc(mesh)
                     : format.extension == ".msh" ? encode_msh(mesh)
                     : format.extension == ".mesh"
                         ? encode_medit(mesh)
                         : vtk_backend().encode_vtu(mesh, data, file.string()));
}

}  // namespace dsc::io
