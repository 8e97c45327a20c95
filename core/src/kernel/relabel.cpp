// The interface shift: a tet, with others if necessary, takes the label around it; the topology stays (method.md, section 4.8).
#include <dsc/geometry/quality.hpp>

#include "kernel/creases.hpp"
#include "kernel/operations.hpp"
#include "kernel/region.hpp"

namespace dsc::kernel {
namespace {

// The label behind most of the tet's interface faces; its own label if it has no interface face.
mesh::Label majority_across(const mesh::Complex& c, TetId t) {
    mesh::Label best = c.label(t);
    unsigned votes = 0;
    for (unsigned f = 0; f < 4; ++f) {
        if (!c.interface_face(t, f)) continue;
        unsigned count = 0;
        for (unsigned g = 0; g < 4; ++g) count += c.label_across(t, g) == c.label_across(t, f) ? 1 : 0;
        if (count <= votes) continue;
        votes = count;
        best = c.label_across(t, f);
    }
    return best;
}

}  // namespace

Refusal relabel_tet(Workbench& bench, TetId t) {
    mesh::Complex& c = bench.complex;
    Region region;
    region.tets.assign(1, t);
    region.from = c.label(t);
    region.to = majority_across(c, t);
    if (region.to == region.from) return Refusal::not_applicable;
    switch (grow(bench, region)) {
        case RegionFault::none: break;
        case RegionFault::box: return Refusal::box;
        case RegionFault::too_large: return Refusal::bound;
        default: return Refusal::irregular;
    }
    if (measure(bench, region) != RegionFault::none) return Refusal::irregular;
    if (region.patches_from != 1 || region.patches_to != 1) return Refusal::irregular;
    const double distance = 2.0 * region.volume / region.area_to;
    const EditBounds bounds = bench.bounds_at(c.tet(t).v);
    if (region.volume > bounds.volume || distance > bounds.distance) return Refusal::bound;
    if (const Refusal r = check_creases(bench, region.tets, region.to); r != Refusal::committed) return r;
    c.relabel(region.tets, region.to);
    bench.sums.distance += distance;
    bench.sums.volume += region.volume;
    bench.sums.relabelled += region.volume;
    return Refusal::committed;
}

}  // namespace dsc::kernel
