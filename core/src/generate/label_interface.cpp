// Counts vertices, edges and faces of the interface between two labels of vertices.
#include "generate/label_interface.hpp"

#include <algorithm>

namespace dsc::generate {

void InterfaceCounter::add(const std::array<std::uint32_t, 4>& tet,
                           const std::array<bool, 4>& inside) {
    std::size_t cut = 0;
    for (std::size_t i = 0; i < 4; ++i) {
        for (std::size_t j = i + 1; j < 4; ++j) {
            if (inside[i] == inside[j]) continue;
            ++cut;
            add_edge(tet[i], tet[j]);
        }
    }
    if (cut == 0) return;
    // With three cut edges one face has no cut; with four, all faces are cut.
    ++tets_;
    faces_of_tets_ += cut;
    for (std::size_t i = 0; i < 4; ++i) {
        const std::size_t a = (i + 1) % 4, b = (i + 2) % 4, c = (i + 3) % 4;
        if (inside[a] == inside[b] && inside[b] == inside[c]) continue;
        if (on_one_side(tet[a], tet[b], tet[c])) ++box_faces_;
    }
}

long InterfaceCounter::euler() const {
    // All cut faces belong to two tets, except those on the box.
    return static_cast<long>(edges_) - static_cast<long>((faces_of_tets_ + box_faces_) / 2) +
           static_cast<long>(tets_);
}

void InterfaceCounter::add_edge(std::uint32_t a, std::uint32_t b) {
    const std::uint64_t key = static_cast<std::uint64_t>(std::min(a, b)) << 32U | std::max(a, b);
    const auto slot_of = [&](std::uint64_t k) -> std::uint64_t& {
        const std::size_t mask = slots_.size() - 1;
        std::size_t at = static_cast<std::size_t>(k * 0x9e3779b97f4a7c15U >> 24U) & mask;
        while (slots_[at] != 0 && slots_[at] != k) at = (at + 1) & mask;
        return slots_[at];
    };
    if (slot_of(key) == key) return;
    if (2 * (edges_ + 1) > slots_.size()) {
        std::vector<std::uint64_t> old(2 * slots_.size(), 0);
        old.swap(slots_);
        for (const std::uint64_t k : old) {
            if (k != 0) slot_of(k) = k;
        }
    }
    slot_of(key) = key;
    ++edges_;
}

bool InterfaceCounter::on_one_side(std::uint32_t a, std::uint32_t b, std::uint32_t c) const {
    const Vec3 &p = points_[a], &q = points_[b], &r = points_[c];
    for (int i = 0; i < 3; ++i) {
        if (p[i] == q[i] && q[i] == r[i] && (p[i] == box_.low[i] || p[i] == box_.high[i]))
            return true;
    }
    return false;
}

}  // namespace dsc::generate
