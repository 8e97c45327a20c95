#pragma once
// Writers of surfaces and volumes. They are atomic: either the complete file appears under its
// name, or the old file stays and an IoError gives the reason.

#include <filesystem>
#include <vector>

#include <dsc/io/data_array.hpp>
#include <dsc/mesh/tet_mesh.hpp>
#include <dsc/surface/triangle_mesh.hpp>

namespace dsc::io {

/// Additional arrays of a volume; only .vtu can store them, the other formats leave them out.
struct VolumeData {
    std::vector<DataArray> cells;
    std::vector<DataArray> points;
    bool compressed = false;  ///< with zlib
};

/// Writes .obj or .off (shortest decimal text that reads back to the same double), .ply (binary,
/// doubles) or .stl (binary floats). An STL stores only floats: if the mesh is farther from the
/// origin than it is large, its centre is subtracted before the conversion and named in the header,
/// and read_surface() adds it again. .obj and .ply store colours and `normals` (unit vectors, one
/// per point, or none); in .ply the normals are floats. .ply also stores `points` as further
/// properties of the vertices, as doubles under their names. .glb stores floats: positions, shading
/// normals of its own, colours, and `points` as attributes "_NAME" if all values are finite. A
/// point on a crease (above 40 degrees) is stored once per normal. The other formats leave all
/// these out.
///
/// Throws IoError "io.format", "io.write", and GeometryError as surface::require_sound(),
/// "surface.colours" if there are colours but not one per point, "surface.size" for an array or
/// normals of a wrong size, "surface.range" for a coordinate that a float cannot store. [setup]
void write_surface(const std::filesystem::path& file, const surface::TriangleMesh& mesh,
                   const std::vector<DataArray>& points = {},
                   const std::vector<Vec3>& normals = {});

/// Writes .dsc (shortest decimal text that reads back to the same double), .vtu (doubles,
/// cell arrays "label" and "quality" first), .msh (Gmsh 4.1, the same text; a label is the physical
/// group "label_N" with the tag N + 1, because tags count from 1) or .mesh (MEDIT, the same text; a
/// label is a reference). Every tet must be exactly positive in the numbers that are written.
///
/// Throws IoError "io.format", "io.write"; GeometryError "volume.inverted" (naming the first tet
/// and the count), "volume.index", "volume.not_finite", "volume.size" for labels or arrays of a
/// wrong size, "volume.label" for a label that the format cannot store. [setup]
void write_volume(const std::filesystem::path& file, const mesh::TetMesh& mesh,
                  const VolumeData& data = {});

}  // namespace dsc::io
