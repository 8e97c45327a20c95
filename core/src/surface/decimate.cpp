// Collapses edges by quadric error [Garland1997], with OpenMesh.
#include "dsc/surface/decimate.hpp"

#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#include <OpenMesh/Tools/Decimater/DecimaterT.hh>
#include <OpenMesh/Tools/Decimater/ModQuadricT.hh>
#include <fmt/core.h>

#include <dsc/base/error.hpp>
#include <dsc/surface/analysis.hpp>
#include <dsc/surface/measure.hpp>

namespace dsc::surface {
namespace {

struct DoubleTraits : OpenMesh::DefaultTraits {
    using Point = OpenMesh::Vec3d;
    using Normal = OpenMesh::Vec3d;
};
using HalfEdgeMesh = OpenMesh::TriMesh_ArrayKernelT<DoubleTraits>;

/// OpenMesh drops faces that its half-edges cannot represent, so the mesh is checked first.
void require_manifold(const TriangleMesh& mesh) {
    const SurfaceReport r = analyse(mesh);
    if (r.nonmanifold_edges + r.misoriented_edges + r.nonmanifold_vertices == 0 &&
        r.faces == mesh.faces.size())
        return;
    throw GeometryError(
        "surface.not_manifold", "decimate",
        fmt::format("the surface has {} non-manifold edges, {} edges used twice in one direction, "
                    "{} non-manifold vertices and {} faces that use a point twice",
                    r.nonmanifold_edges, r.misoriented_edges, r.nonmanifold_vertices,
                    mesh.faces.size() - r.faces),
        "repair the surface first");
}

HalfEdgeMesh to_half_edges(const TriangleMesh& mesh, const Vec3& centre) {
    HalfEdgeMesh out;
    out.reserve(mesh.points.size(), mesh.points.size() + mesh.faces.size(), mesh.faces.size());
    for (const Vec3& p : mesh.points) {
        const Vec3 q = p - centre;
        out.add_vertex({q.x(), q.y(), q.z()});
    }
    const auto vertex = [](std::uint32_t i) {
        return HalfEdgeMesh::VertexHandle(static_cast<int>(i));
    };
    for (const auto& [a, b, c] : mesh.faces) out.add_face(vertex(a), vertex(b), vertex(c));
    return out;
}

TriangleMesh from_half_edges(const HalfEdgeMesh& mesh, const Vec3& centre) {
    TriangleMesh out;
    out.points.reserve(mesh.n_vertices());
    for (const auto v : mesh.vertices()) {
        const auto& p = mesh.point(v);
        out.points.push_back(Vec3(p[0], p[1], p[2]) + centre);
    }
    out.faces.reserve(mesh.n_faces());
    for (const auto f : mesh.faces()) {
        std::array<std::uint32_t, 3> face{};
        std::size_t k = 0;
        for (const auto v : mesh.fv_range(f)) face[k++] = static_cast<std::uint32_t>(v.idx());
        out.faces.push_back(face);
    }
    return out;
}

}  // namespace

TriangleMesh decimate(const TriangleMesh& mesh, std::size_t faces) {
    require_sound(mesh);
    if (mesh.faces.size() <= faces) return mesh;
    require_manifold(mesh);
    // Quadrics square the coordinates, so coordinates relative to the centre keep more digits.
    const Vec3 centre = used_box(mesh).centre();
    HalfEdgeMesh half_edges = to_half_edges(mesh, centre);
    OpenMesh::Decimater::DecimaterT<HalfEdgeMesh> decimater(half_edges);
    OpenMesh::Decimater::ModQuadricT<HalfEdgeMesh>::Handle quadric;
    decimater.add(quadric);
    decimater.module(quadric).unset_max_err();
    decimater.initialize();
    decimater.decimate_to_faces(0, faces);
    half_edges.delete_isolated_vertices();
    half_edges.garbage_collection();
    return from_half_edges(half_edges, centre);
}

}  // namespace dsc::surface
