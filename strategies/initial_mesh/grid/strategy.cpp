#include "strategy.hpp"

#include <dsc/mesh/adopt.hpp>
#include <dsc/mesh/project.hpp>

namespace dsc::strategies {
namespace {

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

}  // namespace

void Grid::declare(config::ParamSchema<Params>& schema) {
    schema.integer("cells", &Params::cells).range(1, 200).unit("1").doc("Cells along each edge of the box.");
    schema.real("box", &Params::box)
        .greater(0)
        .unit("length")
        .doc("Half the edge of the box.");
    schema.vec3("box_centre", &Params::box_centre).unit("length").doc("Centre of the box.");
    schema.boolean("project", &Params::project)
        .doc(
            "Takes the interface's vertices to the shapes' surface; tets are labelled by their vertices then, "
            "whatever the shapes' rules say.");
    plugin::declare_shapes(schema);
}

Grid::Grid(const Params& params, const plugin::Setup&)
    : cells_(params.cells),
      box_(params.box),
      box_centre_(params.box_centre),
      project_(params.project),
      shapes_(params.all()) {}

mesh::TetMesh Grid::build(const hooks::InitialMeshContext& context) {
    return project_ ? projected(context) : lattice(context, shapes_);
}

mesh::TetMesh Grid::projected(const hooks::InitialMeshContext& context) const {
    // Tets whose vertices all lie within this part of a cell outside a shape belong to it: so no tet outside has four
    // vertices on the interface, and the vertices come from both sides of the surface.
    constexpr double reach = 0.4;
    std::vector<mesh::Shape> shapes;
    for (const mesh::Shape& shape : shapes_) {
        shapes.push_back(mesh::grown(shape, reach * 2 * box_ / cells_));
        shapes.back().rule = mesh::ShapeRule::vertices;
    }
    mesh::Complex complex = mesh::adopt(lattice(context, shapes), "initial mesh 'grid'", nullptr, 0.0);
    mesh::project_interface(complex, [this](const Vec3& p) { return mesh::nearest_on_surface(shapes_, p); });
    return complex.to_mesh();
}

mesh::TetMesh Grid::lattice(const hooks::InitialMeshContext& context, std::span<const mesh::Shape> shapes) const {
    const auto cells = static_cast<unsigned>(cells_);
    const unsigned row = cells + 1;
    mesh::TetMesh out;
    out.points = lattice_points(cells, box_, box_centre_);
    out.tets.reserve(std::size_t{5} * cells * cells * cells);
    out.labels.reserve(out.tets.capacity());
    for (unsigned k = 0; k < cells; ++k) {
        if (context.cancel != nullptr && context.cancel->cancelled()) {
            throw CancelledError("the initial mesh was not finished");
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
                    out.labels.push_back(mesh::label_of(shapes, corners));
                }
            }
        }
    }
    return out;
}

}  // namespace dsc::strategies
