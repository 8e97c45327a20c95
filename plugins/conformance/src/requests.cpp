#include "requests.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/core.h>

namespace dsc::conformance {

std::string unfit(const hooks::Attributes& attributes, std::size_t vertices) {
    for (std::size_t i = 0; i < attributes.size(); ++i) {
        const hooks::Attribute& a = attributes[i];
        if (!hooks::may_name_attribute(a.name))
            return "'" + a.name + "' is not a valid name for an attribute";
        const auto before = attributes.begin() + static_cast<std::ptrdiff_t>(i);
        if (std::any_of(attributes.begin(), before,
                        [&a](const hooks::Attribute& other) { return other.name == a.name; })) {
            return "attribute '" + a.name + "' is published twice";
        }
        if (a.values.size() != vertices) {
            return fmt::format("attribute '{}' has {} values for {} vertices", a.name,
                               a.values.size(), vertices);
        }
    }
    return {};
}

std::string unfit_lengths(const hooks::RefinementRequests& requests, std::size_t vertices) {
    const auto bad = [](double length) { return std::isfinite(length) && length <= 0.0; };
    for (const std::vector<double>* lengths : {&requests.sizing, &requests.target_lengths}) {
        if (!lengths->empty() && lengths->size() != vertices) {
            return fmt::format("there are {} target lengths for {} vertices", lengths->size(),
                               vertices);
        }
        if (std::any_of(lengths->begin(), lengths->end(), bad))
            return "a target length is not above 0";
    }
    if (requests.target_length < 0.0) return "the target length is below 0";
    if (requests.target_length > 0.0 && !requests.target_lengths.empty())
        return "there is a target length for all vertices and also one per vertex";
    return {};
}

void add_requests(const hooks::RefinementRequests& requests, const std::string& at, Trace& trace) {
    trace.part("faces to split" + at, 1);
    for (const std::uint32_t face : requests.split_faces) trace.add(face);
    const auto add_pair = [&trace](std::uint32_t a, std::uint32_t b) {
        trace.add(a);
        trace.add(b);
    };
    trace.part("edges to split" + at, 2);
    for (const auto& [a, b] : requests.split_edges) add_pair(a, b);
    trace.part("sizing" + at, 1);
    trace.add(std::span<const double>(requests.sizing));
    trace.part("target length" + at, 1);
    trace.add(requests.target_length);
    trace.part("target lengths" + at, 1);
    trace.add(std::span<const double>(requests.target_lengths));
    trace.part("edges to collapse" + at, 5);
    for (const hooks::CollapseRequest& r : requests.collapse_edges) {
        add_pair(r.kept, r.removed);
        trace.add(r.place);
    }
    trace.part("edges to flip" + at, 3);
    for (const hooks::FlipRequest& r : requests.flip_edges) {
        add_pair(r.edge[0], r.edge[1]);
        trace.add(r.flatness);
    }
    trace.part("vertices to move" + at, 4);
    for (const hooks::MoveRequest& r : requests.move_vertices) {
        trace.add(r.vertex);
        trace.add(r.place);
    }
    trace.part("labels" + at, 2);
    for (const auto& [tet, label] : requests.relabel) add_pair(tet, label);
}

}  // namespace dsc::conformance
