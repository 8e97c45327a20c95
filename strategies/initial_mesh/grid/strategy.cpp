// Initial mesh `grid`: a box of equal cells, five tets each.
//
// Cells alternate between two mirrored patterns of five tets (four corners and a regular one in the
// middle), so that the diagonals of neighbouring cells agree. Tets are labelled by the shapes in
// their order; their interface is stair-stepped, or projected onto the surface of the shapes.
#include <vector>

#include <dsc/base/version.hpp>
#include <dsc/generate/project.hpp>
#include <dsc/hooks/initial_mesh.hpp>
#include <dsc/plugin/plugin.hpp>
#include <dsc/plugin/shape_params.hpp>

namespace {

using dsc::Vec3;

using Corner = std::array<std::uint8_t, 3>;  // offsets x, y, z within a cell
using Pattern = std::array<std::array<Corner, 4>, 5>;

constexpr Pattern even_cell = {{{{{0, 0, 0}, {0, 0, 1}, {1, 0, 1}, {0, 1, 1}}},
                                {{{0, 0, 0}, {0, 1, 1}, {1, 1, 0}, {0, 1, 0}}},
                                {{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {1, 0, 1}}},
                                {{{1, 1, 1}, {1, 0, 1}, {0, 1, 1}, {1, 1, 0}}},
                                {{{0, 0, 0}, {1, 1, 0}, {0, 1, 1}, {1, 0, 1}}}}};
constexpr Pattern odd_cell = {{{{{0, 0, 0}, {0, 0, 1}, {1, 0, 0}, {0, 1, 0}}},
                               {{{0, 1, 0}, {1, 1, 0}, {1, 1, 1}, {1, 0, 0}}},
                               {{{0, 1, 1}, {0, 1, 0}, {1, 1, 1}, {0, 0, 1}}},
                               {{{1, 0, 1}, {1, 0, 0}, {0, 0, 1}, {1, 1, 1}}},
                               {{{0, 0, 1}, {1, 0, 0}, {0, 1, 0}, {1, 1, 1}}}}};

std::vector<Vec3> lattice_points(unsigned cells, double half, const Vec3& centre) {
    // Symmetric to the last bit: coordinate i is minus coordinate cells - i.
    const auto coordinate = [&](unsigned i) {
        return half * (2.0 * static_cast<double>(i) - static_cast<double>(cells)) /
               static_cast<double>(cells);
    };
    std::vector<Vec3> points;
    points.reserve(std::size_t{cells + 1} * (cells + 1) * (cells + 1));
    for (unsigned k = 0; k <= cells; ++k) {
        for (unsigned j = 0; j <= cells; ++j) {
            for (unsigned i = 0; i <= cells; ++i)
                points.push_back(centre + Vec3(coordinate(i), coordinate(j), coordinate(k)));
        }
    }
    return points;
}

class Grid final : public dsc::hooks::InitialMesh {
public:
    /// The parameters that an experiment may set; the values here are the defaults.
    struct Params : dsc::plugin::ShapeParams {
        int cells = 30;
        double box = 1.5;
        Vec3 box_centre = Vec3::Zero();
    };
    static void declare(dsc::config::ParamSchema<Params>& schema) {
        schema.integer("cells", &Params::cells)
            .range(1, 200, "dimensionless")
            .costly()
            .doc("Number of cells along each edge of the box.");
        schema.real("box", &Params::box)
            .greater(0, "length")
            .doc("Half the edge length of the box.");
        schema.vec3("box_centre", &Params::box_centre).unit("length").doc("Centre of the box.");
        dsc::plugin::declare_shapes(schema);
    }

    Grid(const Params& params, const dsc::plugin::Setup&)
        : cells_(params.cells),
          box_(params.box),
          box_centre_(params.box_centre),
          project_(params.project),
          shapes_(params.all()) {}

    /// Not projected: vertex (i, j, k) has index i + j (N+1) + k (N+1)^2; cells come with k
    /// outermost, then j, then i; all tets are positive. Throws CancelledError.
    dsc::mesh::TetMesh build(const dsc::hooks::InitialMeshContext& context) override {
        if (!project_) return lattice(context, shapes_);
        return dsc::generate::make_projected(
            [&](std::span<const dsc::generate::Shape> shapes) { return lattice(context, shapes); },
            shapes_, 2 * box_ / cells_, "initial mesh 'grid'");
    }

private:
    dsc::mesh::TetMesh lattice(const dsc::hooks::InitialMeshContext& context,
                               std::span<const dsc::generate::Shape> shapes) const {
        const auto cells = static_cast<unsigned>(cells_);
        const unsigned row = cells + 1;
        dsc::mesh::TetMesh out;
        out.points = lattice_points(cells, box_, box_centre_);
        out.tets.reserve(std::size_t{5} * cells * cells * cells);
        out.labels.reserve(out.tets.capacity());
        for (unsigned k = 0; k < cells; ++k) {
            if (context.cancel != nullptr && context.cancel->cancelled()) {
                throw dsc::CancelledError("the run was stopped while it made its initial mesh");
            }
            for (unsigned j = 0; j < cells; ++j) {
                for (unsigned i = 0; i < cells; ++i) {
                    for (const auto& pattern : (i + j + k) % 2 == 0 ? even_cell : odd_cell) {
                        std::array<std::uint32_t, 4> tet{};
                        std::array<Vec3, 4> corners;
                        for (std::size_t c = 0; c < 4; ++c) {
                            const auto& [x, y, z] = pattern[c];
                            tet[c] = (i + x) + row * ((j + y) + row * (k + z));
                            corners[c] = out.points[tet[c]];
                        }
                        out.tets.push_back(tet);
                        out.labels.push_back(dsc::generate::label_of(shapes, corners));
                    }
                }
            }
        }
        return out;
    }

    int cells_;
    double box_;
    Vec3 box_centre_;
    bool project_;
    std::vector<dsc::generate::Shape> shapes_;
};

}  // namespace

DSC_PLUGIN("grid", DSC_VERSION, "BSD-3-Clause",
           "Start from a regular box of tetrahedra that contains simple shapes") {
    registrar.add<Grid>("grid",
                        "a box of equal cells with five tets each; shapes are added and cut");
}
