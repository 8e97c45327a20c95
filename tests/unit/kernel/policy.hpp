#pragma once
// A small repair policy for the kernel's tests, so that they do not depend on a strategy.

#include <dsc/kernel/deformer.hpp>

namespace dsc::test {

/// Edge removal, face removal, interface flip, smoothing and collapses for bad tets; collapse of
/// small ones.
inline kernel::RepairPolicy quality_policy() {
    kernel::RepairPolicy policy;
    policy.topology.thickness = 0.6;
    policy.propose = [](const repair::RepairRound& round, std::vector<repair::Request>& out) {
        const mesh::Complex& c = round.complex;
        const double small =
            0.2 * 0.11785 * round.target_length * round.target_length * round.target_length;
        for (const mesh::TetId t : round.dirty) {
            repair::Request r;
            r.tet = t;
            r.birth_date = c.birth_date(t);
            if (c.quality(t) < 0.3F) {
                for (const mesh::VertexId v : c.tet(t).v) {
                    if (c.on_interface(v) || c.on_box(v)) continue;
                    repair::Request smooth = r;
                    smooth.operation = repair::Operation::smooth_laplacian;
                    smooth.vertices[0] = v;
                    out.push_back(smooth);
                }
                for (const auto o :
                     {repair::Operation::edge_removal, repair::Operation::interface_flip,
                      repair::Operation::face_removal}) {
                    r.operation = o;
                    r.only_below = 0.3F;
                    out.push_back(r);
                }
            }
            if (c.quality(t) < 0.03F) {
                r.operation = repair::Operation::edge_collapse;
                r.mode = repair::CollapseMode::bounded;
                r.accept_above = 0.03F;
                r.only_below = 0.03F;
                out.push_back(r);
                r.operation = repair::Operation::compound;
                out.push_back(r);
                r.operation = repair::Operation::relabel;
                out.push_back(r);
            } else if (c.volume(t) < small) {
                r.operation = repair::Operation::edge_collapse;
                r.mode = repair::CollapseMode::bounded;
                r.accept_above = 0.1F;
                r.only_below = 2.0F;
                out.push_back(r);
            }
        }
    };
    return policy;
}

/// Smooths every free vertex of the dirty tets, each once a round; no topology change.
inline kernel::RepairPolicy smoothing_policy() {
    kernel::RepairPolicy policy;
    policy.topology.thickness = 0.0;
    policy.propose = [](const repair::RepairRound& round, std::vector<repair::Request>& out) {
        const mesh::Complex& c = round.complex;
        std::vector<char> listed(c.vertex_slots(), 0);
        for (const mesh::TetId t : round.dirty) {
            for (const mesh::VertexId v : c.tet(t).v) {
                if (listed[v] != 0 || c.on_interface(v) || c.on_box(v)) continue;
                listed[v] = 1;
                repair::Request smooth;
                smooth.operation = repair::Operation::smooth_laplacian;
                smooth.tet = t;
                smooth.birth_date = c.birth_date(t);
                smooth.vertices[0] = v;
                out.push_back(smooth);
            }
        }
    };
    return policy;
}

}  // namespace dsc::test
