// Initial mesh `lattice`: a box of cells that are small at the surface of the shapes and larger
// away from it.
//
// The cells are those of a balanced octree; they are filled with a few kinds of well-shaped tets
// [LabelleShewchuk2007]. Tets are labelled by the shapes in their order; all tets at the interface
// are in the finest cells.
#include <dsc/base/error.hpp>
#include <dsc/base/version.hpp>
#include <dsc/generate/lattice.hpp>
#include <dsc/generate/project.hpp>
#include <dsc/hooks/initial_mesh.hpp>
#include <dsc/plugin/lattice_params.hpp>
#include <dsc/plugin/plugin.hpp>
#include <dsc/plugin/shape_params.hpp>
#include <vector>

namespace {

using dsc::Vec3;

class Lattice final : public dsc::hooks::InitialMesh {
public:
    /// The parameters that an experiment may set; the values here are the defaults.
    struct Params : dsc::generate::LatticeOptions, dsc::plugin::ShapeParams {};
    static void declare(dsc::config::ParamSchema<Params>& schema) {
        dsc::plugin::declare_lattice(schema, "the shapes' surface");
        dsc::plugin::declare_shapes(schema);
    }

    Lattice(const Params& params, const dsc::plugin::Setup&)
        : params_(params), shapes_(params.all()) {}

    /// All tets are positive. Throws CancelledError, and ConfigError if a shape reaches the box or
    /// the mesh would be too large.
    dsc::mesh::TetMesh build(const dsc::hooks::InitialMeshContext& context) override {
        const auto make = [&](std::span<const dsc::generate::Shape> shapes) {
            return labelled(shapes, context.cancel);
        };
        if (!params_.project) return make(shapes_);
        return dsc::generate::make_projected(make, shapes_, dsc::generate::finest_cell(params_),
                                             "initial mesh 'lattice'");
    }

private:
    dsc::mesh::TetMesh labelled(std::span<const dsc::generate::Shape> shapes,
                                const dsc::CancelToken* cancel) const {
        const auto same = [&](const Vec3& centre, double radius) {
            return dsc::generate::same_label_within(shapes, centre, radius);
        };
        dsc::mesh::TetMesh out =
            dsc::generate::make_lattice(params_, same, "initial mesh 'lattice'", cancel);
        for (std::size_t t = 0; t < out.tets.size(); ++t) {
            const auto& v = out.tets[t];
            out.labels[t] = dsc::generate::label_of(
                shapes, {out.points[v[0]], out.points[v[1]], out.points[v[2]], out.points[v[3]]});
        }
        if (dsc::generate::labels_touch_box(out)) {
            throw dsc::ConfigError(
                "lattice.box",
                "initial mesh 'lattice': a shape reaches the faces of the box; make the shape "
                "smaller or `box` larger");
        }
        return out;
    }

    Params params_;
    std::vector<dsc::generate::Shape> shapes_;
};

}  // namespace

DSC_PLUGIN("lattice", DSC_VERSION, "BSD-3-Clause",
           "Start from a graded box of tetrahedra that contains simple shapes") {
    registrar.add<Lattice>(
        "lattice", "a box of cells, fine at the surface of the shapes, coarse away from it");
}
