#pragma once
// Where the micro benchmarks try their operations: near the interface, where the kernel works, in a
// random but fixed order.

#include <functional>
#include <span>
#include <vector>

#include <dsc/mesh/complex.hpp>
#include <dsc/repair/contract.hpp>

#include "snapshots.hpp"

namespace dsc::bench {

/// An edge (a, b) of a tet, or a face of it, and the length of the ring round the edge.
struct Place {
    mesh::TetId tet = mesh::none;
    mesh::VertexId a = mesh::none, b = mesh::none;
    unsigned face = 0;
    std::size_t ring = 0;
    bool on_interface = false;  ///< two labels meet in it
};

/// At most this many places a benchmark.
inline constexpr std::size_t most_places = 3000;

/// Tets of the stars of the movable interface vertices, shuffled. [setup]
std::vector<mesh::TetId> band(const mesh::Complex& complex);
/// Movable interface vertices in birth order, the order in which a step moves them. [setup]
std::vector<mesh::VertexId> movable_vertices(const mesh::Complex& complex);
/// Vertices of the band that are neither on the interface nor on the box, shuffled. [setup]
std::vector<mesh::VertexId> free_vertices(const mesh::Complex& complex);

/// Edges of the band that `wanted` likes and that are not on the box. An operation at one leaves
/// the tets round the others as they are; the tets of their ends' stars, too, where `stars` says
/// so. [setup]
std::vector<Place> edges(const mesh::Complex& complex, bool stars,
                         const std::function<bool(const Place&)>& wanted);
/// Faces inside one label, no two of the same tet. [setup]
std::vector<Place> faces(const mesh::Complex& complex);

/// A request at a place as a repair would make it; `accept_above` as repair::Request has it.
repair::Request request_at(const mesh::Complex& complex, repair::Operation operation,
                           const Place& place, float accept_above);

}  // namespace dsc::bench
