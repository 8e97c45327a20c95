// Improvement `@NAME@`: removes an edge or a face of a poor tet and moves its free vertices;
// collapses a hopeless tet.
//
// A tet is poor if its volume-length quality is below `poor`, and hopeless if it is below
// `hopeless`.
#include <dsc/hooks/improvement.hpp>
#include <dsc/plugin/plugin.hpp>

namespace {

using dsc::repair::Operation;
using dsc::repair::Request;

class @CLASS@ final : public dsc::hooks::Improvement {
public:
    /// The parameters that an experiment may set; the values here are the defaults.
    struct Params {
        double poor = 0.3;
        double hopeless = 0.05;
    };
    static void declare(dsc::config::ParamSchema<Params>& schema) {
        schema.real("poor", &Params::poor)
            .range(0, 1, "dimensionless")
            .doc("Volume-length quality below which tets are repaired.");
        schema.real("hopeless", &Params::hopeless)
            .range(0, 1, "dimensionless")
            .doc("Quality below which tets are collapsed, even if this changes the shape of the "
                 "interface within the kernel's bounds.");
        schema.check([](const Params& p) { return p.hopeless <= p.poor; },
                     "hopeless must not be above poor");
    }

    @CLASS@(const Params& params, const dsc::plugin::Setup&) : params_(params) {}

    // Called once per repair round. `round.dirty` contains the tets to examine, worst first; the
    // kernel takes the requests in their order and carries out those that keep the mesh valid and
    // do not make it worse.
    void propose(const dsc::hooks::StepContext&, const dsc::repair::RepairRound& round,
                 std::vector<Request>& out) override {
        const dsc::mesh::Complex& complex = round.complex;
        for (const dsc::mesh::TetId tet : round.dirty) {
            const auto quality = static_cast<double>(complex.quality(tet));
            if (quality >= params_.poor) continue;
            out.push_back(request(complex, tet, Operation::edge_removal, params_.poor));
            out.push_back(request(complex, tet, Operation::face_removal, params_.poor));
            for (const dsc::mesh::VertexId v : complex.tet(tet).v) {
                if (complex.on_interface(v) || complex.on_box(v)) continue;
                out.push_back(request(complex, tet, Operation::smooth_optimise, params_.poor));
                out.back().vertices[0] = v;
            }
            if (quality >= params_.hopeless) continue;
            out.push_back(request(complex, tet, Operation::edge_collapse, params_.hopeless));
            out.back().mode = dsc::repair::CollapseMode::bounded;
        }
    }

    // The topology of the interface does not change.
    dsc::repair::TopologyLimits topology_limits() const override {
        dsc::repair::TopologyLimits limits;
        limits.thickness = 0.0;
        return limits;
    }

private:
    // For the current tet: the request is skipped if another operation has changed or repaired the
    // tet before.
    static Request request(const dsc::mesh::Complex& complex, dsc::mesh::TetId tet,
                           Operation operation, double below) {
        Request request;
        request.operation = operation;
        request.tet = tet;
        request.birth_date = complex.birth_date(tet);
        request.only_below = static_cast<float>(below);
        return request;
    }

    Params params_;
};

}  // namespace

DSC_PLUGIN("@NAME@", "0.1.0", "BSD-3-Clause", "Improvement @NAME@") {
    registrar.add<@CLASS@>("@NAME@",
                           "removes an edge or a face of poor tets, and collapses hopeless tets");
}
