#pragma once
// Moves the vertices of the stair-stepped interface of labelled lattice tets onto a smooth surface.

#include <functional>
#include <string_view>
#include <vector>

#include <dsc/generate/shapes.hpp>
#include <dsc/mesh/complex.hpp>

namespace dsc::generate {

struct ProjectOptions {
    unsigned rounds = 100;        ///< largest number
    double quality = 0.25;        ///< wanted quality of all tets
    double least_quality = 0.02;  ///< no tet falls below this quality, unless it was there before
    std::vector<mesh::VertexId> fixed = {};  ///< vertices that must not move
};

struct ProjectReport {
    std::size_t vertices = 0;     ///< movable interface vertices
    std::size_t off_surface = 0;  ///< those of them that could not reach the surface
    std::size_t relabelled = 0;   ///< tets that changed their label
    double min_quality = 0.0;     ///< of all tets
};

/// Moves every movable interface vertex to `nearest(position)`, a point of the surface. First, if a
/// tet with four interface vertices would become flat, one of its vertices leaves the interface by
/// a relabelling that keeps all vertices regular and the topology unchanged. Then the vertices
/// approach the surface as far as the quality of the tets allows. Vertices around them make room:
/// free ones move towards the mean of their neighbours, those on the surface move along it. Every
/// tet stays positive. A vertex that cannot reach the surface stays as near as possible. [setup]
ProjectReport project_interface(mesh::Complex& complex,
                                const std::function<Vec3(const Vec3&)>& nearest,
                                const ProjectOptions& options = {});

/// A generator's mesh with its interface on the surface of the shapes. `make` labels a lattice by
/// the shapes that it receives: the given shapes, grown by a fraction of `cell` (the edge of the
/// lattice's cells at the surface), with the rule that all four vertices are inside. Messages use
/// `name` for the generator. Throws as adopt(). [setup]
mesh::TetMesh make_projected(const std::function<mesh::TetMesh(std::span<const Shape>)>& make,
                             std::span<const Shape> shapes, double cell, std::string_view name);

}  // namespace dsc::generate
