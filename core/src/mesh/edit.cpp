// Linking a cavity: finds the neighbours of the added tets, among each other and across the
// boundary of the cavity (method.md, section 4.1).
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

// The three vertices of a face, in any order: two keys are equal if they have the same vertices.
using FaceKey = std::array<VertexId, 3>;

// Whether two faces have the same vertices, without branches, which could not be predicted.
bool same(const FaceKey& x, const FaceKey& y) {
    const auto contains = [&y](VertexId v) {
        return static_cast<unsigned>(v == y[0]) | static_cast<unsigned>(v == y[1]) |
               static_cast<unsigned>(v == y[2]);
    };
    return (contains(x[0]) & contains(x[1]) & contains(x[2])) != 0;
}

// The faces of a tet with their hashes: sums over the vertices, so the order does not matter.
class Faces {
public:
    explicit Faces(const TetCorners& v) : v_(v) {
        for (unsigned i = 0; i < 4; ++i) {
            const std::uint64_t h = v[i] * 0x9e3779b97f4a7c15ULL;
            hashes_[i] = (h ^ h >> 32U) * 0xbf58476d1ce4e5b9ULL;
        }
        sum_ = hashes_[0] + hashes_[1] + hashes_[2] + hashes_[3];
    }
    FaceKey key(unsigned face) const {
        const auto& f = face_vertices[face];
        return {v_[f[0]], v_[f[1]], v_[f[2]]};
    }
    std::size_t hash(unsigned face) const {
        return static_cast<std::size_t>((sum_ - hashes_[face]) >> 32U);
    }

private:
    const TetCorners& v_;
    std::array<std::uint64_t, 4> hashes_;
    std::uint64_t sum_;
};

}  // namespace

bool Complex::link(Edit& edit) const {
    const std::size_t wanted = std::bit_ceil(8 * (edit.removed.size() + edit.added.size()) + 16);
    if (face_table_.size() < wanted) {
        face_table_.assign(wanted, FaceSlot{{none, none, none}, none, 0, false});
        face_stamp_ = 0;
    }
    ++face_stamp_;
    const std::size_t mask = face_table_.size() - 1;
    const auto find = [&](const FaceKey& key, std::size_t hash) -> FaceSlot& {
        std::size_t at = hash & mask;
        while (face_table_[at].stamp == face_stamp_ && !same(face_table_[at].key, key))
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
        const Faces faces(tets_[t].v);
        for (unsigned f = 0; f < 4; ++f) {
            const std::uint32_t code = neighbours_[t][f];
            if (code != none && walk_.places.contains(neighbour_tet(code))) continue;
            const FaceKey key = faces.key(f);
            FaceSlot& slot = find(key, faces.hash(f));
            if (slot.stamp == face_stamp_) return false;
            slot = {key, code, face_stamp_, false};
            ++open;
        }
    }
    edit.neighbours.assign(edit.added.size(), {none, none, none, none});
    for (std::size_t i = 0; i < edit.added.size(); ++i) {
        const Faces faces(edit.added[i].v);
        for (unsigned f = 0; f < 4; ++f) {
            const FaceKey key = faces.key(f);
            const std::uint32_t self = Edit::virtual_code | static_cast<std::uint32_t>(4 * i + f);
            FaceSlot& slot = find(key, faces.hash(f));
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
