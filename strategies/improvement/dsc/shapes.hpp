#pragma once
// Repairs by the shape and size of single edges, faces and tets: those of the twelve thresholds of
// the thesis ([Saul2015], ch. 4) that the quality of tets does not cover. All of them are off by
// default.

#include <array>
#include <cstdint>
#include <vector>

#include <dsc/repair/contract.hpp>

namespace dsc::improvement {

/// A bound of 0 is off. Lengths are in target lengths L, areas in regular triangles of edge L,
/// volumes in regular tets of edge L. The quality of an edge is its length, that of a face 1 - max
/// |cos| over its corners: 0.5 for a regular triangle, 0 for a needle or cap.
struct ShapeLimits {
    double degenerate_edge_quality = 0.0;
    double min_edge_quality = 0.0;
    double degenerate_face_quality = 0.0;
    double min_face_quality = 0.0;
    double min_face_area = 0.0;
    double max_face_area = 0.0;
    double max_tet_volume = 0.0;

    bool any() const;
};

/// Accepted qualities of the new tets.
struct ShapeBounds {
    float degenerate = 0.0F;  ///< for repairs that may change the shape within the kernel's bounds
    float low = 0.0F;         ///< for repairs that must cost neither shape nor quality
};

/// Writes the requests of a round. It keeps only scratch memory: the result depends on the round
/// alone.
class ShapeProposals {
public:
    explicit ShapeProposals(const ShapeLimits& limits) : limits_(limits) {}
    void write(const repair::RepairRound& round, const ShapeBounds& bounds,
               std::vector<repair::Request>& out);

private:
    // In the order of the requests.
    enum class Kind : std::uint8_t {
        degenerate_edge,
        degenerate_face,
        low_edge,
        low_face,
        small_face,
        large_face,
        large_tet
    };
    struct Entry {
        Kind kind;
        std::int64_t key;                     // smallest first
        std::array<std::uint32_t, 3> births;  // ascending: an edge, a face, or a tet's longest edge
        mesh::TetId tet;
        std::array<mesh::VertexId, 2> edge;  // to collapse or split
        mesh::VertexId opposite;             // the blunt corner of a cap; none: not a cap
    };

    void note_edges(const repair::RepairRound& round, mesh::TetId t);
    void note_faces(const repair::RepairRound& round, mesh::TetId t);
    void note_tet(const repair::RepairRound& round, mesh::TetId t);
    static void request(const repair::RepairRound& round, const Entry& entry,
                        const ShapeBounds& bounds, std::vector<repair::Request>& out);

    ShapeLimits limits_;
    std::vector<Entry> entries_;
};

}  // namespace dsc::improvement
