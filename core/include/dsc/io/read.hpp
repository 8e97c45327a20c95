#pragma once
// Readers of surfaces and volumes. They are strict: every fault becomes one IoError that names
// file, place, cause and remedy.

#include <filesystem>
#include <vector>

#include <dsc/io/data_array.hpp>
#include <dsc/mesh/tet_mesh.hpp>
#include <dsc/surface/triangle_mesh.hpp>

namespace dsc::io {

/// Reads .obj, .ply (ASCII and binary), .off or .stl (ASCII and binary). Polygons become fans of
/// triangles; coordinates keep every bit of the file's numbers; equal points of an STL are joined.
/// The vertices of an .obj or .ply keep their colours if all have one. At least one face is
/// required.
///
/// `points`, if given, receives the other properties of a .ply's vertices: each property that is a
/// single float or double and not a position, normal or colour, in the order of the file, one value
/// per point. NaN and infinity are allowed. It is empty for the other formats. Without it these
/// properties are skipped.
///
/// Throws IoError: "io.missing", "io.directory", "io.unreadable", "io.empty", "io.format" (unknown
/// extension), "io.syntax", "io.truncated", "io.index", "io.not_finite", "io.count", "io.no_faces".
/// [setup]
surface::TriangleMesh read_surface(const std::filesystem::path& file,
                                   std::vector<DataArray>* points = nullptr);

/// Reads .dsc or .vtu. Tets keep the file's order and orientation. A .vtu needs an integer cell
/// array "label" and must contain only tets. At least one tet is required. `points`, if given,
/// receives the point arrays of doubles in a .vtu, one value per point, NaN allowed; a .dsc has
/// none.
///
/// Throws IoError with the codes of read_surface() and "io.no_tets", "io.no_labels",
/// "io.cell_type", and "io.write_only" for .msh and .mesh. [setup]
mesh::TetMesh read_volume(const std::filesystem::path& file,
                          std::vector<DataArray>* points = nullptr);

}  // namespace dsc::io
