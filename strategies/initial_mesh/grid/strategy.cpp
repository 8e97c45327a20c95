#include "strategy.hpp"

#include <dsc/generate/project.hpp>

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
    schema.integer("cells", &Params::cells).range(1, 200).unit("1").costly().doc("Number of cells along each edge of the box.");
    schema.real("box", &Params::box).greater(0).unit("length").doc("Half the edge length of the box.");
    schema.vec3("box_centre", &Params::box_centre).unit("length").doc("Centre of the box.");
    plugin::declare_shapes(schema);
}

Grid::Grid(const Params& params, const plugin::Setup&)
    : cells_(params.cells),
      box_(params.box),
      box_centre_(params.box_centre),
      project_(params.project),
      shapes_(params.all()) {}

mesh::TetMesh Grid::build(const hooks::InitialMeshContext& context) {
    if (!project_) return lattice(context, shapes_);
    return generate::make_projected([&](std::span<const generate::Shape> shapes) { return lattice(context, shapes); },
                                shapes_, 2 * box_ / cells_, "initial mesh 'grid'");
}

mesh::TetMesh Grid::lattice(const hooks::InitialMeshContext& context,
                            std::span<const generate::Shape> shapes) const {
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
                    out.labels.push_back(generate::label_of(shapes, corners));
                }
            }
        }
    }
    return out;
}

}  // namespace dsc::strategies
