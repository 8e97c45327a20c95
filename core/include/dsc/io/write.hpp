#pragma once
// Writers of surfaces and volumes. Atomic: the file appears whole under its name, or the old one stays and
// IoError tells why.

#include <dsc/io/data_array.hpp>
#include <dsc/mesh/tet_mesh.hpp>
#include <dsc/surface/triangle_mesh.hpp>
#include <filesystem>
#include <vector>

namespace dsc::io {

/// Further arrays of a volume; only .vtu has room for them, the others leave them out.
struct VolumeData {
    std::vector<DataArray> cells;
    std::vector<DataArray> points;
};

/// Writes .obj or .off (shortest decimal text that reads back to the same double), .ply (binary, doubles) or
/// .stl (binary floats). An STL holds floats only: where the mesh is farther from the origin than it is
/// large, its centre is subtracted before the cast and named in the header, and read_surface() adds it again.
/// Colours and `normals` (unit vectors, one per point, or none) are written to .obj and .ply, the latter as floats in .ply; `points`
/// to .ply as further properties of the vertices, doubles under their names; the other formats leave them out.
///
/// Throws IoError "io.format", "io.write", and GeometryError as surface::require_sound(), "surface.colours" where there is
/// neither no colour nor one a point, "surface.size" when an array or the normals do not fit. [setup]
void write_surface(const std::filesystem::path& file, const surface::TriangleMesh& mesh, const std::vector<DataArray>& points = {},
                   const std::vector<Vec3>& normals = {});

/// Writes .dsc (shortest decimal text that reads back to the same double), .vtu (doubles, zlib, cell arrays
/// "label" and "quality" first), .msh (Gmsh 4.1, the same text; a label is the physical group "label_N" with
/// the tag N + 1, as tags count from 1) or .mesh (MEDIT, the same text; a label is a reference). Every tet must
/// be exactly positive in the numbers that are written.
///
/// Throws IoError "io.format", "io.write"; GeometryError "volume.inverted" (naming the first tet and the
/// count), "volume.index", "volume.not_finite", "volume.size" when labels or arrays do not fit,
/// "volume.label" for a label that the format cannot hold. [setup]
void write_volume(const std::filesystem::path& file, const mesh::TetMesh& mesh, const VolumeData& data = {});

}  // namespace dsc::io
