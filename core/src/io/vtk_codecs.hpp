#pragma once
// The formats of VTK; see vtk_backend.hpp.

#include <string>
#include <string_view>
#include <vector>

#include <dsc/io/series.hpp>
#include <dsc/io/write.hpp>

namespace dsc::io {

mesh::TetMesh decode_vtu(const std::string& content, std::string_view file,
                         std::vector<DataArray>* points);
std::string encode_vtu(const mesh::TetMesh& mesh, const VolumeData& data, std::string_view file);
surface::TriangleMesh decode_vtp(const std::string& content, std::string_view file,
                                 SurfaceData* data);
std::string encode_vtp(const surface::TriangleMesh& mesh, const SurfaceData& data,
                       std::string_view file);

}  // namespace dsc::io
