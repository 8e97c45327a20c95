#pragma once
// Other programs beside dsc on the same work: what each of them gets, and what it returns.

#include <chrono>
#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include <dsc/mesh/tet_mesh.hpp>
#include <dsc/surface/triangle_mesh.hpp>

#include "pipeline.hpp"
#include "resources.hpp"

namespace dsc::bench {

struct Cost {
    double cpu_s = 0.0;  ///< user and system
    double wall_s = 0.0;
};

/// What a call costs.
template <class Work>
Cost cost_of(Work&& work) {
    const auto start = std::chrono::steady_clock::now();
    Cost cost;
    cost.cpu_s = cpu_of(work);
    cost.wall_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    return cost;
}

/// A mesh after one pass. Conversions from and to plain arrays are not part of the cost.
struct Remeshed {
    mesh::TetMesh mesh;
    Cost cost;
};
/// A surface made from points. Conversions from and to plain arrays are not part of the cost.
struct Reconstructed {
    surface::TriangleMesh surface;
    Cost cost;
};

/// Steps in which nothing moves, with the improvement `dsc` and these of its parameters
/// ("key=value"). In the first step every tet is new.
Remeshed repair_with_dsc(const Plugins& plugins, const mesh::TetMesh& mesh,
                         std::span<const std::string> parameters, unsigned steps);
/// The experiment of `dsc reconstruct` with these points, without files: filters, normalisation and
/// all steps.
Reconstructed reconstruct_with_dsc(const Plugins& plugins, std::span<const Vec3> points);

/// "5.5.1", ...
std::string cgal_version();
/// CGAL's tetrahedral isotropic remeshing with one iteration. The edges of the box are kept as
/// features; boundaries are remeshed too, which is the default.
Remeshed remesh_with_cgal(const mesh::TetMesh& mesh, double edge_length);
/// CGAL's alpha wrap of the points. `alpha` and `offset` are parts of the diagonal of their box.
Reconstructed wrap_with_cgal(std::span<const Vec3> points, double alpha, double offset);
/// Orients unit normals consistently along a minimal spanning tree over `neighbours` neighbours
/// [Hoppe1992], outwards at the highest point. A point that the tree does not reach is removed.
void orient_with_cgal(std::vector<Vec3>& points, std::vector<Vec3>& normals, unsigned neighbours);

/// "1.13.0", ...
std::string pcl_version();
/// PCL's Poisson reconstruction with its default parameters. PCL estimates the normals and
/// orient_with_cgal() orients them; both are part of the cost.
Reconstructed poisson_with_pcl(std::span<const Vec3> points);

}  // namespace dsc::bench
