// Names of operations and refusals, and the target length of a tet.
#include "dsc/repair/contract.hpp"

namespace dsc::repair {

std::string_view name(Operation operation) {
    constexpr std::array<std::string_view, operation_count> names = {
        "smooth_laplacian", "smooth_optimise", "edge_removal", "interface_flip",
        "face_removal",     "edge_split",      "face_split",   "vertex_split",
        "edge_collapse",    "relabel",         "compound"};
    return names[static_cast<std::size_t>(operation)];
}

std::string_view name(Refusal refusal) {
    constexpr std::array<std::string_view, refusal_count> names = {
        "", "stale", "irregular", "quality", "bound", "box", "not_applicable", "no_gain"};
    return names[static_cast<std::size_t>(refusal)];
}

Request on_tet(const mesh::Complex& complex, mesh::TetId tet, Operation operation) {
    Request request;
    request.operation = operation;
    request.tet = tet;
    request.birth_date = complex.birth_date(tet);
    return request;
}

double RepairRound::length_of(mesh::TetId t) const {
    if (lengths.empty()) return target_length;
    double sum = 0.0;
    unsigned count = 0;
    for (const mesh::VertexId v : complex.tet(t).v) {
        if (v >= lengths.size() || !(lengths[v] > 0.0)) continue;
        sum += lengths[v];
        ++count;
    }
    return count > 0 ? sum / count : target_length;
}

}  // namespace dsc::repair
