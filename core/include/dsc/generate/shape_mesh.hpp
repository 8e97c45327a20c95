#pragma once
// Makes the tets of simple solids in a box: a lattice, labelled by shapes.

#include <span>
#include <string_view>

#include <dsc/base/progress.hpp>
#include <dsc/generate/lattice.hpp>
#include <dsc/generate/shapes.hpp>
#include <dsc/mesh/tet_mesh.hpp>

namespace dsc::generate {

/// What the interface of a shape mesh looks like.
enum class ShapeSurface {
    projected,  ///< its vertices lie on the surface of the shapes, as make_projected() does it
    stepped,    ///< it consists of faces of the lattice
};

/// Makes a lattice that is finest at the surface of the shapes; the shapes define the labels of its
/// tets. Messages use `name` for the generator. Throws as make_lattice() and make_projected(), and
/// ConfigError "lattice.box" if a shape reaches the faces of the box. [setup]
mesh::TetMesh make_shape_mesh(const LatticeOptions& options, std::span<const Shape> shapes,
                              std::string_view name, ShapeSurface surface = ShapeSurface::projected,
                              const CancelToken* cancel = nullptr);

}  // namespace dsc::generate
