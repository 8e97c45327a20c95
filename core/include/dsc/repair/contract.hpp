#pragma once
// The requests and answers between the improvement, which chooses repairs, and the kernel, which
// executes them (method.md, sections 4, 6 and 8).

#include <array>
#include <cstdint>
#include <span>
#include <string_view>

#include <dsc/mesh/complex.hpp>

namespace dsc::repair {

/// The operations that can be requested. Each is evaluated at its turn and committed only if all
/// invariants hold.
enum class Operation : std::uint8_t {
    smooth_laplacian,  ///< moves a vertex to the mean of its neighbours; not for interface or box
                       ///< vertices
    smooth_optimise,   ///< moves a vertex along the gradient of the worst quality of its star
    edge_removal,    ///< re-triangulate the ring of one of the tet's edges (2-3, 3-2, 4-4 and up to
                     ///< rings of 7)
    interface_flip,  ///< other diagonal of two interface faces; the tets of both labels at the edge
                     ///< are re-triangulated
    face_removal,  ///< multi-face removal, the inverse of edge removal, from any of the tet's faces
                   ///< or face (a, b, c)
    edge_split,    ///< split of the tet's longest edge, or of edge (a, b), at parameter t
    face_split,  ///< split of face (a, b, c) at a point: the projection of the tet's fourth vertex
    vertex_split,   ///< split of a vertex with too many tets
    edge_collapse,  ///< collapse of the tet's edges, shortest first, or of edge (a, b)
    relabel,        ///< the tet takes the label around it (the interface shifts)
    compound,  ///< splits an edge or face and collapses the new vertex, in one transaction. With
               ///< one vertex named, it moves into the edge or face next to it. With edge (a, b)
               ///< named, it and the tet's opposite edge get a common vertex, whose destination
               ///< follows the destinations of a and b
};
inline constexpr std::size_t operation_count = 11;
/// "edge_collapse", ...
std::string_view name(Operation operation);

/// How an edge collapse may treat the interface.
enum class CollapseMode : std::uint8_t {
    safe,  ///< quality must not fall below the requested bound; the interface only where it is flat
    bounded,  ///< the interface within the edit bounds; any quality above the floor
};

/// One request. It names a tet and the kernel chooses the simplex, or it names the simplex too. The
/// kernel skips it if the tet's slot contains another tet at its turn.
struct Request {
    Operation operation = Operation::smooth_laplacian;
    CollapseMode mode = CollapseMode::safe;
    std::uint8_t repair_class = 0;  ///< index into the names of
                                    ///< hooks::Improvement::repair_classes(), for counting
    mesh::TetId tet = mesh::none;
    std::uint32_t birth_date = 0;  ///< birth date of the tet when the request was made; ignored
                                   ///< without a tet
    /// Vertex, edge or face; none: the kernel chooses.
    std::array<mesh::VertexId, 3> vertices = {mesh::none, mesh::none, mesh::none};
    float parameter = 0.5F;     ///< place of a split along (a, b)
    float only_below = 2.0F;    ///< skip if the tet's quality is not below this at its turn
    float accept_above = 2.0F;  ///< accept if the new least quality is above this, or above the old
                                ///< one
    float gain = 1.0F;          ///< of a compound: factor by which the least quality must grow
    float least_edge = 0.0F;    ///< of a compound: least length of the edges of its vertex;
                                ///< normalised units
};
/// A request that names only the tet.
Request on_tet(const mesh::Complex& complex, mesh::TetId tet, Operation operation);
/// The largest number of classes of requests.
inline constexpr std::size_t repair_class_limit = 16;

/// The reason why a request is refused (method.md, section 4.1). The value 0 belongs to no reason.
enum class Refusal : std::uint8_t {
    stale = 1,
    irregular,
    quality,
    bound,
    box,
    not_applicable,
    no_gain
};
/// The size of a table by reason; its entry 0 is not used.
inline constexpr std::size_t refusal_count = 8;
std::string_view name(Refusal refusal);

/// The outcome of a request or of one of its tests: success, or the reason for the refusal.
class [[nodiscard]] Outcome {
public:
    constexpr Outcome() = default;  ///< success
    constexpr Outcome(Refusal reason) : reason_(reason) {}
    constexpr bool refused() const { return reason_ != Refusal{}; }
    /// The value 0 if nothing was refused.
    constexpr Refusal reason() const { return reason_; }
    friend constexpr bool operator==(Outcome, Outcome) = default;

private:
    Refusal reason_{};
};
inline constexpr Outcome success{};

/// The rule for creases, which edits must keep (method.md, section 4.10). It is tested on the
/// present geometry.
struct CreaseRule {
    double dihedral = 0.6;  ///< an edge with more radians than this between the normals of its two
                            ///< faces is a crease
    double turn = 0.7954;   ///< largest angle in radians by which an edit may turn a face: acos 0.7
};

/// Cosine between the normals of two interface faces above which they count as flat, unless a
/// strategy or the caller sets another value.
inline constexpr double default_flatness = 0.995;

/// What a repair round offers (method.md, section 6.2). Spans are valid during the call.
struct RepairRound {
    const mesh::Complex& complex;
    /// Live tets that changed since the last round, in the order of the changes; then tets with a
    /// refused request near which something has changed since.
    std::span<const mesh::TetId> dirty;
    std::span<const mesh::VertexId> blocked;  ///< interface vertices that could not reach their
                                              ///< destination
    std::span<const Request> last_requests;
    std::span<const Outcome> last_outcomes;  ///< one per entry of last_requests
    double target_length;  ///< L: mean interface edge at adoption, or the value of the last
                           ///< refinement
    double flatness;       ///< cosine between normals above which two interface faces count as flat
    unsigned round;        ///< 0 in the first round of a step
    bool settled;          ///< no motion is left: the last round of the step
    bool size_edits = true;  ///< false: a refinement owns the sizing; no splits or collapses for
                             ///< size
    std::span<const double> lengths = {};  ///< target length per vertex, NaN if a vertex has none;
                                           ///< empty if it is L everywhere

    /// The target length at a vertex: L if it has no own length. [parallel]
    double length_at(mesh::VertexId v) const {
        return v < lengths.size() && lengths[v] > 0.0 ? lengths[v] : target_length;
    }
    /// The target length of an edge. [parallel]
    double length_at(mesh::VertexId a, mesh::VertexId b) const {
        return lengths.empty() ? target_length : 0.5 * (length_at(a) + length_at(b));
    }
    /// The target length of a tet: from its vertices that have one. [parallel]
    double length_of(mesh::TetId t) const;
};

/// Limits of topology changes that the kernel needs before it searches for candidates.
struct TopologyLimits {
    double thickness = 1.0;      ///< in target lengths; 0 switches topology changes off
    double min_component = 2.0;  ///< in regular tets of edge L; smaller components vanish; 0: no
                                 ///< component vanishes
    bool open = true, merge = true, cut = true;  ///< kinds to search for
};

/// A topology change that the kernel found possible (method.md, section 8.3).
struct TopologyCandidate {
    /// open: pierces a sheet of a label above 0. merge: bridges a gap of label 0. cut: cuts a neck.
    /// shift: moves back the rim of a sheet of a label above 0; this changes no topology, but the
    /// hole of a pierced sheet can grow.
    enum class Kind : std::uint8_t { open, merge, cut, shift };
    Kind kind = Kind::open;
    mesh::Label label = 0;  ///< of the tets that would be relabelled
    Vec3 centroid = Vec3::Zero();
    double thickness = 0.0;  ///< in target lengths
    double volume = 0.0;     ///< in regular tets of edge L
};

}  // namespace dsc::repair
