#pragma once
// Where an operation is built, tested and committed (method.md, section 4.1). Every operation fills
// `edit`, calls the checks below and commits. Until then the complex is unchanged, so a refusal
// costs nothing.

#include <algorithm>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include <dsc/mesh/complex.hpp>
#include <dsc/mesh/local_star.hpp>
#include <dsc/repair/contract.hpp>

#include "kernel/refusal_memory.hpp"
#include "kernel/scratch.hpp"
#include "kernel/space_blocks.hpp"

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

/// A vertex that an edit has made at (1 - s) a + s b, and what was so at that time.
struct Split {
    VertexId vertex, a, b;
    double s;
    bool movable;  ///< the vertex
    Vec3 at_a, at_b;
};

/// A vertex that an edit has merged into another one, which now lies at (1 - s) kept + s removed.
struct Merge {
    VertexId kept, removed;
    double s;
    bool interface;  ///< the interface changed: a component may have become small
    bool movable;    ///< the kept vertex
    Vec3 at_kept;
};

/// Receives the vertices that edits create and remove, so that destinations can follow.
class EditListener {
public:
    EditListener() = default;
    EditListener(const EditListener&) = delete;
    EditListener& operator=(const EditListener&) = delete;
    virtual ~EditListener() = default;
    virtual void on_split(const Split& split) = 0;
    virtual void on_merge(const Merge& merge) = 0;
};

/// Sums over everything that was committed.
struct EditSums {
    double distance = 0.0;    ///< of the changes of the interface
    double volume = 0.0;      ///< of the changes of the interface
    double relabelled = 0.0;  ///< volume of the relabelled tets
    EditSums& operator+=(const EditSums& other) {
        distance += other.distance;
        volume += other.volume;
        relabelled += other.relabelled;
        return *this;
    }
};

class Workbench {
public:
    explicit Workbench(mesh::Complex& target)
        : complex(target),
          star_(target),
          lane_(target.serial_lane()),
          memory_(std::make_shared<RefusalMemory>()) {}
    /// For a block of space, beside other ones; shares the remembered refusals with `main`.
    Workbench(const Workbench& main, mesh::Lane& lane, SpaceBlocks& blocks)
        : complex(main.complex),
          star_(main.complex),
          lane_(lane),
          blocks_(&blocks),
          memory_(main.memory_) {}

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

    // ---- work in a block of space
    /// Limits the bench to a block; it must have been made for one.
    void enter(unsigned block) { block_ = block; }
    /// Whether the operation may use the whole stars of these vertices: in a block they must be
    /// vertices of the block, with all their neighbours.
    bool covers(std::span<const VertexId> vertices) {
        return blocks_ == nullptr || std::all_of(vertices.begin(), vertices.end(), [this](auto v) {
                   return blocks_->inner(v, block_, around_, walk_);
               });
    }
    bool covers(VertexId v) { return covers(std::span(&v, 1)); }
    /// Whether the operation may change the tet: in a block, its vertices must belong to the block.
    bool owns(TetId t) const;
    /// The outcome of a request that must wait until the work in blocks has ended, because it needs
    /// more than the block.
    Outcome defer() {
        deferred_ = true;
        return Refusal::stale;
    }
    /// Whether a part of the request was deferred since the last call.
    bool take_deferred() {
        const bool shortage = lane_.take_shortage();
        return std::exchange(deferred_, false) || shortage;
    }
    std::uint32_t clock() const { return lane_.clock(); }

    /// The tets of v.
    void star(VertexId v, std::vector<TetId>& out) { complex.cached_star(v, out, walk_); }

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

    /// Complex::link() for the edit; also false if the edit is deferred.
    bool link();

    // Operations change the complex only by these functions, of which the first two also count the
    // change in the sums. (The repair of irregular vertices after a relabelling is
    // mesh::unpinch().)
    /// Commits the linked edit. Returns the vertex that it creates, or none.
    VertexId commit(const InterfaceChange& change = {});
    /// Gives the tets their new label.
    void commit(const Relabelling& relabelling, const InterfaceChange& change = {});
    /// Moves a vertex to a place where its tets have these qualities, in the order of the star. The
    /// qualities are computed if there are none.
    void move_to(VertexId v, const Vec3& place, std::span<const TetId> star,
                 std::span<const float> qualities = {});
    /// Tells the listener, after the commit, that `vertex` was made at (1 - s) a + s b.
    void tell_split(VertexId vertex, VertexId a, VertexId b, double s);
    /// Tells the listener, after the commit, that `removed` was merged into `kept`, which now lies
    /// at (1 - s) kept + s removed.
    void tell_merge(VertexId kept, VertexId removed, double s, bool interface);

    /// Interface vertices that both stars contain, by id.
    void shared_interface_vertices(std::span<const TetId> star_a, std::span<const TetId> star_b,
                                   std::vector<VertexId>& out);
    /// Interface vertices of the edit's removed tets, by id, and then the vertex that the edit
    /// creates.
    void cavity_interface_vertices(std::vector<VertexId>& out) const;

    /// The reason for which the smoothing would be refused again, or nothing if an attempt is
    /// useful.
    std::optional<Refusal> known_refusal(VertexId v, Smoother smoother, float accept_above) const {
        return memory_->find(complex, v, smoother, accept_above);
    }
    Refusal remember(VertexId v, Smoother smoother, float accept_above, Refusal refusal) {
        memory_->grow(complex.vertex_slots());
        memory_->note(v, smoother, accept_above, refusal, clock());
        return refusal;
    }
    RefusalMemory& refusals() { return *memory_; }

    /// Whether the interface faces round v are flat to each other (signed normals). `star`: the
    /// tets of v.
    bool flat(VertexId v, std::span<const TetId> star);
    /// Vertices of the star's interface faces as triangles with v first, counter-clockwise from the
    /// smaller label.
    void interface_fan(VertexId v, std::span<const TetId> star,
                       std::vector<std::array<VertexId, 3>>& out) const;

    mesh::LocalStar& local_star() { return star_; }

private:
    mesh::LocalStar star_;
    mesh::Lane& lane_;
    SpaceBlocks* blocks_ = nullptr;  // null: the bench may change everything
    unsigned block_ = 0;
    bool deferred_ = false;
    std::shared_ptr<RefusalMemory> memory_;

    std::vector<std::array<VertexId, 3>> fan_;
    std::vector<Vec3> normals_;
    std::vector<TetId> around_;
    mesh::TetIndex walk_, listed_;
};

}  // namespace dsc::kernel
