#include "strategy.hpp"

#include <dsc/base/error.hpp>
#include <dsc/generate/project.hpp>
#include <dsc/plugin/lattice_params.hpp>

namespace dsc::strategies {

void Lattice::declare(config::ParamSchema<Params>& schema) {
    plugin::declare_lattice(schema, "the shapes' surface");
    plugin::declare_shapes(schema);
}

Lattice::Lattice(const Params& params, const plugin::Setup&) : params_(params), shapes_(params.all()) {}

mesh::TetMesh Lattice::build(const hooks::InitialMeshContext& context) {
    const auto make = [&](std::span<const generate::Shape> shapes) { return labelled(shapes, context.cancel); };
    if (!params_.project) return make(shapes_);
    return generate::make_projected(make, shapes_, generate::finest_cell(params_), "initial mesh 'lattice'");
}

mesh::TetMesh Lattice::labelled(std::span<const generate::Shape> shapes, const CancelToken* cancel) const {
    const auto same = [&](const Vec3& centre, double radius) {
        return generate::same_label_within(shapes, centre, radius);
    };
    mesh::TetMesh out = generate::make_lattice(params_, same, "initial mesh 'lattice'", cancel);
    for (std::size_t t = 0; t < out.tets.size(); ++t) {
        const auto& v = out.tets[t];
        out.labels[t] = generate::label_of(shapes, {out.points[v[0]], out.points[v[1]], out.points[v[2]], out.points[v[3]]});
    }
    if (generate::labels_touch_box(out)) {
        throw ConfigError("lattice.box",
                          "initial mesh 'lattice': a shape reaches the faces of the box; make the shape smaller or "
                          "`box` larger");
    }
    return out;
}

}  // namespace dsc::strategies
