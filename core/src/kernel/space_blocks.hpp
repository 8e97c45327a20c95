#pragma once
// Splits space into blocks, each of which owns its vertices (method.md, section 10.1).

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <dsc/base/workers.hpp>
#include <dsc/mesh/complex.hpp>

namespace dsc::kernel {

/// Planes cut space into blocks. They depend only on the complex and on the vertices that are given
/// to split(), never on the number of threads.
class SpaceBlocks {
public:
    static constexpr unsigned most_levels = 4;  // of planes: 16 blocks

    explicit SpaceBlocks(const mesh::Complex& complex) : complex_(complex) {}

    /// Makes 2^levels blocks with about the same number of these vertices, which it sorts, and
    /// gives all vertices to them. Another `wave` has planes in other directions, so that what lay
    /// at the border of two blocks lies inside of one. `workers`: null for one thread. [step]
    void split(std::span<mesh::VertexId> vertices, unsigned levels, unsigned wave,
               Workers* workers);
    /// Gives a free slot to a block. [step]
    void give(mesh::VertexId slot, unsigned block);

    unsigned count() const { return count_; }
    /// The block that owns v. It stays the same until the next split(). [parallel]
    unsigned block_of(mesh::VertexId v) const { return blocks_[v]; }
    /// Whether the block owns v and all its neighbours. The answer stays the same as long as blocks
    /// change only tets whose four vertices are their own. `star` and `walk` are scratch.
    /// [parallel] if each block asks for itself.
    bool inner(mesh::VertexId v, unsigned block, std::vector<mesh::TetId>& star,
               mesh::TetIndex& walk);

private:
    enum class Answer : std::uint8_t { unknown, inner, border };

    struct Plane {
        Vec3 direction = Vec3::Zero();
        double offset = 0.0;
        double height(const Vec3& p) const { return direction.dot(p); }
    };
    void split_node(unsigned node, std::span<mesh::VertexId> vertices, unsigned wave);
    unsigned block_at(const Vec3& place) const;

    const mesh::Complex& complex_;
    unsigned count_ = 1;
    std::array<Plane, 1U << most_levels> planes_;  // a heap; the children of node i are 2 i, 2 i +
                                                   // 1
    std::vector<std::uint8_t> blocks_;             // per vertex
    std::vector<Answer> inner_;                    // per vertex: the answer of its block
};

}  // namespace dsc::kernel
