// Linking a cavity: finds the neighbours of the added tets, among each other and across the
// boundary of the cavity (method.md, section 4.1).
#include <algorithm>
#include <bit>

#include <dsc/mesh/complex.hpp>

namespace dsc::mesh {

void Edit::clear() {
    removed.clear();
    added.clear();
    moved = none;
    creates = false;
    deleted = none;
    neighbours.clear();
    qualities.clear();
}

namespace {

// The vertices of a face in ascending order, found without branches, which could not be predicted.
std::array<VertexId, 3> face_key(const std::array<VertexId, 4>& v, unsigned face) {
    const VertexId a = v[face_vertices[face][0]], b = v[face_vertices[face][1]],
                   c = v[face_vertices[face][2]];
    const VertexId low = std::min(a, b), high = std::max(a, b), above = std::max(low, c);
    return {std::min(low, c), std::min(above, high), std::max(above, high)};
}

std::size_t hash(const std::array<VertexId, 3>& key) {
    std::uint64_t h = key[0] * 0x9e3779b97f4a7c15ULL;
    h = (h ^ key[1]) * 0xbf58476d1ce4e5b9ULL;
    h = (h ^ key[2]) * 0x94d049bb133111ebULL;
    return static_cast<std::size_t>(h >> 32U);
}

}  // namespace

bool Complex::link(Edit& edit) const {
    const std::size_t wanted = std::bit_ceil(8 * (edit.removed.size() + edit.added.size()) + 16);
    if (face_table_.size() < wanted) {
        face_table_.assign(wanted, FaceSlot{{none, none, none}, none, 0, false});
        face_stamp_ = 0;
    }
    ++face_stamp_;
    const std::size_t mask = face_table_.size() - 1;
    const auto find = [&](const std::array<VertexId, 3>& key) -> FaceSlot& {
        std::size_t at = hash(key) & mask;
        while (face_table_[at].stamp == face_stamp_ && face_table_[at].key != key)
            at = (at + 1) & mask;
        return face_table_[at];
    };
    walk_.places.clear();
    for (const TetId t : edit.removed) {
        prefetch_codes(t);
        walk_.places.insert(t);
        // For replace().
        for (const VertexId v : tets_[t].v) prefetch_star_entry(v);
    }
    std::size_t open = 0;
    for (const TetId t : edit.removed) {
        for (unsigned f = 0; f < 4; ++f) {
            const std::uint32_t code = neighbours_[t][f];
            if (code != none && walk_.places.contains(neighbour_tet(code))) continue;
            const auto key = face_key(tets_[t].v, f);
            FaceSlot& slot = find(key);
            if (slot.stamp == face_stamp_) return false;
            slot = {key, code, face_stamp_, false};
            ++open;
        }
    }
    edit.neighbours.assign(edit.added.size(), {none, none, none, none});
    for (std::size_t i = 0; i < edit.added.size(); ++i) {
        for (unsigned f = 0; f < 4; ++f) {
            const auto key = face_key(edit.added[i].v, f);
            const std::uint32_t self = Edit::virtual_code | static_cast<std::uint32_t>(4 * i + f);
            FaceSlot& slot = find(key);
            if (slot.stamp != face_stamp_) {
                slot = {key, self, face_stamp_, false};
                ++open;
                continue;
            }
            if (slot.used) return false;
            slot.used = true;
            --open;
            edit.neighbours[i][f] = slot.code;
            if (slot.code != none && (slot.code & Edit::virtual_code) != 0) {
                const std::uint32_t other = slot.code & ~Edit::virtual_code;
                edit.neighbours[other >> 2U][other & 3U] = self;
            }
        }
    }
    return open == 0;
}

}  // namespace dsc::mesh
