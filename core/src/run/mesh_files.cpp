// The readers for generators of initial meshes.
#include "dsc/run/mesh_files.hpp"

#include <dsc/io/read.hpp>

namespace dsc::run {

mesh::TetMesh MeshFiles::read_volume(const std::string& file) const {
    return io::read_volume(file);
}

surface::TriangleMesh MeshFiles::read_surface(const std::string& file) const {
    return io::read_surface(file);
}

}  // namespace dsc::run
