// The interface shift: a tet, with others if necessary, takes the label around it; the topology
// stays (method.md, section 4.8).

#include "kernel/creases.hpp"
#include "kernel/operations.hpp"
#include "kernel/region.hpp"

namespace dsc::kernel {

struct RelabelScratch {
    Region region;
};

namespace {

// The label behind most of the tet's interface faces; its own label if it has no interface face.
mesh::Label majority_across(const mesh::Complex& c, TetId t) {
    mesh::Label best = c.label(t);
    unsigned votes = 0;
    for (unsigned f = 0; f < 4; ++f) {
        if (!c.interface_face(t, f)) continue;
        unsigned count = 0;
        for (unsigned g = 0; g < 4; ++g)
            count += c.label_across(t, g) == c.label_across(t, f) ? 1 : 0;
        if (count <= votes) continue;
        votes = count;
        best = c.label_across(t, f);
    }
    return best;
}

}  // namespace

Outcome relabel_tet(Workbench& bench, TetId t) {
    mesh::Complex& c = bench.complex;
    Region& region = bench.relabel.get().region;
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
    const InterfaceChange change{2.0 * region.volume / region.area_to, region.volume};
    if (change.exceeds(bench.bounds_at(c.tet(t).v))) return Refusal::bound;
    if (const Outcome o = check_creases(bench, region.tets, region.to); o.refused()) return o;
    bench.commit(relabelling(region), change);
    return success;
}

}  // namespace dsc::kernel
