#pragma once
// Visits tets that lie in no order of memory. The memory is asked ahead for what the visits will
// read, because each wait for it takes longer than a visit.

#include <array>
#include <cstddef>
#include <span>

#include <dsc/mesh/complex.hpp>

namespace dsc::mesh {

/// Calls visit(i) for each tets[i], in this order. Some visits before that it asks the memory for
/// the tet, then for its vertices, and then, if looks_across(tet) is true, for what lies across its
/// faces. looks_across() is asked once per live tet. It may read the vertices, may ask the memory
/// for other data of the visit, and must not be expensive; nothing depends on it but the time.
/// [parallel]
template <class LooksAcross, class Visit>
void visit_tets(const Complex& complex, std::span<const TetId> tets,
                const LooksAcross& looks_across, const Visit& visit) {
    // How many visits before.
    constexpr std::size_t tet = 40, vertices = 28, codes = 16, across = 6;
    std::array<bool, codes> looks{};  // of the next visits
    const std::size_t count = tets.size();
    for (std::size_t i = 0; i < count; ++i) {
        if (i + tet < count) complex.prefetch(tets[i + tet]);
        if (i + vertices < count) complex.prefetch_vertices(tets[i + vertices]);
        if (i + codes < count) {
            const TetId t = tets[i + codes];
            const bool look = complex.tet_alive(t) && looks_across(t);
            looks[i % codes] = look;
            if (look) complex.prefetch_codes(t);
        }
        // The place of visit i + across was written codes - across visits ago.
        if (i + across < count && i + across >= codes && looks[(i + across) % codes])
            complex.prefetch_across(tets[i + across]);
        visit(i);
    }
}

}  // namespace dsc::mesh
