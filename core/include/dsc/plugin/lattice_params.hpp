#pragma once
// The parameters of a generator that fills its box with lattice tets.

#include <string>
#include <type_traits>

#include <dsc/config/params.hpp>
#include <dsc/generate/lattice.hpp>

namespace dsc::plugin {

/// Declares the keys of a Params derived from generate::LatticeOptions. `where` says for the
/// documentation where the finest cells are. [setup]
template <class Params>
void declare_lattice(config::ParamSchema<Params>& schema, const std::string& where) {
    using Options = generate::LatticeOptions;
    static_assert(std::is_base_of_v<Options, Params>);
    schema.integer("cells", static_cast<int Params::*>(&Options::cells))
        .range(generate::least_lattice_cells, generate::most_lattice_cells, "dimensionless")
        .costly()
        .doc("Number of finest cells along the box. The box grows to the next number that the "
             "octree allows.");
    schema.real("cell", static_cast<std::optional<double> Params::*>(&Options::cell))
        .greater(0, "length")
        .doc("Edge of the finest cells; unset: the edge that results from 'cells'.");
    schema.real("box", static_cast<double Params::*>(&Options::box))
        .greater(0, "length")
        .doc("Half the edge of the box; the box may become larger.");
    schema.vec3("box_centre", static_cast<Vec3 Params::*>(&Options::box_centre))
        .unit("length")
        .doc("Centre of the box.");
    schema.integer("layers", static_cast<int Params::*>(&Options::layers))
        .range(2, 64, "dimensionless")
        .doc("Number of layers of finest cells on each side of " + where + ".");
    schema.real("growth", static_cast<double Params::*>(&Options::growth))
        .range(1, 2, "dimensionless")
        .doc("How much larger the cells become from one layer to the next, on average: 2 doubles "
             "them with every layer, 1.26 with every third layer; 1 keeps all cells at the finest "
             "size.");
    schema
        .choice(
            "finest", static_cast<generate::LatticePattern Params::*>(&Options::finest),
            {{"parity", generate::LatticePattern::parity}, {"bcc", generate::LatticePattern::bcc}})
        .doc("Tets of the finest cells: 'parity' cuts each cell of a grid into five tets, with "
             "flat walls between cells; 'bcc' uses the body-centred lattice, whose tets have "
             "better shapes but make a rougher interface.");
    schema.check(
        [](const Params& p) {
            const double cells = p.wanted_cells();
            return cells >= generate::least_lattice_cells && cells <= generate::most_lattice_cells;
        },
        "cell must fit at least " + std::to_string(generate::least_lattice_cells) +
            " and at most " + std::to_string(generate::most_lattice_cells) +
            " times into twice the box");
}

}  // namespace dsc::plugin
