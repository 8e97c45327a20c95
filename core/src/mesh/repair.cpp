#include <dsc/mesh/repair.hpp>

namespace dsc::mesh {

std::string_view name(Operation operation) {
    constexpr std::array<std::string_view, operation_count> names = {
        "smooth_laplacian", "smooth_optimise", "edge_removal", "interface_flip", "face_removal", "edge_split",
        "face_split",       "vertex_split",    "edge_collapse", "relabel",       "compound"};
    return names[static_cast<std::size_t>(operation)];
}

std::string_view name(Refusal refusal) {
    constexpr std::array<std::string_view, refusal_count> names = {
        "committed", "stale", "irregular", "quality", "bound", "box", "not_applicable", "no_gain"};
    return names[static_cast<std::size_t>(refusal)];
}

}  // namespace dsc::mesh
