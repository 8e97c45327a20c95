#pragma once
// The closed vocabulary between whoever decides which repairs to try and the kernel that carries them out.

#include <array>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include <dsc/mesh/complex.hpp>

namespace dsc::mesh {

/// What can be asked for. Every operation is evaluated at its turn and committed only if all invariants hold.
enum class Operation : std::uint8_t {
    smooth_laplacian,  ///< vertex to the mean of its neighbours; not for interface or box vertices
    smooth_optimise,   ///< vertex uphill on the worst quality of its star
    edge_removal,      ///< re-triangulate the ring of one of the tet's edges (2-3, 3-2, 4-4 and up to rings of 7)
    interface_flip,    ///< other diagonal of two interface faces, both labels' fans re-triangulated
    face_removal,      ///< multi-face removal, the inverse of edge removal, from any of the tet's faces or face (a, b, c)
    edge_split,        ///< split of the tet's longest edge, or of edge (a, b), at parameter t
    face_split,        ///< split of face (a, b, c) at a point: the projection of the tet's fourth vertex
    vertex_split,      ///< split of a vertex with too many tets
    edge_collapse,     ///< collapse of the tet's edges, shortest first, or of edge (a, b)
    relabel,           ///< the tet takes the label around it (interface shift)
    compound,          ///< split an edge or face and collapse the new vertex, as one transaction. One vertex named: it moves into
                       ///< the edge or face next to it; edge (a, b) named: it and the tet's opposite edge get a common vertex,
                       ///< whose destination follows those of a and b
};
inline constexpr std::size_t operation_count = 11;
/// "edge_collapse", ...
std::string_view name(Operation operation);

/// How an edge collapse may treat the interface.
enum class CollapseMode : std::uint8_t {
    safe,      ///< quality must not fall below the requested bound, interface only where it is flat
    bounded,   ///< interface within the edit bounds, any quality above the floor
};

/// One request. A request names a tet and lets the kernel choose the simplex of it, or names the simplex too. It is
/// skipped when the tet's slot holds another tet by then.
struct Request {
    Operation operation = Operation::smooth_laplacian;
    CollapseMode mode = CollapseMode::safe;
    std::uint8_t repair_class = 0;            ///< index into what hooks::Improvement::repair_classes() names; counted
    TetId tet = none;
    std::uint32_t birth_date = 0;             ///< of the tet when the request was made; ignored without a tet
    std::array<VertexId, 3> vertices = {none, none, none};  ///< vertex, edge or face; none: the kernel chooses
    float parameter = 0.5F;                   ///< place of a split along (a, b)
    float only_below = 2.0F;                  ///< skip when the tet's quality is not below this by then
    float accept_above = 2.0F;                ///< accept when the new least quality is above this, or above the old one
    float gain = 1.0F;                        ///< of a compound: above so many times the old one
    float least_edge = 0.0F;                  ///< of a compound: its vertex gets no shorter edge; normalised units
};
/// How many classes of requests can be told apart.
inline constexpr std::size_t repair_class_limit = 16;

/// What became of a request: `committed`, or why it did not change anything.
enum class Refusal : std::uint8_t { committed, stale, irregular, quality, bound, box, not_applicable, no_gain };
inline constexpr std::size_t refusal_count = 8;
std::string_view name(Refusal refusal);

/// What became of a request.
struct Outcome {
    std::uint32_t request = 0;  ///< index into the round's requests
    Refusal refusal = Refusal::committed;
};

/// Creases of the interface that edits shall leave, judged on the geometry as it is.
struct CreaseRule {
    double dihedral = 0.6;  ///< radians between the normals of an edge's two faces above which the edge is a crease
    double turn = 0.7954;   ///< radians by which an edit may turn a face, acos 0.7
};

/// What a repair round knows. Spans live as long as the call.
struct RepairRound {
    const Complex& complex;
    std::span<const TetId> dirty;          ///< live tets changed since the last round and tets whose failure is out of date,
                                           ///< ordered by (quality, birth ids)
    std::span<const VertexId> blocked;     ///< interface vertices that could not reach their destination
    std::span<const Request> last_requests;
    std::span<const Outcome> last_outcomes;
    double target_length;                  ///< L: mean interface edge at adopt or after the last refinement
    double flatness;                       ///< cosine above which two interface faces count as flat
    unsigned round;                        ///< 0 in the first round of a step
    bool settled;                          ///< no motion is left: the last round of the step
    bool size_edits = true;                ///< false: a refinement owns the sizing, and nothing is split or collapsed for its size
    std::span<const double> lengths = {};  ///< target length per vertex, NaN where there is none; empty where it is L everywhere

    /// The target length at a vertex: L where it has none of its own. [parallel]
    double length_at(VertexId v) const { return v < lengths.size() && lengths[v] > 0.0 ? lengths[v] : target_length; }
    /// The same for an edge. [parallel]
    double length_at(VertexId a, VertexId b) const {
        return lengths.empty() ? target_length : 0.5 * (length_at(a) + length_at(b));
    }
    /// The same for a tet: of its vertices that have one. [parallel]
    double length_of(TetId t) const;
};

/// Limits of topology changes that the kernel needs before it looks for candidates.
struct TopologyLimits {
    double thickness = 1.0;      ///< in target lengths; 0 switches topology changes off
    double min_component = 2.0;  ///< in regular tets of edge L; smaller components vanish; 0: none does
    bool open = true, merge = true, cut = true;  ///< kinds worth looking for
};

/// A topology change that the kernel found possible.
struct TopologyCandidate {
    /// open: a sheet of a label above 0 pierced; merge: a gap of label 0 bridged; cut: a neck cut; shift: the rim of a
    /// sheet of a label above 0 drawn back, which changes no topology but lets the hole of a pierced web grow.
    enum class Kind : std::uint8_t { open, merge, cut, shift };
    Kind kind = Kind::open;
    Label label = 0;         ///< of the tets that would be relabelled
    Vec3 centroid = Vec3::Zero();
    double thickness = 0.0;  ///< in target lengths
    double volume = 0.0;     ///< in regular tets of edge L
};

/// Counters of topology changes.
struct EventCounts {
    std::uint64_t merge = 0, split = 0, handle_opened = 0, handle_closed = 0, vanished = 0, born = 0, unpinched = 0;
};

}  // namespace dsc::mesh
