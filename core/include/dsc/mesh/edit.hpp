#pragma once
// A local change of a complex: the tets of a cavity and those that take their place. Also the tets
// round an edge, which most of these changes begin with.

#include <array>
#include <cstdint>
#include <vector>

#include <dsc/geometry/vec.hpp>
#include <dsc/mesh/tet.hpp>

namespace dsc::mesh {

/// The tets round an edge ab in rotation order. tets[i] has the vertices a, b, link[i], link[i+1],
/// and orient3d(a, b, link[i], link[i+1]) == 1. A closed ring has as many link entries as tets
/// (indices wrap); an open ring (an edge on the box) has one more.
struct EdgeRing {
    std::vector<TetId> tets;
    std::vector<VertexId> link;
    bool closed = false;
};

/// A tet that an Edit adds; vertices in positive order, `created_vertex` allowed.
struct NewTet {
    std::array<VertexId, 4> v;
    Label label;
};

/// A cavity and the tets that fill it (method.md, section 4.1); every local operation is one edit.
/// Reuse one object: nothing is allocated after its arrays have grown.
struct Edit {
    std::vector<TetId> removed;
    std::vector<NewTet> added;
    VertexId moved = none;  ///< an existing vertex whose position changes with the edit; all its
                            ///< tets must be removed
    Vec3 moved_to = Vec3::Zero();
    bool creates = false;  ///< the edit makes one vertex
    Vec3 created_at = Vec3::Zero();
    VertexId deleted = none;  ///< a vertex that no added tet uses; all its tets must be removed

    // Filled by Complex::link(): neighbours of the added tets. An entry is a code 4*tet+face
    // outside the cavity, none, or virtual_code + 4*i+face for added tet i.
    std::vector<std::array<std::uint32_t, 4>> neighbours;
    // Filled by the caller's evaluation. If it is empty, replace() computes them.
    std::vector<float> qualities;

    static constexpr std::uint32_t virtual_code = 0x80000000U;
    void clear();
};

}  // namespace dsc::mesh
