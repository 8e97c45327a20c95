#pragma once
// Where an operation is built, tested and committed (method.md, section 4.1). Every operation fills
// `edit`, calls the checks below and commits. Until then the complex is unchanged, so a refusal
// costs nothing.

#include <algorithm>
#include <optional>
#include <span>
#include <vector>

#include <dsc/base/prefetch.hpp>
#include <dsc/mesh/complex.hpp>
#include <dsc/mesh/local_star.hpp>
#include <dsc/repair/contract.hpp>

#include "kernel/scratch.hpp"

namespace dsc::kernel {

using mesh::TetId;
using mesh::VertexId;
using repair::Outcome;
using repair::Refusal;
using repair::success;

/// Absolute limits of one edit, in normalised units, where the target length is L (method.md,
/// section 3).
struct Limits {
    double length = 0.0;  ///< L
    double quality_floor = 1e-3;
    double edit_distance = 0.0;  ///< largest distance by which one edit may move the interface
    double edit_volume = 0.0;    ///< largest volume by which one edit may change a phase
    double flatness = repair::default_flatness;  ///< cosine
    double crease = -2.0;  ///< an edge with a smaller cosine between its two faces is a crease and
                           ///< must stay; -2: no creases
    double turn = -2.0;    ///< least cosine between a face's normals before and after an edit
    double crease_floor = 0.0;  ///< the rule for creases does not apply to a cavity with a tet
                                ///< below this quality
    bool keeps_creases() const { return crease > -2.0; }
    /// No move takes a tet below the floor. A tet close to the floor cannot be moved any more, so
    /// it counts as degenerate before it reaches the floor.
    void set_floor(double floor) {
        quality_floor = floor;
        crease_floor = 1.5 * floor;
    }
};

/// Largest change of the interface by one edit, at a place.
struct EditBounds {
    double distance = 0.0;  ///< by which the interface may move
    double volume = 0.0;    ///< by which a phase may change
};

/// By how much a commit changes the interface.
struct InterfaceChange {
    double distance = 0.0;  ///< by which the interface moves
    double volume = 0.0;    ///< by which a phase changes
    bool exceeds(const EditBounds& bounds) const {
        return distance > bounds.distance || volume > bounds.volume;
    }
};

/// Tets that take another label.
struct Relabelling {
    std::span<const TetId> tets;
    mesh::Label label = 0;
    double volume = 0.0;  ///< of the tets
};

/// Receives the vertices that edits create and remove, so that destinations can follow.
class EditListener {
public:
    EditListener() = default;
    EditListener(const EditListener&) = delete;
    EditListener& operator=(const EditListener&) = delete;
    virtual ~EditListener() = default;
    /// `vertex` was made at (1 - s) a + s b.
    virtual void on_split(VertexId vertex, VertexId a, VertexId b, double s) = 0;
    /// `removed` was merged into `kept`, which now lies at (1 - s) kept + s removed.
    virtual void on_collapse(VertexId kept, VertexId removed, double s) = 0;
    /// A collapse changed the interface within these vertices' stars: a component may have become
    /// small.
    virtual void on_interface_collapse(VertexId kept) = 0;
};

/// Sums over everything that was committed.
struct EditSums {
    double distance = 0.0;    ///< of the changes of the interface
    double volume = 0.0;      ///< of the changes of the interface
    double relabelled = 0.0;  ///< volume of the relabelled tets
};

class Workbench {
public:
    /// The kinds of smoothing for which refusals are remembered.
    enum class Smoother : std::uint8_t { laplacian, optimise };

    explicit Workbench(mesh::Complex& target) : complex(target), star_(target) {}

    mesh::Complex& complex;
    Limits limits;
    const std::vector<double>* lengths = nullptr;  ///< target length per vertex, NaN for none; null
                                                   ///< if it is L everywhere
    mesh::Edit edit;
    EditListener* listener = nullptr;
    EditSums sums;
    std::uint64_t crease_exceptions = 0;  ///< edits that ignored the rule for creases

    // The arrays of the operations (scratch.hpp).
    Scratch<EdgeScratch> edge;
    Scratch<CollapseScratch> collapse;
    Scratch<SmoothScratch> smooth;
    Scratch<VertexSplitScratch> vertex_split;
    Scratch<CompoundScratch> compound;
    Scratch<MoveScratch> move;
    Scratch<RelabelScratch> relabel;
    Scratch<RegionScratch> region;
    Scratch<CreaseScratch> creases;

    /// Position after the edit's changes.
    const Vec3& at(VertexId v) const {
        if (v == mesh::created_vertex) return edit.created_at;
        return v == edit.moved ? edit.moved_to : complex.position(v);
    }
    double quality(VertexId a, VertexId b, VertexId c, VertexId d) const;

    /// The target length at these vertices: the mean of those that have one; L if none has one.
    /// [parallel]
    double length_at(std::span<const VertexId> vertices) const;
    double length_at(VertexId v) const { return length_at(std::span(&v, 1)); }
    double length_at(VertexId a, VertexId b) const {
        return length_at(std::array<VertexId, 2>{a, b});
    }
    /// The bounds of an edit at these vertices.
    EditBounds bounds_at(std::span<const VertexId> vertices) const;
    EditBounds bounds_at(VertexId a, VertexId b) const {
        return bounds_at(std::array<VertexId, 2>{a, b});
    }

    /// Least cached quality of the edit's removed tets; 1 if there is none.
    float old_quality() const;
    /// Writes the qualities of the added tets to edit.qualities. Refuses if one is not above
    /// `must_exceed`, below min(floor, old), or not exactly positive.
    Outcome check_shape(float must_exceed, float old);
    /// Call after link(): tests that every given vertex stays regular and that the sum of their
    /// Euler shares does not change.
    Outcome check_topology(std::span<const VertexId> touched);
    /// Volume that changes phase: half the sum over labels of |added - removed|.
    double phase_change() const;

    // Operations replace and relabel tets only by these two functions, which also count the change
    // in the sums. (The repair of irregular vertices after a relabelling is mesh::unpinch().)
    /// Commits the linked edit. Returns the vertex that it creates, or none.
    VertexId commit(const InterfaceChange& change = {});
    /// Gives the tets their new label.
    void commit(const Relabelling& relabelling, const InterfaceChange& change = {});

    /// Interface vertices that both stars contain, by id.
    void shared_interface_vertices(std::span<const TetId> star_a, std::span<const TetId> star_b,
                                   std::vector<VertexId>& out);
    /// Interface vertices of the edit's removed tets, by id, and then the vertex that the edit
    /// creates.
    void cavity_interface_vertices(std::vector<VertexId>& out) const;

    /// A refused smoothing would be refused again as long as nothing in the vertex' star has
    /// changed: the reason of that refusal, or nothing if an attempt is useful. `smoother`
    /// distinguishes the kinds of smoothing of one vertex.
    std::optional<Refusal> known_refusal(VertexId v, Smoother smoother, float accept_above) const;
    Refusal remember(VertexId v, Smoother smoother, float accept_above, Refusal refusal) {
        return remember(v, smoother, accept_above, refusal, complex.clock());
    }
    /// [parallel] for different vertices, after provide_memory().
    Refusal remember(VertexId v, Smoother smoother, float accept_above, Refusal refusal,
                     std::uint32_t date);
    /// Makes room for the refusals of all vertices. [step]
    void provide_memory() {
        if (memory_.size() < complex.vertex_slots()) memory_.resize(complex.vertex_slots());
    }
    /// Asks the memory for what known_refusal() will read; v must be in the room. [parallel]
    void prefetch_memory(VertexId v) const { prefetch_line(&memory_[v]); }
    /// Forgets all refusals; also necessary if the limits have changed.
    void forget_refusals() { memory_.clear(); }
    /// Forgets all that depends on dates.
    void forget_dates() {
        forget_refusals();
        flat_memory_.clear();
    }

    /// Whether the interface faces round v are flat to each other (signed normals). Recent answers
    /// are remembered until the star of v changes.
    bool flat(VertexId v);
    /// Vertices of the star's interface faces as triangles with v first, counter-clockwise from the
    /// smaller label.
    void interface_fan(VertexId v, std::span<const TetId> star,
                       std::vector<std::array<VertexId, 3>>& out) const;

    mesh::LocalStar& local_star() { return star_; }

private:
    mesh::LocalStar star_;
    std::uint32_t new_vertex_epoch();

    bool find_flat(VertexId v);

    mesh::StarWalk flat_walk_;
    std::vector<std::array<VertexId, 3>> fan_;
    std::vector<Vec3> normals_;

    // The last answers of flat(), one per group of vertices with the same remainder, and the date
    // of the vertex at that time. As with refusals, a new vertex in the same slot has a later date.
    struct Flatness {
        VertexId vertex = mesh::none;
        std::uint32_t date = 0;
        bool flat = false;
    };
    static constexpr std::size_t flat_answers = 4096;
    std::vector<Flatness> flat_memory_;
    double flat_limit_ = 0.0;  // the flatness for which they hold

    // The last outcome at a vertex for each kind of smoothing, and the time of the change clock
    // then. The slot of a deleted vertex can receive a new vertex. The star of the new vertex has a
    // later date, so the old outcome does not count for it.
    struct Memory {
        std::array<std::uint32_t, 2> date = {0, 0};
        float accept_above = 0.0F;  // of the Laplacian; the other kind has no bound
        std::array<Outcome, 2> last = {};
    };
    std::vector<Memory> memory_;  // per vertex
    std::vector<std::uint32_t> vertex_marks_;
    std::uint32_t vertex_epoch_ = 0;
};

}  // namespace dsc::kernel
