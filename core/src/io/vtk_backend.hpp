#pragma once
// What VTK does for this module: from bytes to mesh and back. VTK is loaded at the first call.

#include <string>
#include <string_view>
#include <vector>

#include <dsc/io/series.hpp>
#include <dsc/io/write.hpp>

namespace dsc::io {

/// `file` is used only in messages.
struct VtkBackend {
    /// `points`: receives the point arrays of doubles; may be null. Throws IoError.
    mesh::TetMesh (*decode_vtu)(const std::string& content, std::string_view file,
                                std::vector<DataArray>* points);
    /// Throws IoError "io.write" if VTK reports a failure.
    std::string (*encode_vtu)(const mesh::TetMesh& mesh, const VolumeData& data,
                              std::string_view file);
    /// `data`: receives the arrays; may be null. Throws IoError.
    surface::TriangleMesh (*decode_vtp)(const std::string& content, std::string_view file,
                                        SurfaceData* data);
    /// Throws IoError "io.write" if VTK reports a failure.
    std::string (*encode_vtp)(const surface::TriangleMesh& mesh, const SurfaceData& data,
                              std::string_view file);
};

/// Throws Error "backend.load". [setup]
const VtkBackend& vtk_backend();

}  // namespace dsc::io
