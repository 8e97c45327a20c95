#pragma once
// The labelled tetrahedral complex (method.md, sections 1 and 2): compact tets with neighbours,
// vertices with a seed tet. It stores no edges or faces.
//
// A tet (v0,v1,v2,v3) is positive: orient3d(v0,v1,v2,v3) == 1, always and exactly. Face i is
// opposite vertex i. Labels define the interface: a face belongs to it if its two tets have
// different labels, a face on the box if its tet's label is not 0. Three primitives change a
// complex: replace(), move() and relabel(). Each keeps it valid.

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include <dsc/base/bits.hpp>
#include <dsc/base/large_vector.hpp>
#include <dsc/base/prefetch.hpp>
#include <dsc/base/workers.hpp>
#include <dsc/geometry/vec.hpp>
#include <dsc/mesh/edit.hpp>
#include <dsc/mesh/star_cache.hpp>
#include <dsc/mesh/tet.hpp>
#include <dsc/mesh/tet_index.hpp>
#include <dsc/mesh/tet_mesh.hpp>

namespace dsc {
class StateReader;
class StateWriter;
}  // namespace dsc

namespace dsc::mesh {

/// The tets round a vertex in the order of the walk, and the vertices joined to it in ascending
/// birth order.
struct Star {
    std::span<const TetId> tets;
    std::span<const VertexId> neighbours;
};

/// Arrays that a walk round a vertex fills. Each thread needs its own object. If one object serves
/// many walks, memory is allocated only for a star that is larger than all stars before.
struct StarWalk {
    TetIndex places;
    std::vector<TetId> tets;
    std::vector<VertexId> neighbours;
};

/// Tets that have changed since a time; see Complex::changes() and Complex::watched().
struct ChangeLists {
    LargeVector<TetId> changed, watched;
};

class DateRanks;

/// See the head of the file.
class Complex {
public:
    Complex() = default;

    // ---- sizes and plain reads ------------------------------------------------------------------
    /// Slots include dead entries: loop over the slots and test whether each is alive.
    std::size_t vertex_slots() const { return vertices_.size(); }
    std::size_t tet_slots() const { return tets_.size(); }
    std::size_t vertex_count() const { return vertices_.size() - free_vertices_.size(); }
    std::size_t tet_count() const { return tets_.size() - free_tets_.size(); }
    bool vertex_alive(VertexId v) const { return shapes_[v].seed != none; }
    bool tet_alive(TetId t) const { return tets_[t].v[0] != none; }
    /// The same from one bit per slot: for loops that read nothing else of the tets.
    bool in_use(TetId t) const { return !free_slots_.contains(t); }

    const Vec3& position(VertexId v) const { return vertices_[v].position; }
    const Tet& tet(TetId t) const { return tets_[t]; }
    /// What lies across face i: 4 * neighbour + its face index there, or none.
    std::uint32_t across(TetId t, unsigned face) const { return neighbours_[t][face]; }
    Label label(TetId t) const { return tets_[t].label; }
    /// Volume-length quality in (0, 1], cached.
    float quality(TetId t) const { return tets_[t].quality; }
    /// The least quality of all tets, or 2 if the complex has no tet. It reads 32 bytes per tet.
    float least_quality() const;
    /// Value of the change clock when the tet was last made, moved or relabelled.
    std::uint32_t date(TetId t) const { return tets_[t].date; }
    /// Value of the change clock when the tet's slot was last filled; it differs if another tet
    /// took the slot.
    std::uint32_t birth_date(TetId t) const { return tets_[t].birth_date; }
    /// Value of the change clock when a tet of the vertex' star last changed.
    std::uint32_t vertex_date(VertexId v) const { return vertices_[v].date; }
    /// Value of the change clock when a tet of the vertex' star was last made, removed or
    /// relabelled; moves leave it.
    std::uint32_t shape_date(VertexId v) const { return shapes_[v].date; }
    /// The change clock. It advances with each committed change. A Deformer calls renew_dates()
    /// between steps, after some billion changes.
    std::uint32_t clock() const { return clock_; }
    /// Value of the change clock when a shape_date() last advanced.
    std::uint32_t shape_clock() const { return shape_clock_; }
    /// Number of the vertex in the order of creation; it survives renumbering and resuming.
    std::uint32_t birth(VertexId v) const { return births_[v]; }
    /// Birth of the vertex that will be created next: greater than all births so far. A birth is
    /// never used again.
    std::uint32_t next_birth() const { return next_birth_; }

    Box3 box() const { return box_; }
    bool on_box(VertexId v) const { return vertices_[v].on_box != 0; }
    /// Number of different labels in the star, with 0 for the outside of the box; at most 3.
    unsigned phases(VertexId v) const { return vertices_[v].phases; }
    bool on_interface(VertexId v) const { return vertices_[v].phases > 1; }
    /// On the interface, not on the box, exactly two labels.
    bool movable(VertexId v) const {
        return ((vertices_[v].phases ^ 2U) | vertices_[v].on_box) == 0;
    }
    /// Neither on the interface nor on the box.
    bool interior(VertexId v) const {
        return ((vertices_[v].phases & 2U) | vertices_[v].on_box) == 0;
    }
    /// A byte for loops over stars, beside the position because such loops read both. A new vertex
    /// has 0. It is not saved. Threads that share it use std::atomic_ref.
    std::uint8_t& mark(VertexId v) { return vertices_[v].mark; }
    /// Sets all marks to 0. [step]
    void clear_marks() {
        for (Vertex& vertex : vertices_) vertex.mark = 0;
    }
    /// All interface vertices, in unspecified order (sort by birth).
    std::span<const VertexId> interface_vertices() const { return interface_; }
    /// Label on the other side of face i: that of the neighbour, or 0 outside the box.
    Label label_across(TetId t, unsigned face) const {
        const std::uint32_t code = neighbours_[t][face];
        return code == none ? 0 : tets_[neighbour_tet(code)].label;
    }
    bool interface_face(TetId t, unsigned face) const {
        return tets_[t].label != label_across(t, face);
    }
    double volume(TetId t) const;
    /// Whether a loop over many tets in no order of memory waits for the memory, so that it pays to
    /// ask for data ahead. Smaller complexes lie in the near caches.
    bool exceeds_caches() const { return tets_.size() >= 30'000; }
    /// Asks the memory for a tet that will be read soon, or for the vertices of one that is there
    /// already.
    void prefetch(TetId t) const { prefetch_line(&tets_[t]); }
    void prefetch_vertices(TetId t) const {
        for (const VertexId v : tets_[t].v) {
            if (v != none) prefetch_line(&vertices_[v]);
        }
    }
    void prefetch_vertex(VertexId v) const { prefetch_line(&vertices_[v]); }
    void prefetch_birth(VertexId v) const { prefetch_line(&births_[v]); }
    /// The same for what lies across the faces of a tet: first for where it is stored, then for the
    /// tets there.
    void prefetch_codes(TetId t) const { prefetch_line(&neighbours_[t]); }
    void prefetch_across(TetId t) const {
        for (const std::uint32_t code : neighbours_[t]) {
            if (code != none) prefetch(neighbour_tet(code));
        }
    }

    /// The same for the star of a vertex that is alive: first where it is stored, then its ids,
    /// then its tets and neighbours. Each call needs what the one before has fetched. If the star
    /// is not known, they ask for what its walk reads first.
    void prefetch_star_entry(VertexId v) const {
        stars_.prefetch(v);
        prefetch_line(&shapes_[v]);
    }
    void prefetch_star(VertexId v) const {
        if (knows_star(v)) return stars_.prefetch_ids(v);
        prefetch_tet(seed(v));
    }
    void prefetch_star_tets(VertexId v) const {
        for (const TetId t : stars_.tets(v)) prefetch(t);
        for (const VertexId w : stars_.neighbours(v)) prefetch_vertex(w);
        if (knows_star(v)) return;
        for (const std::uint32_t code : neighbours_[seed(v)]) {
            if (code != none) prefetch_tet(neighbour_tet(code));
        }
    }
    void prefetch_tet(TetId t) const {
        prefetch(t);
        prefetch_codes(t);
    }
    /// Whether cached_star() has the star without a walk.
    bool knows_star(VertexId v) const { return !stars_.tets(v).empty(); }

    // ---- walks ----------------------------------------------------------------------------------
    /// All tets that contain v, the seed first; `places` maps a tet to its place in `out`.
    /// [parallel]
    void star(VertexId v, std::vector<TetId>& out, TetIndex& places) const;
    /// The same tets without the places. [step]
    void star(VertexId v, std::vector<TetId>& out) const;
    /// The same tets and the neighbours without a copy: they lie in the cache, or in `walk` if
    /// there are very many or another thread is storing them. They stay there until the next call
    /// with the same `walk`, or until the star changes. [parallel]
    Star cached_star(VertexId v, StarWalk& walk) const;
    /// The place in v's star of the tet that refused a move of v last. It is only a hint where to
    /// look first: it may be any number, and nothing may depend on it but the time. [parallel] if
    /// no two threads ask for the same vertex.
    std::size_t suspect(VertexId v) const { return stars_.suspect(v); }
    void keep_suspect(VertexId v, std::size_t place) const { stars_.keep_suspect(v, place); }
    TetId seed(VertexId v) const { return shapes_[v].seed; }
    /// The ring of edge (a, b), both vertices of tet t. [parallel]
    void ring(TetId t, VertexId a, VertexId b, EdgeRing& out) const;
    /// The same for an edge that is not on the box, if its ring has at most `most` tets and all
    /// have the label of t. False if not; then `out` contains a part of the ring. [parallel]
    bool inner_ring(TetId t, VertexId a, VertexId b, std::size_t most, EdgeRing& out) const;
    /// A tet that contains both vertices; none if a and b are not joined. [step]
    TetId find_edge(VertexId a, VertexId b) const;

    // ---- the three primitives -------------------------------------------------------------------
    /// Computes the neighbours of the added tets. False if the added tets do not fill the boundary
    /// of the cavity exactly (a face used twice, a hole, a change of the box). Changes only the
    /// edit. [step]
    bool link(Edit& edit) const;
    /// Commits a linked edit; its tets must be positive. Returns the id of the created vertex, or
    /// none. [step]
    VertexId replace(Edit& edit);
    /// Moves vertex v. `star` is the list of all tets that have the corner v. Each of them must be
    /// positive after the move. [step]
    void move(VertexId v, const Vec3& position, std::span<const TetId> star);
    /// The same with known qualities of the tets at the new position, in the order of the star.
    /// [step]
    void move(VertexId v, const Vec3& position, std::span<const TetId> star,
              std::span<const float> qualities) {
        place(v, position, star, qualities);
        note_change(v, star);
    }
    /// The parts of move(), for several vertices. place() and date_move() may run in parallel if no
    /// other thread uses the star meanwhile. The dates are above clock(), and of two moves with a
    /// common tet the later one comes later; `changes` receives the tets that are not on the lists
    /// yet [parallel]. Then add_changes() and add_watched() make room on the two lists, where the
    /// caller writes them, the changed ones in the order of the moves, and advance_clock() goes to
    /// a time that is not before the last move [step].
    void place(VertexId v, const Vec3& position, std::span<const TetId> star,
               std::span<const float> qualities);
    /// `dates_now(w)`, for v and each neighbour: false if another thread may date a move round w
    /// meanwhile; then w keeps its date, and the caller calls raise_date().
    template <class DatesNow>
    void date_move(VertexId v, const Star& star, std::uint32_t date, ChangeLists& changes,
                   const DatesNow& dates_now);
    /// The date of v becomes `date` if it is earlier.
    void raise_date(VertexId v, std::uint32_t date) {
        vertices_[v].date = std::max(vertices_[v].date, date);
    }
    std::span<TetId> add_changes(std::size_t count) {
        lists_.changed.resize(lists_.changed.size() + count);
        return std::span(lists_.changed).last(count);
    }
    std::span<TetId> add_watched(std::size_t count) {
        lists_.watched.resize(lists_.watched.size() + count);
        return std::span(lists_.watched).last(count);
    }
    void advance_clock(std::uint32_t time) { clock_ = time; }
    /// Replaces all dates and the clock by their ranks, so that the clock can go on. It is smaller
    /// afterwards; whoever remembers dates applies the ranks to them, or forgets them. [step]
    DateRanks renew_dates();
    /// Gives tets another label. [step]
    void relabel(std::span<const TetId> tets, Label label);

    /// Ids of the tets that the last replace() wrote, in the order of Edit::added.
    std::span<const TetId> last_added() const { return last_added_; }

    // ---- change tracking ------------------------------------------------------------------------
    /// Tets made, moved or relabelled since the last call of take_changes(), each once; may include
    /// dead ids.
    std::span<const TetId> changes() const { return lists_.changed; }
    /// Moves the change list to `out` and starts a new one.
    void take_changes(LargeVector<TetId>& out);
    /// Uses the memory of a list that take_changes() filled for the next changes, if there are none
    /// yet; the list is empty afterwards.
    void reuse(LargeVector<TetId>& taken);
    /// Starts a list that stays when the change list is taken: the tets that are on the change list
    /// now, and those that change later, each once. The list is not saved. [step]
    void start_watch();
    /// Adds those of the tets that have not changed since then, also if they were added before.
    /// [step]
    void watch(std::span<const TetId> tets);
    /// In unspecified order; may include dead ids. Empty before start_watch().
    std::span<const TetId> watched() const { return lists_.watched; }

    /// The vertices whose shape_date() has advanced since the last call, each once; may include
    /// dead ids. The list is not saved. [step]
    void take_reshaped(std::vector<VertexId>& out);

    // ---- making and copying ---------------------------------------------------------------------
    /// Builds a complex from arrays that are already positive, conforming and box-filling (for
    /// files see adopt()).
    static Complex assemble(std::vector<Vec3> points, LargeVector<TetCorners> tets,
                            LargeVector<TetNeighbours> neighbours, std::span<const Label> labels,
                            Workers* workers = nullptr);
    /// Compact arrays: vertices in birth order, tets in the order of their sorted births. The same
    /// complex gives the same bytes, whatever its slots. `ids`, if given, receives the complex'
    /// vertex of each point.
    TetMesh to_mesh(std::vector<VertexId>* ids = nullptr) const;
    /// Saves everything, including slots, clocks and the change list: a loaded complex continues
    /// exactly as the saved one. [step]
    void save(StateWriter& out) const;
    /// Throws IoError "state.damaged" if the bytes are not a complex. [setup]
    static Complex load(StateReader& in);

private:
    // The data of a vertex that loops over many tets read. These 32 bytes lie in one line of the
    // caches, as those of a Tet do.
    struct alignas(32) Vertex {
        Vec3 position = Vec3::Zero();
        std::uint32_t date = 0;
        std::uint8_t phases = 1;
        std::uint8_t on_box = 0;
        std::uint8_t mark = 0;
        std::uint8_t unused = 0;  // named, so that the saved bytes are defined
    };
    static_assert(sizeof(Vertex) == 32);
    // What changes only if the tets of its star change.
    struct VertexShape {
        TetId seed = none;
        std::uint32_t date = 0;  // shape_date()
    };

    VertexId allocate_vertex(const Vec3& position);
    TetId allocate_tet();
    void note_change(VertexId v, std::span<const TetId> star);
    void touch(TetId t);
    void reshape(VertexId v) {
        shape_clock_ = clock_;
        if (std::exchange(shapes_[v].date, clock_) <= reshaped_since_) reshaped_.push_back(v);
    }
    void note(std::span<const TetId> tets, std::uint32_t date, ChangeLists& lists);
    bool find_relabelled(const Edit& edit);
    unsigned count_phases(VertexId v, std::span<const TetId> star) const;
    void refresh_phases(VertexId v);
    void set_phases(VertexId v, unsigned phases);
    std::span<const TetId> own_star(VertexId v) const;
    void walk_star(VertexId v, std::vector<TetId>& out, TetIndex& places) const;
    void walk_codes(VertexId v, std::vector<std::uint32_t>& out, TetIndex& places) const;
    void find_neighbours(VertexId v, std::span<const std::uint32_t> codes,
                         std::vector<VertexId>& out, TetIndex& seen) const;
    void sort_by_birth(std::vector<VertexId>& list) const;

    LargeVector<Vertex> vertices_;
    LargeVector<Tet> tets_;
    LargeVector<TetNeighbours> neighbours_;  // per tet
    LargeVector<VertexShape> shapes_;        // per vertex
    LargeVector<std::uint32_t> births_;      // per vertex
    // Per vertex: its index in interface_, or none if it is not there.
    LargeVector<std::uint32_t> interface_slots_;
    std::vector<VertexId> free_vertices_;
    std::vector<TetId> free_tets_;
    Bits free_slots_;  // the same set
    std::vector<VertexId> interface_;
    ChangeLists lists_;
    std::vector<TetId> last_added_;
    struct CavityLabels {
        VertexId vertex;
        std::array<std::uint64_t, 2> labels;  // before and after
    };
    std::vector<CavityLabels> cavity_labels_;
    std::vector<VertexId> relabelled_;
    mutable StarWalk walk_;
    mutable StarCache stars_;          // of the vertices that were asked for
    std::uint32_t taken_clock_ = 0;    // clock when the change list was last taken; tets of a later
                                       // date are in the list
    std::uint32_t watched_since_ = 0;  // tets of this date or a later one are watched
    std::uint32_t shape_clock_ = 0;
    std::vector<VertexId> reshaped_;
    std::uint32_t reshaped_since_ = 0;  // vertices of a later shape date are in the list
    std::uint32_t clock_ = 0;
    std::uint32_t next_birth_ = 0;
    Box3 box_;

    struct FaceSlot {
        std::array<VertexId, 3> key;
        std::uint32_t code;
        std::uint32_t stamp;
        bool used;
    };
    mutable std::vector<FaceSlot> face_table_;
    mutable std::uint32_t face_stamp_ = 0;
};

// Dates the tets and lists those that are not on the lists yet.
inline void Complex::note(std::span<const TetId> tets, std::uint32_t date, ChangeLists& lists) {
    // A tet is written, and counts if it is not on the list: a branch could not be predicted.
    std::size_t count = lists.changed.size();
    lists.changed.resize(count + tets.size());
    TetId* const changed = lists.changed.data();
    const std::uint32_t taken = taken_clock_, watched_since = watched_since_;  // not after `taken`
    for (const TetId t : tets) {
        const std::uint32_t before = std::exchange(tets_[t].date, date);
        changed[count] = t;
        count += before <= taken ? 1 : 0;
        if (before < watched_since) lists.watched.push_back(t);
    }
    lists.changed.resize(count);
}

template <class DatesNow>
void Complex::date_move(VertexId v, const Star& star, std::uint32_t date, ChangeLists& changes,
                        const DatesNow& dates_now) {
    note(star.tets, date, changes);
    const auto give_date = [this, date, &dates_now](VertexId w) {
        if (dates_now(w)) vertices_[w].date = date;
    };
    give_date(v);
    for (const VertexId w : star.neighbours) give_date(w);
}

/// Mean length of the interface's edges; 0 without an interface. It does not depend on the slots.
double mean_interface_edge(const Complex& complex);

}  // namespace dsc::mesh
