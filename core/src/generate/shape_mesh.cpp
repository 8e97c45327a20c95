// Labels the tets of a lattice by shapes.
#include "dsc/generate/shape_mesh.hpp"

#include <string>

#include <dsc/base/error.hpp>
#include <dsc/generate/project.hpp>

namespace dsc::generate {
namespace {

mesh::TetMesh labelled(const LatticeOptions& options, std::span<const Shape> shapes,
                       std::string_view name, const CancelToken* cancel) {
    const auto same = [&](const Vec3& centre, double radius) {
        return same_label_within(shapes, centre, radius);
    };
    mesh::TetMesh mesh = make_lattice(options, same, name, cancel);
    for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
        const auto& [a, b, c, d] = mesh.tets[t];
        mesh.labels[t] =
            label_of(shapes, {mesh.points[a], mesh.points[b], mesh.points[c], mesh.points[d]});
    }
    if (!labels_touch_box(mesh)) return mesh;
    throw ConfigError("lattice.box", name, "a shape reaches the faces of the box",
                      "make the shape smaller or `box` larger");
}

}  // namespace

mesh::TetMesh make_shape_mesh(const LatticeOptions& options, std::span<const Shape> shapes,
                              std::string_view name, ShapeSurface surface,
                              const CancelToken* cancel) {
    if (surface == ShapeSurface::stepped) return labelled(options, shapes, name, cancel);
    const auto make = [&](std::span<const Shape> grown) {
        return labelled(options, grown, name, cancel);
    };
    return make_projected(make, shapes, finest_cell(options), name);
}

}  // namespace dsc::generate
