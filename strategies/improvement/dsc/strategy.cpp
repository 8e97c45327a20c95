#include "strategy.hpp"

#include <algorithm>

namespace dsc::strategies {

void DscImprovement::Topology::declare(config::ParamSchema<Topology>& schema) {
    schema.boolean("open", &Topology::open).doc("Thin sheets of a label above 0 may be pierced.");
    schema.boolean("merge", &Topology::merge).doc("Thin gaps of label 0 may be bridged.");
    schema.boolean("cut", &Topology::cut).doc("Thin necks may be cut.");
    schema.real("thickness", &Topology::thickness)
        .range(0, 2)
        .unit("mean edges")
        .doc("Sheets, gaps and necks up to this thickness may change topology; 0 switches all changes off.");
    schema.real("support", &Topology::support)
        .range(0, 10)
        .unit("mean edges")
        .doc("A change is vetoed where a cloud point lies this close to its centre.");
    schema.real("spacing", &Topology::spacing)
        .range(0, 10)
        .unit("1")
        .doc("Necks and the rims of sheets are also spared this close to a cloud point, in distances to its sixth neighbour there: where "
             "the cloud is sparse, a thin part of the object has few points of its own.");
    schema.real("min_component", &Topology::min_component)
        .range(0, 1000)
        .unit("1")
        .doc("Components below this many regular tets of the mean edge vanish.");
}

void DscImprovement::declare(config::ParamSchema<Params>& schema) {
    schema.real("min_tet_quality", &Params::min_tet_quality)
        .range(0, 1)
        .unit("1")
        .doc("Tets below this volume-length quality are repaired.");
    schema.real("degenerate_tet_quality", &Params::degenerate_tet_quality)
        .range(0, 1)
        .unit("1")
        .doc("Tets below this quality are removed, at the price of the interface's shape within the kernel's bounds.");
    schema.real("smooth_below", &Params::smooth_below)
        .range(0, 1)
        .unit("1")
        .doc("Free vertices of tets below this quality are smoothed.");
    schema.real("min_edge_length", &Params::min_edge_length)
        .range(0, 1)
        .unit("mean edges")
        .doc("Interface edges shorter than this are collapsed.");
    schema.real("max_edge_length", &Params::max_edge_length)
        .range(1, 100)
        .unit("mean edges")
        .doc("Interface edges longer than this are split where the interface is not flat.");
    schema.real("min_tet_volume", &Params::min_tet_volume)
        .range(0, 1)
        .unit("1")
        .doc("Tets below this part of a regular tet with the mean edge are thinned out.");
    schema.real("max_free_edge", &Params::max_free_edge)
        .range(0, 100)
        .unit("mean edges")
        .doc("Edges from the interface into a phase that are longer than this are split, so that a surface that moves into large tets "
             "finds room there; 0 switches it off.");
    schema.real("degenerate_edge_quality", &Params::degenerate_edge_quality)
        .range(0, 1)
        .unit("mean edges")
        .doc("Edges shorter than this, inside a phase too, are collapsed, at the price of the interface's shape within the kernel's "
             "bounds; 0 switches it off.");
    schema.real("min_edge_quality", &Params::min_edge_quality)
        .range(0, 1)
        .unit("mean edges")
        .doc("Edges shorter than this are collapsed where that costs neither shape nor quality; 0 switches it off.");
    schema.real("degenerate_face_quality", &Params::degenerate_face_quality)
        .range(0, 0.5)
        .unit("1")
        .doc("Faces below this quality, 1 - max |cos| over the corners, are removed, at the price of the interface's shape within the "
             "kernel's bounds; 0 switches it off.");
    schema.real("min_face_quality", &Params::min_face_quality)
        .range(0, 0.5)
        .unit("1")
        .doc("Faces below this quality are removed where that costs neither shape nor quality; 0 switches it off.");
    schema.real("min_face_area", &Params::min_face_area)
        .range(0, 1)
        .unit("1")
        .doc("Interface faces below this part of a regular triangle with the mean edge lose their shortest edge; 0 switches it off.");
    schema.real("max_face_area", &Params::max_face_area)
        .range(0, 1000)
        .unit("1")
        .doc("Interface faces above so many regular triangles with the mean edge are split at their longest edge, flat ones too; 0 "
             "switches it off.");
    schema.real("max_tet_volume", &Params::max_tet_volume)
        .range(0, 1e9)
        .unit("1")
        .doc("Tets above so many regular tets with the mean edge are split at their longest edge; 0 switches it off.");
    schema.real("flatness", &Params::flatness)
        .range(0, 1)
        .unit("1")
        .advanced()
        .doc("Cosine between the normals of interface faces above which they count as flat.");
    schema.object("topology", &Params::topology, Topology::declare).doc("When the interface may change its topology.");
    schema.check([](const Params& p) { return p.degenerate_tet_quality <= p.min_tet_quality; },
                 "degenerate_tet_quality must not be above min_tet_quality");
    schema.check([](const Params& p) { return p.min_edge_quality == 0 || p.degenerate_edge_quality <= p.min_edge_quality; },
                 "degenerate_edge_quality must not be above min_edge_quality");
    schema.check([](const Params& p) { return p.min_face_quality == 0 || p.degenerate_face_quality <= p.min_face_quality; },
                 "degenerate_face_quality must not be above min_face_quality");
    schema.check([](const Params& p) { return p.max_face_area == 0 || p.max_face_area >= 2 * p.min_face_area; },
                 "max_face_area must be at least twice min_face_area: the halves of a split face must not be too small");
    schema.check([](const Params& p) { return p.max_tet_volume == 0 || p.max_tet_volume >= 2 * p.min_tet_volume; },
                 "max_tet_volume must be at least twice min_tet_volume: the halves of a split tet must not be too small");
}

DscImprovement::DscImprovement(const Params& params, const plugin::Setup&)
    : params_(params),
      proposals_({params.min_tet_quality, params.degenerate_tet_quality, params.smooth_below, params.min_edge_length,
                  params.max_edge_length, params.min_tet_volume, params.max_free_edge, params}) {}

void DscImprovement::propose(const hooks::StepContext& context, const mesh::RepairRound& round, std::vector<mesh::Request>& out) {
    proposals_.write(round, context.workers, out);
}

mesh::TopologyLimits DscImprovement::topology_limits() const {
    const Topology& t = params_.topology;
    return {t.thickness, t.min_component, t.open, t.merge, t.cut};
}

void DscImprovement::select(const hooks::StepContext& context, std::span<const mesh::TopologyCandidate> candidates,
                            std::span<std::uint8_t> accept) {
    const double support = params_.topology.support * context.target_length;
    for (std::size_t i = 0; i < candidates.size(); ++i) {
        accept[i] = 1;
        if (context.cloud == nullptr) continue;
        const cloud::Neighbour nearest = context.cloud->search().nearest(candidates[i].centroid);
        double reach = support;
        if (candidates[i].kind == mesh::TopologyCandidate::Kind::cut || candidates[i].kind == mesh::TopologyCandidate::Kind::shift) {
            reach = std::max(reach, params_.topology.spacing * context.cloud->spacing(nearest.index));
        }
        accept[i] = nearest.distance > reach ? 1 : 0;
    }
}

}  // namespace dsc::strategies
