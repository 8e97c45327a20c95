// Names of the kinds of strategies.
#include "dsc/plugin/kind.hpp"

namespace dsc::plugin {

std::string_view kind_name(Kind kind) noexcept {
    switch (kind) {
        case Kind::velocity: return "velocity";
        case Kind::curvature: return "curvature";
        case Kind::refinement: return "refinement";
        case Kind::initial_mesh: return "initial_mesh";
        case Kind::improvement: return "improvement";
        case Kind::observer: return "observer";
        case Kind::filter: return "filter";
    }
    return {};
}

std::optional<Kind> find_kind(std::string_view name) noexcept {
    for (const Kind kind : all_kinds) {
        if (kind_name(kind) == name) return kind;
    }
    return std::nullopt;
}

}  // namespace dsc::plugin
