#pragma once
// From the stair-stepped interface of labelled lattice tets to a smooth one: its vertices go onto a surface.

#include <dsc/mesh/complex.hpp>
#include <dsc/mesh/shapes.hpp>
#include <functional>
#include <string_view>
#include <vector>

namespace dsc::mesh {

struct ProjectOptions {
    unsigned rounds = 100;        ///< at most
    double quality = 0.25;        ///< wanted of all tets
    double least_quality = 0.02;  ///< no tet is taken below this, unless it was there before
    std::vector<VertexId> fixed = {};  ///< vertices that stay where they are
};

struct ProjectReport {
    std::size_t vertices = 0;     ///< movable interface vertices
    std::size_t off_surface = 0;  ///< of them, those that could not get there
    std::size_t relabelled = 0;   ///< tets that changed sides
    double min_quality = 0.0;     ///< of all tets
};

/// Moves every movable interface vertex to `nearest(position)`, a point of the surface. First, where a tet between four
/// interface vertices would become flat, one of its vertices leaves the interface by a relabelling that keeps all
/// vertices regular and the topology as it is. Then vertices approach as far as the tets' quality allows, and those
/// round them give way: free ones towards the mean of their neighbours, those on the surface along it. Every tet stays
/// positive; a vertex for which there is no way stays as near as it got. [setup]
ProjectReport project_interface(Complex& complex, const std::function<Vec3(const Vec3&)>& nearest,
                                const ProjectOptions& options = {});

/// A generator's mesh with its interface on the surface of the shapes. `make` labels a lattice by the shapes that it is
/// given: these, grown by a part of `cell`, the edge of the lattice's cells at the surface, and held by all four
/// vertices. `name` is the generator named in messages. Throws as adopt(). [setup]
TetMesh make_projected(const std::function<TetMesh(std::span<const Shape>)>& make,
                       std::span<const Shape> shapes, double cell, std::string_view name);

}  // namespace dsc::mesh
