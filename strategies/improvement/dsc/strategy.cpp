// Improvement `dsc`: the quality-driven repairs of the deformable simplicial complex, with the
// topology policy.
//
// Smooths, flips, collapses and splits by quality and size [Misztal2012]; lets the topology change
// where a sheet, gap or neck is thin and no cloud point supports it. proposals.cpp chooses the
// repairs of a round, shapes.cpp those by the shape of single edges, faces and tets.
#include <algorithm>

#include <dsc/base/version.hpp>
#include <dsc/hooks/improvement.hpp>
#include <dsc/plugin/plugin.hpp>

#include "proposals.hpp"

namespace {

class DscImprovement final : public dsc::hooks::Improvement {
public:
    struct Topology {
        bool open = true;
        bool merge = true;
        bool cut = true;
        double thickness = 1.0;
        double support = 0.5;
        double spacing = 0.8;
        double min_component = 2.0;

        static void declare(dsc::config::ParamSchema<Topology>& schema) {
            schema.boolean("open", &Topology::open)
                .doc("Allow holes in thin sheets of a label above 0.");
            schema.boolean("merge", &Topology::merge)
                .doc("Allow bridges across thin gaps of label 0.");
            schema.boolean("cut", &Topology::cut).doc("Allow cuts through thin necks.");
            schema.real("thickness", &Topology::thickness)
                .range(0, 2, "target lengths (L)")
                .doc("Largest thickness of sheets, gaps and necks that may change topology; 0 "
                     "switches all changes off.");
            schema.real("support", &Topology::support)
                .range(0, 10, "target lengths (L)")
                .doc("Distance from the centre of a change within which a cloud point forbids it.");
            schema.real("spacing", &Topology::spacing)
                .range(0, 10, "neighbour distances")
                .doc("Distance from necks and rims of sheets within which a cloud point forbids a "
                     "change. The unit is the distance from the point to its sixth neighbour, "
                     "because few points lie on a thin part of the object where the cloud is "
                     "sparse.");
            schema.real("min_component", &Topology::min_component)
                .range(0, 1000, "dimensionless")
                .doc("Volume below which components are removed, in regular tets with edges of the "
                     "target length.");
        }
    };

    /// The parameters that an experiment may set; the values here are the defaults.
    struct Params : dsc::improvement::Thresholds {
        double flatness = dsc::repair::default_flatness;
        Topology topology;
    };
    static void declare(dsc::config::ParamSchema<Params>& schema) {
        schema.real("min_tet_quality", &Params::min_tet_quality)
            .range(0, 1, "dimensionless")
            .doc("Volume-length quality below which tets are repaired.");
        schema.real("degenerate_tet_quality", &Params::degenerate_tet_quality)
            .range(0, 1, "dimensionless")
            .doc("Quality below which tets are removed, even if this changes the shape of the "
                 "interface within the kernel's bounds.");
        schema.real("smooth_below", &Params::smooth_below)
            .range(0, 1, "dimensionless")
            .doc("Quality of tets below which their free vertices are smoothed.");
        schema.real("min_edge_length", &Params::min_edge_length)
            .range(0, 1, "target lengths (L)")
            .doc("Length below which interface edges are collapsed.");
        schema.real("max_edge_length", &Params::max_edge_length)
            .range(1, 100, "target lengths (L)")
            .doc("Length above which interface edges are split where the interface is not flat.");
        schema.real("min_tet_volume", &Params::min_tet_volume)
            .range(0, 1, "dimensionless")
            .doc("Volume below which tets are collapsed, in regular tets with edges of the target "
                 "length.");
        schema.real("max_free_edge", &Params::max_free_edge)
            .range(0, 100, "target lengths (L)")
            .doc("Length above which edges from the interface into a phase are split, so that the "
                 "surface does not get stuck when it moves into large tets; 0 switches this off.");
        schema.real("degenerate_edge_quality", &Params::degenerate_edge_quality)
            .range(0, 1, "target lengths (L)")
            .doc("Length below which edges, also inside a phase, are collapsed, even if this "
                 "changes the shape of the interface within the kernel's bounds; 0 switches this "
                 "off.");
        schema.real("min_edge_quality", &Params::min_edge_quality)
            .range(0, 1, "target lengths (L)")
            .doc("Length below which edges are collapsed if neither shape nor quality is lost; 0 "
                 "switches this off.");
        schema.real("degenerate_face_quality", &Params::degenerate_face_quality)
            .range(0, 0.5, "dimensionless")
            .doc("Quality, 1 - max |cos| over the corners, below which faces are removed, even if "
                 "this changes the shape of the interface within the kernel's bounds; 0 switches "
                 "this off.");
        schema.real("min_face_quality", &Params::min_face_quality)
            .range(0, 0.5, "dimensionless")
            .doc("Quality below which faces are removed if neither shape nor quality is lost; 0 "
                 "switches this off.");
        schema.real("min_face_area", &Params::min_face_area)
            .range(0, 1, "dimensionless")
            .doc("Area below which the shortest edge of an interface face is collapsed, in regular "
                 "triangles with edges of the target length; 0 switches this off.");
        schema.real("max_face_area", &Params::max_face_area)
            .range(0, 1000, "dimensionless")
            .doc(
                "Area above which interface faces, also flat ones, are split at their longest "
                "edge, in regular triangles with edges of the target length; 0 switches this off.");
        schema.real("max_tet_volume", &Params::max_tet_volume)
            .range(0, 1e9, "dimensionless")
            .doc("Volume above which tets are split at their longest edge, in regular tets with "
                 "edges of the target length; 0 switches this off.");
        schema.real("flatness", &Params::flatness)
            .range(0, 1, "dimensionless")
            .advanced()
            .doc("Cosine between the normals of neighbouring interface faces above which they "
                 "count as flat.");
        schema.object("topology", &Params::topology, Topology::declare)
            .doc("Conditions under which the interface may change its topology.");
        schema.check([](const Params& p) { return p.degenerate_tet_quality <= p.min_tet_quality; },
                     "degenerate_tet_quality must not be above min_tet_quality");
        schema.check(
            [](const Params& p) {
                return p.min_edge_quality == 0 || p.degenerate_edge_quality <= p.min_edge_quality;
            },
            "degenerate_edge_quality must not be above min_edge_quality");
        schema.check(
            [](const Params& p) {
                return p.min_face_quality == 0 || p.degenerate_face_quality <= p.min_face_quality;
            },
            "degenerate_face_quality must not be above min_face_quality");
        schema.check(
            [](const Params& p) {
                return p.max_face_area == 0 || p.max_face_area >= 2 * p.min_face_area;
            },
            "max_face_area must be at least twice min_face_area: the halves of a split face must "
            "not be too small");
        schema.check(
            [](const Params& p) {
                return p.max_tet_volume == 0 || p.max_tet_volume >= 2 * p.min_tet_volume;
            },
            "max_tet_volume must be at least twice min_tet_volume: the halves of a split tet must "
            "not be too small");
    }

    DscImprovement(const Params& params, const dsc::plugin::Setup&)
        : params_(params), proposals_(params) {}

    void propose(const dsc::hooks::StepContext& context, const dsc::repair::RepairRound& round,
                 std::vector<dsc::repair::Request>& out) override {
        proposals_.write(round, context.workers, out);
    }

    double flatness() const override { return params_.flatness; }

    dsc::repair::TopologyLimits topology_limits() const override {
        const Topology& t = params_.topology;
        return {t.thickness, t.min_component, t.open, t.merge, t.cut};
    }

    void select(const dsc::hooks::StepContext& context,
                std::span<const dsc::repair::TopologyCandidate> candidates,
                std::span<std::uint8_t> accept) override {
        const double support = params_.topology.support * context.target_length;
        for (std::size_t i = 0; i < candidates.size(); ++i) {
            accept[i] = 1;
            if (context.cloud == nullptr) continue;
            const dsc::cloud::Neighbour nearest =
                context.cloud->search().nearest(candidates[i].centroid);
            double reach = support;
            if (candidates[i].kind == dsc::repair::TopologyCandidate::Kind::cut ||
                candidates[i].kind == dsc::repair::TopologyCandidate::Kind::shift) {
                reach = std::max(reach, params_.topology.spacing *
                                            context.cloud->neighbour_distance(nearest.index));
            }
            accept[i] = nearest.distance > reach ? 1 : 0;
        }
    }

private:
    Params params_;
    dsc::improvement::Proposals proposals_;
};

}  // namespace

DSC_PLUGIN("dsc", DSC_VERSION, "BSD-3-Clause", "Quality-driven mesh improvement") {
    registrar.add<DscImprovement>("dsc",
                                  "smooths, flips, collapses and splits by quality and size");
}
