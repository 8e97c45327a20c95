#pragma once
// One pair of functions per format, from bytes to mesh and back. `file` is used only in messages.
// Those of VTK are in vtk_backend.hpp.

#include <string>
#include <string_view>
#include <vector>

#include <dsc/io/write.hpp>
#include <dsc/mesh/tet_mesh.hpp>
#include <dsc/surface/triangle_mesh.hpp>

namespace dsc::io {

surface::TriangleMesh decode_obj(std::string_view content, std::string_view file);
surface::TriangleMesh decode_off(std::string_view content, std::string_view file);
/// `further`: the data of the vertices other than position, normal and colour; may be null.
surface::TriangleMesh decode_ply(std::string_view content, std::string_view file,
                                 std::vector<DataArray>* further);
surface::TriangleMesh decode_stl(std::string_view content, std::string_view file);
mesh::TetMesh decode_dsc(std::string_view content, std::string_view file);

/// `normals`: one per point, or none.
std::string encode_obj(const surface::TriangleMesh& mesh, const std::vector<Vec3>& normals);
std::string encode_off(const surface::TriangleMesh& mesh);
std::string encode_ply(const surface::TriangleMesh& mesh, const std::vector<DataArray>& points,
                       const std::vector<Vec3>& normals);
std::string encode_stl(const surface::TriangleMesh& mesh);
/// Leaves out arrays with values that are not finite as floats.
std::string encode_glb(const surface::TriangleMesh& mesh, const std::vector<DataArray>& points);
std::string encode_dsc(const mesh::TetMesh& mesh);
std::string encode_medit(const mesh::TetMesh& mesh);
/// Throws GeometryError "volume.label" for a label below 0 or without a tag.
std::string encode_msh(const mesh::TetMesh& mesh);

}  // namespace dsc::io
