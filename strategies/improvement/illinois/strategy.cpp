#include "strategy.hpp"

namespace dsc::strategies {

void IllinoisImprovement::declare(config::ParamSchema<Params>& schema) {
    schema.real("flat", &Params::flat)
        .range(0, 1)
        .unit("1")
        .doc("A tet is flat when a vertex is nearer than this to the plane of the others, in the smaller of its longest edge and "
             "the mean edge.");
    schema.real("wedge", &Params::wedge).range(0, 1).unit("1").doc("A flat tet with an edge shorter than this, in the same unit, is a wedge.");
    schema.real("tee", &Params::tee).range(0, 1).unit("1").doc("Where a vertex is nearer than this to an edge, it is a tee.");
    schema.real("flip_below", &Params::flip_below)
        .range(0, 1)
        .unit("1")
        .doc("Fall-back: tets that are this flat, in the unit of 'flat', are tried with flips and smoothing.");
    schema.real("smooth_below", &Params::smooth_below)
        .range(0, 1)
        .unit("1")
        .doc("Fall-back: free vertices of tets that are this flat go to the mean of their neighbours.");
    schema.real("degenerate_tet_quality", &Params::degenerate_tet_quality)
        .range(0, 1)
        .unit("1")
        .doc("A collapse may leave no tet below this volume-length quality, or below what there was.");
    schema.real("least_edge", &Params::least_edge)
        .range(0, 1)
        .unit("mean edges")
        .doc("No insertion makes an edge shorter than this, nor splits one shorter than twice this.");
    schema.real("insertions", &Params::insertions)
        .range(0, 10)
        .unit("1")
        .doc("Vertices that a step may insert, as a part of the interface's vertices.");
    schema.real("longest_spoke", &Params::longest_spoke)
        .range(0, 1000)
        .unit("mean edges")
        .doc("Edges from the interface into a phase that are longer than this are split, as the thesis tried with those that lead to "
             "the corners of the box; 0: none is.");
    schema.real("flatness", &Params::flatness)
        .range(0, 1)
        .unit("1")
        .advanced()
        .doc("Cosine between the normals of interface faces above which they count as flat.");
    schema.boolean("fallbacks", &Params::fallbacks)
        .doc("Whether a tet that its class' repair did not remove is tried with flips, smoothing and collapse; without them the "
             "motion locks, as in the thesis.");
}

IllinoisImprovement::IllinoisImprovement(const Params& params, const plugin::Setup&)
    : flatness_(params.flatness),
      repairs_({{params.wedge, params.tee},
                params.flat,
                params.flip_below,
                params.smooth_below,
                params.degenerate_tet_quality,
                params.least_edge,
                params.insertions,
                params.longest_spoke,
                params.fallbacks}) {}

void IllinoisImprovement::propose(const hooks::StepContext&, const mesh::RepairRound& round, std::vector<mesh::Request>& out) {
    repairs_.write(round, out);
}

mesh::TopologyLimits IllinoisImprovement::topology_limits() const {
    mesh::TopologyLimits limits;
    limits.thickness = 0.0;
    limits.min_component = 0.0;
    return limits;
}

}  // namespace dsc::strategies
