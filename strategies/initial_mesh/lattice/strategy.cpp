#include "strategy.hpp"

#include <algorithm>
#include <cmath>
#include <dsc/base/error.hpp>
#include <dsc/mesh/project.hpp>
#include <string>

namespace dsc::strategies {
namespace {

constexpr int least_cells = 4, most_cells = 1024;
constexpr unsigned cells_of_top = 6;             // largest cells along the box, at least
constexpr std::size_t most_leaves = 12'000'000;  // some 60 to 150 million tets

// Finest cells along the box before it is rounded up.
double wanted_cells(const Lattice::Params& p) {
    return p.cell ? std::ceil(2 * p.box / *p.cell - 1e-9) : static_cast<double>(p.cells);
}

// Layers of equal cells, so many that their size grows by `growth` from layer to layer on average.
unsigned coarse_layers(double growth) {
    return static_cast<unsigned>(std::ceil(std::log(2.0) / std::log(growth) - 1e-9));
}

}  // namespace

void Lattice::declare(config::ParamSchema<Params>& schema) {
    schema.integer("cells", &Params::cells)
        .range(least_cells, most_cells)
        .unit("1")
        .doc("Finest cells along the box; the box grows to the next number that the octree can have.");
    schema.real("cell", &Params::cell)
        .greater(0)
        .unit("length")
        .doc("Edge of the finest cells; unset: that of 'cells' in the box.");
    schema.real("box", &Params::box).greater(0).unit("length").doc("Half the edge of the box, at least.");
    schema.vec3("box_centre", &Params::box_centre).unit("length").doc("Centre of the box.");
    schema.integer("layers", &Params::layers)
        .range(2, 64)
        .unit("1")
        .doc("Layers of finest cells on each side of the shapes' surface.");
    schema.real("growth", &Params::growth)
        .range(1, 2)
        .unit("1")
        .doc(
            "How much larger the cells are from one layer to the next, on average: 2 doubles them with every "
            "layer, "
            "1.26 with every third; 1 keeps all cells of the finest size.");
    schema
        .choice("finest", &Params::finest,
                {{"parity", lattice::Pattern::parity}, {"bcc", lattice::Pattern::bcc}})
        .doc(
            "Tets of the finest cells: 'parity' are the five of each cell of a grid, with flat walls between "
            "cells; 'bcc' are those of the body-centred lattice, better shaped and rougher where they are "
            "labelled.");
    plugin::declare_shapes(schema);
    schema.check(
        [](const Params& p) {
            const double cells = wanted_cells(p);
            return cells >= least_cells && cells <= most_cells;
        },
        "cell must go at least " + std::to_string(least_cells) + " and at most " +
            std::to_string(most_cells) + " times into twice the box");
}

Lattice::Lattice(const Params& params, const plugin::Setup&) : params_(params), shapes_(params.all()) {}

mesh::TetMesh Lattice::build(const hooks::InitialMeshContext& context) {
    const auto cells = static_cast<unsigned>(wanted_cells(params_));
    unsigned top = 0;
    if (params_.growth > 1.0) {
        while (cells >> (top + 1) >= cells_of_top) ++top;
    }
    // Even, so that the centre of the box is a corner of cells, as half_width expects.
    const unsigned step = std::max(2U, 1U << top);
    lattice::Frame frame{(cells + step - 1) / step * step, params_.box, static_cast<double>(params_.cells),
                         params_.box_centre};
    if (params_.cell) {
        frame.length = *params_.cell;
        frame.units = 2.0;
    }
    const auto make = [&](std::span<const mesh::Shape> shapes) {
        return tiled(frame, top, shapes, context.cancel);
    };
    if (!params_.project) return make(shapes_);
    return mesh::make_projected(make, shapes_, frame.cell(), "initial mesh 'lattice'");
}

mesh::TetMesh Lattice::tiled(const lattice::Frame& frame, unsigned top, std::span<const mesh::Shape> shapes,
                             const CancelToken* cancel) const {
    const lattice::Octree octree(frame, top, shapes, static_cast<unsigned>(params_.layers),
                                 top > 0 ? coarse_layers(params_.growth) : 0);
    if (octree.leaves() > most_leaves) {
        throw ConfigError("lattice.size",
                          "initial mesh 'lattice': " + std::to_string(octree.leaves()) +
                              " cells, more than the " + std::to_string(most_leaves) +
                              " that it makes; use fewer `cells` or `layers`, or a larger `growth`");
    }
    return lattice::tile(octree, frame, shapes, params_.finest, cancel);
}

}  // namespace dsc::strategies
