#include "strategy.hpp"

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

std::vector<Vec3> lattice_points(unsigned cells, double half) {
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
                points.emplace_back(coordinate(i), coordinate(j), coordinate(k));
        }
    }
    return points;
}

grid::Shape preset_shape(const Grid::Params& params) {
    grid::Shape shape;
    shape.centre = params.centre;
    if (params.shape == Grid::Preset::cube) {
        shape.shape = grid::ShapeKind::box;
        shape.half_size = Vec3::Constant(params.half_width);
    } else {
        shape.radius = params.radius;
        shape.rule = grid::Rule::vertices;
    }
    return shape;
}

}  // namespace

void Grid::declare(config::ParamSchema<Params>& schema) {
    schema.integer("cells", &Params::cells).range(1, 200).unit("1").doc("Cells along each edge of the box.");
    schema.real("box", &Params::box)
        .greater(0)
        .unit("length")
        .doc("Half the edge of the box, which is centred at 0.");
    schema
        .choice("shape", &Params::shape,
                {{"cube", Preset::cube}, {"sphere", Preset::sphere}, {"none", Preset::none}})
        .doc(
            "A first shape of label 1: 'cube' holds tets by their barycentres, 'sphere' those with all four "
            "vertices "
            "inside.");
    schema.real("half_width", &Params::half_width)
        .greater(0)
        .unit("length")
        .doc("Half the edge of shape 'cube'.");
    schema.real("radius", &Params::radius).greater(0).unit("length").doc("Radius of shape 'sphere'.");
    schema.vec3("centre", &Params::centre).unit("length").doc("Centre of the first shape.");
    schema.list("shapes", &Params::shapes, grid::declare_shape)
        .doc(
            "Further shapes, applied in their order: each gives the tets inside it its label or cuts them "
            "away.");
}

Grid::Grid(const Params& params, const plugin::Setup&) : cells_(params.cells), box_(params.box) {
    if (params.shape != Preset::none) shapes_.push_back(preset_shape(params));
    shapes_.insert(shapes_.end(), params.shapes.begin(), params.shapes.end());
}

mesh::Label Grid::label_of(const std::array<Vec3, 4>& corners) const {
    mesh::Label label = 0;
    for (const grid::Shape& shape : shapes_) {
        if (holds(shape, corners)) label = shape.action == grid::Action::add ? shape.label : 0;
    }
    return label;
}

mesh::TetMesh Grid::build(const hooks::InitialMeshContext& context) {
    const auto cells = static_cast<unsigned>(cells_);
    const unsigned row = cells + 1;
    mesh::TetMesh mesh;
    mesh.points = lattice_points(cells, box_);
    mesh.tets.reserve(std::size_t{5} * cells * cells * cells);
    mesh.labels.reserve(mesh.tets.capacity());
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
                        corners[c] = mesh.points[tet[c]];
                    }
                    mesh.tets.push_back(tet);
                    mesh.labels.push_back(label_of(corners));
                }
            }
        }
    }
    return mesh;
}

}  // namespace dsc::strategies
