#pragma once
// Chooses the edges of the interface to split, collapse or flip, and the vertices to move.

#include <array>
#include <cstdint>
#include <vector>

#include <dsc/hooks/refinement_policy.hpp>

#include "edge_mesh.hpp"

namespace dsc::remesh {

/// Edges longer than the first fraction of the target length are split, edges shorter than the
/// second are collapsed [Botsch2004].
inline constexpr double split_above = 4.0 / 3.0;
inline constexpr double collapse_below = 4.0 / 5.0;
/// Least cosine between the normals of a face before and after a collapse.
inline constexpr double turn_cosine = 0.7;

/// Chooses the edits of a pass. An edit that changes the same faces as an earlier one, of the same
/// function or the one before, waits for the next pass. Requests that the kernel refused are
/// repeated only a few times. All orders are total, so that the same surface gives the same edits.
class Edits {
public:
    /// Forgets the requests made so far. To be called before the first pass of a refinement.
    void start_refinement();
    /// Forgets the choices of the last pass.
    void start_pass(const EdgeMesh& mesh);

    /// Edges above 4/3 of their target length, the longest first.
    void split(const EdgeMesh& mesh, const Lengths& lengths,
               std::vector<std::array<std::uint32_t, 2>>& out);

    /// Edges below 4/5 of their target length, the shortest first, no two next to each other. The
    /// vertex that stays is the one on a crease if only one is; otherwise it moves to the midpoint,
    /// in a second attempt to one end and in a third to the other. With `keep_creases` a crease
    /// becomes shorter only along itself, and its ends and corners stay.
    void collapse(const EdgeMesh& mesh, const Lengths& lengths, bool keep_creases,
                  std::vector<hooks::CollapseRequest>& out);

    /// Edges whose opposite angles sum up to more than pi, the worst first, no two of them at one
    /// face. Edges whose faces have a smaller cosine than `flatness` between their normals are not
    /// flipped.
    void flip(const EdgeMesh& mesh, double flatness, std::vector<hooks::FlipRequest>& out);

    /// Moves half the way to the centroid of the faces around each vertex, within its tangent
    /// plane. Vertices at creases stay, and so do vertices that would move less than `least_move`
    /// of the target length.
    void move(const EdgeMesh& mesh, const Lengths& lengths, std::vector<hooks::MoveRequest>& out);

private:
    struct Candidate {
        double key;
        std::uint32_t edge;
        bool operator<(const Candidate& other) const {
            return key != other.key ? key < other.key : edge < other.edge;
        }
    };
    /// An edge, by the birth ids of its ends, and the number of attempts at it in this refinement.
    struct Tried {
        std::uint64_t births;
        unsigned attempts;
        bool operator<(const Tried& other) const { return births < other.births; }
    };
    static std::uint64_t births_of(const EdgeMesh& mesh, std::uint32_t edge);
    static unsigned attempts_at(const std::vector<Tried>& tried, std::uint64_t births);
    void note_asked(std::vector<Tried>& tried) const;
    bool place_of(const EdgeMesh& mesh, std::size_t edge, unsigned attempt, bool keep_creases,
                  hooks::CollapseRequest& request) const;
    bool fits(const EdgeMesh& mesh, const Lengths& lengths, const hooks::CollapseRequest& request);
    bool turns(const EdgeMesh& mesh, std::uint32_t vertex, std::uint32_t other,
               const Vec3& place) const;
    bool may_flip(const EdgeMesh& mesh, std::uint32_t edge);
    void block_ring(const EdgeMesh& mesh, std::uint32_t vertex);
    void ring_of(const EdgeMesh& mesh, std::uint32_t vertex, std::vector<std::uint32_t>& out) const;

    // Kept between calls to reuse their memory.
    std::vector<Candidate> candidates_;
    std::vector<std::uint8_t> blocked_;  // per vertex: on the ring of an edit
    std::vector<std::uint8_t> used_;     // per face: an edit changes it
    std::vector<Tried> tried_collapses_, tried_flips_;
    std::vector<Tried> asked_;  // requests of this call
    std::vector<std::uint32_t> near_a_, near_b_;
};

}  // namespace dsc::remesh
