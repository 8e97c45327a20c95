#include "solid.hpp"

#include <algorithm>
#include <cstdio>

#include <dsc/base/error.hpp>
#include <dsc/geometry/point_text.hpp>
#include <dsc/surface/analysis.hpp>
#include <dsc/surface/intersections.hpp>
#include <dsc/surface/measure.hpp>
#include <dsc/text/words.hpp>

namespace dsc::strategies::from_surface {
namespace {

[[noreturn]] void refuse(const std::string& file, const char* code, const std::string& cause,
                         const std::string& remedy) {
    throw GeometryError(code, file, cause, remedy);
}

/// A directed side of a face, stored with its points in ascending order.
struct DirectedSide {
    std::uint32_t low, high;
    bool ascending;
};

/// The midpoint of the first edge that does not have exactly one side in each direction.
Vec3 first_bad_edge(const surface::TriangleMesh& mesh) {
    std::vector<DirectedSide> sides;
    for (const auto& f : mesh.faces) {
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t a = f[k], b = f[(k + 1) % 3];
            sides.push_back({std::min(a, b), std::max(a, b), a < b});
        }
    }
    std::sort(sides.begin(), sides.end(), [](const DirectedSide& x, const DirectedSide& y) {
        return x.low != y.low     ? x.low < y.low
               : x.high != y.high ? x.high < y.high
                                  : x.ascending < y.ascending;
    });
    for (std::size_t i = 0; i < sides.size();) {
        std::size_t end = i;
        while (end < sides.size() && sides[end].low == sides[i].low &&
               sides[end].high == sides[i].high)
            ++end;
        if (end - i != 2 || sides[i].ascending == sides[i + 1].ascending)
            return 0.5 * (mesh.points[sides[i].low] + mesh.points[sides[i].high]);
        i = end;
    }
    return Vec3::Zero();
}

}  // namespace

surface::TriangleMesh require_solid(const surface::TriangleMesh& given, const std::string& file,
                                    std::size_t intersections, Workers* workers) {
    surface::TriangleMesh mesh = surface::weld(given);
    const surface::SurfaceReport report = surface::analyse(mesh);
    if (report.faces == 0)
        refuse(file, "surface.empty", "no face has three different corners",
               "export the surface again");
    if (report.boundary_edges > 0) {
        refuse(file, "surface.open",
               "the surface is open: " + text::counted(report.boundary_edges, "edge") +
                   " with one face, the first at " + geometry::point_text(first_bad_edge(mesh)),
               "close its holes, or reconstruct a surface from its points as a cloud");
    }
    if (report.nonmanifold_edges > 0) {
        refuse(file, "surface.not_manifold",
               text::counted(report.nonmanifold_edges, "edge") +
                   " with more than two faces, the first at " +
                   geometry::point_text(first_bad_edge(mesh)),
               "separate the parts that touch there");
    }
    if (report.misoriented_edges > 0) {
        refuse(file, "surface.misoriented",
               text::counted(report.misoriented_edges, "edge") +
                   " whose faces have opposite orientations, the first at " +
                   geometry::point_text(first_bad_edge(mesh)),
               "orient all faces outwards");
    }
    const surface::IntersectionReport crossed = surface::self_intersections(mesh, 1, workers);
    if (crossed.count > intersections) {
        const auto& first = mesh.faces[crossed.pairs.front()[0]];
        refuse(file, "surface.self_intersecting",
               text::counted(crossed.count, "pair") + " of faces intersect, the first at " +
                   geometry::point_text(mesh.points[first[0]]) + ", and " +
                   std::to_string(intersections) + " are allowed",
               "remove them and export the surface again, or increase `intersections`: the solid "
               "then contains all points that the surface winds around");
    }
    return mesh;
}

}  // namespace dsc::strategies::from_surface
