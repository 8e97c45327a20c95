#pragma once
// A tet: its vertices, what is stored of it, and its neighbours (method.md, section 1).

#include <array>
#include <bit>
#include <cstdint>

#include <dsc/mesh/tet_mesh.hpp>

namespace dsc::mesh {

using VertexId = std::uint32_t;
using TetId = std::uint32_t;

/// No vertex, no tet, no neighbour (a face on the box).
inline constexpr std::uint32_t none = 0xffffffffU;
/// Id of the vertex that an Edit creates, before the vertex exists.
inline constexpr VertexId created_vertex = 0xfffffffeU;

/// Local vertex indices of face i, counter-clockwise seen from outside a positive tet.
inline constexpr std::array<std::array<std::uint8_t, 3>, 4> face_vertices = {
    {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}}};
/// Local vertex indices of the six edges.
inline constexpr std::array<std::array<std::uint8_t, 2>, 6> edge_vertices = {
    {{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}}};

/// The vertices of a tet.
using TetCorners = std::array<VertexId, 4>;

/// What is stored of a tet, without its neighbours. 32 bytes, so that it lies in one line of the
/// caches: what reads a part of it nearly always reads others.
struct alignas(32) Tet {
    TetCorners v;
    float quality = 0.0F;
    std::uint32_t date = 0;
    std::uint32_t birth_date = 0;
    Label label = 0;
};
static_assert(sizeof(Tet) == 32);

/// For each face of a tet, 4 * neighbour + its face index there, or none.
using TetNeighbours = std::array<std::uint32_t, 4>;

inline TetId neighbour_tet(std::uint32_t code) { return code >> 2U; }
inline unsigned neighbour_face(std::uint32_t code) { return code & 3U; }

/// Local index of v in the tet; 4 if the tet does not contain v.
inline unsigned index_of(const Tet& tet, VertexId v) {
    // Without branches, because the processor cannot guess where v is.
    const auto bit = [&](unsigned i) { return static_cast<unsigned>(tet.v[i] == v) << i; };
    return static_cast<unsigned>(std::countr_zero(bit(0) | bit(1) | bit(2) | bit(3) | 16U));
}
inline bool has_vertex(const Tet& tet, VertexId v) { return index_of(tet, v) < 4; }

}  // namespace dsc::mesh
