// The complex: its three primitives replace(), move() and relabel(), and its construction
// (method.md, sections 1 and 4.1).
#include "dsc/mesh/complex.hpp"

#include <algorithm>

#include <dsc/base/release.hpp>
#include <dsc/geometry/quality.hpp>

namespace dsc::mesh {
namespace {

constexpr float no_quality = 2.0F;  // of a slot without a tet

}  // namespace

double Complex::volume(TetId t) const {
    const auto& v = tets_[t].v;
    return geometry::tet_volume(position(v[0]), position(v[1]), position(v[2]), position(v[3]));
}

float Complex::least_quality() const {
    float least = no_quality;
    for (const Tet& tet : tets_) least = tet.quality < least ? tet.quality : least;
    return least;
}

VertexId Complex::allocate_vertex(const Vec3& position) {
    VertexId v = none;
    if (free_vertices_.empty()) {
        v = static_cast<VertexId>(vertices_.size());
        vertices_.emplace_back();
        shapes_.emplace_back();
        births_.emplace_back();
        interface_slots_.push_back(none);
        stars_.grow(vertices_.size());
    } else {
        v = free_vertices_.back();
        free_vertices_.pop_back();
    }
    vertices_[v] = {position, clock_};
    shapes_[v].seed = none;
    births_[v] = next_birth_++;
    return v;
}

TetId Complex::allocate_tet() {
    if (!free_tets_.empty()) {
        const TetId t = free_tets_.back();
        free_tets_.pop_back();
        free_slots_.erase(t);
        return t;
    }
    const auto t = static_cast<TetId>(tets_.size());
    tets_.emplace_back();
    neighbours_.emplace_back();
    free_slots_.grow(tets_.size());
    return t;
}

void Complex::touch(TetId t) {
    // As note().
    const std::uint32_t before = std::exchange(tets_[t].date, clock_);
    if (before <= taken_clock_) lists_.changed.push_back(t);
    if (before < watched_since_) lists_.watched.push_back(t);
    for (const VertexId v : tets_[t].v) vertices_[v].date = clock_;
}

void Complex::take_changes(LargeVector<TetId>& out) {
    out.clear();
    std::swap(out, lists_.changed);
    taken_clock_ = clock_;
}

void Complex::reuse(LargeVector<TetId>& taken) {
    const std::size_t wanted = taken.size();
    taken.clear();
    if (!lists_.changed.empty()) return;
    give_back_room(taken, wanted);
    std::swap(taken, lists_.changed);
}

void Complex::start_watch() {
    give_back_room(lists_.watched, lists_.watched.size());
    lists_.watched = lists_.changed;
    watched_since_ = taken_clock_ + 1;
}

void Complex::take_reshaped(std::vector<VertexId>& out) {
    out.clear();
    std::swap(out, reshaped_);
    reshaped_since_ = clock_;
}

void Complex::watch(std::span<const TetId> tets) {
    for (const TetId t : tets) {
        if (tets_[t].date < watched_since_) lists_.watched.push_back(t);
    }
}

void Complex::set_phases(VertexId v, unsigned phases) {
    vertices_[v].phases = static_cast<std::uint8_t>(phases);
    std::uint32_t& slot = interface_slots_[v];
    if (phases > 1 && slot == none) {
        slot = static_cast<std::uint32_t>(interface_.size());
        interface_.push_back(v);
    } else if (phases <= 1 && slot != none) {
        const VertexId last = interface_.back();
        interface_[slot] = last;
        interface_slots_[last] = slot;
        interface_.pop_back();
        slot = none;
    }
}

unsigned Complex::count_phases(VertexId v, std::span<const TetId> star) const {
    std::array<Label, 3> seen{};
    unsigned count = 0;
    const auto note = [&](Label label) {
        if (count < 3 &&
            std::find(seen.begin(), seen.begin() + count, label) == seen.begin() + count) {
            seen[count++] = label;
        }
    };
    for (const TetId t : star) note(tets_[t].label);
    if (on_box(v)) note(0);
    return count;
}

void Complex::refresh_phases(VertexId v) { set_phases(v, count_phases(v, own_star(v))); }

void Complex::move(VertexId v, const Vec3& position, std::span<const TetId> star) {
    ++clock_;
    vertices_[v].position = position;
    for (const TetId t : star) {
        const auto& x = tets_[t].v;
        tets_[t].quality =
            static_cast<float>(geometry::tet_quality(this->position(x[0]), this->position(x[1]),
                                                     this->position(x[2]), this->position(x[3])));
        touch(t);
    }
}

void Complex::place(VertexId v, const Vec3& position, std::span<const TetId> star,
                    std::span<const float> qualities) {
    vertices_[v].position = position;
    for (std::size_t i = 0; i < star.size(); ++i) tets_[star[i]].quality = qualities[i];
}

// The vertices of a star are v and its neighbours. If the neighbours are known, each is dated once
// and not in every tet.
void Complex::note_change(VertexId v, std::span<const TetId> star) {
    ++clock_;
    const std::span<const VertexId> neighbours = stars_.neighbours(v);
    if (neighbours.empty()) {
        for (const TetId t : star) touch(t);
        return;
    }
    date_move(v, {star, neighbours}, clock_, lists_, [](VertexId) { return true; });
}

void Complex::relabel(std::span<const TetId> tets, Label label) {
    ++clock_;
    walk_.places.clear();
    relabelled_.clear();
    for (const TetId t : tets) {
        tets_[t].label = label;
        touch(t);
        for (const VertexId v : tets_[t].v) {
            if (walk_.places.insert(v)) relabelled_.push_back(v);
        }
    }
    for (const VertexId v : relabelled_) {
        reshape(v);
        refresh_phases(v);
    }
}

// Whether the labels round some vertices may change; relabelled_ then contains the existing
// vertices among them. If a vertex has the same labels in the cavity before and after, as in nearly
// every edit, the labels of its star do not change either.
bool Complex::find_relabelled(const Edit& edit) {
    relabelled_.clear();
    const Label first = edit.added.empty() ? 0 : edit.added.front().label;
    const auto same = [first](Label label) { return label == first; };
    if (std::all_of(edit.removed.begin(), edit.removed.end(),
                    [&](TetId t) { return same(tets_[t].label); }) &&
        std::all_of(edit.added.begin(), edit.added.end(),
                    [&](const NewTet& t) { return same(t.label); })) {
        return false;
    }
    walk_.places.clear();
    cavity_labels_.clear();
    // A set of labels as bits, exact for labels up to 63; with larger labels, every vertex of the
    // cavity is tested.
    const auto bit = [](Label label) {
        return std::uint64_t{1} << (static_cast<std::uint32_t>(label) & 63U);
    };
    const auto note = [&](VertexId v, Label label, std::size_t when) {
        if (v == created_vertex) return;
        if (walk_.places.insert(v)) cavity_labels_.push_back({v, {0, 0}});
        cavity_labels_[walk_.places.find(v)].labels[when] |= bit(label);
    };
    const auto small = [](Label label) { return label >= 0 && label < 64; };
    bool exact = true;
    for (const TetId t : edit.removed) {
        exact = exact && small(tets_[t].label);
        for (const VertexId v : tets_[t].v) note(v, tets_[t].label, 0);
    }
    for (const NewTet& tet : edit.added) {
        exact = exact && small(tet.label);
        for (const VertexId v : tet.v) note(v, tet.label, 1);
    }
    for (const CavityLabels& entry : cavity_labels_) {
        if (entry.vertex != edit.deleted && (!exact || entry.labels[0] != entry.labels[1]))
            relabelled_.push_back(entry.vertex);
    }
    return true;
}

VertexId Complex::replace(Edit& edit) {
    ++clock_;
    const bool several_labels = find_relabelled(edit);

    VertexId created = none;
    if (edit.creates) created = allocate_vertex(edit.created_at);
    if (edit.moved != none) vertices_[edit.moved].position = edit.moved_to;

    // The slots of the cavity are filled first, so that new tets stay near old ones in memory.
    last_added_.resize(edit.added.size());
    for (std::size_t i = 0; i < edit.added.size(); ++i) {
        last_added_[i] = i < edit.removed.size() ? edit.removed[i] : allocate_tet();
    }
    for (std::size_t i = 0; i < edit.added.size(); ++i) {
        const TetId t = last_added_[i];
        Tet& tet = tets_[t];
        tet.v = edit.added[i].v;
        for (VertexId& v : tet.v) {
            if (v == created_vertex) v = created;
        }
        TetNeighbours& across = neighbours_[t];
        for (unsigned f = 0; f < 4; ++f) {
            const std::uint32_t code = edit.neighbours[i][f];
            if (code == none) {
                across[f] = none;
            } else if ((code & Edit::virtual_code) != 0) {
                const std::uint32_t local = code & ~Edit::virtual_code;
                across[f] = 4 * last_added_[local >> 2U] + (local & 3U);
            } else {
                across[f] = code;
                neighbours_[neighbour_tet(code)][neighbour_face(code)] = 4 * t + f;
            }
        }
        tets_[t].label = edit.added[i].label;
        tets_[t].birth_date = clock_;
        for (const VertexId v : tet.v) {
            shapes_[v].seed = t;
            reshape(v);
            stars_.forget(v);
        }
    }
    const bool have_qualities = edit.qualities.size() == edit.added.size();
    for (std::size_t i = 0; i < edit.added.size(); ++i) {
        const TetId t = last_added_[i];
        const auto& x = tets_[t].v;
        tets_[t].quality =
            have_qualities ? edit.qualities[i]
                           : static_cast<float>(geometry::tet_quality(
                                 position(x[0]), position(x[1]), position(x[2]), position(x[3])));
        touch(t);
    }
    for (std::size_t i = edit.added.size(); i < edit.removed.size(); ++i) {
        const TetId t = edit.removed[i];
        tets_[t].v[0] = none;
        tets_[t].quality = no_quality;
        tets_[t].birth_date = clock_;
        free_tets_.push_back(t);
        free_slots_.insert(t);
    }
    if (edit.deleted != none) {
        set_phases(edit.deleted, 1);
        shapes_[edit.deleted].seed = none;
        stars_.forget(edit.deleted);
        free_vertices_.push_back(edit.deleted);
    }
    for (const VertexId v : relabelled_) refresh_phases(v);
    if (several_labels && created != none) refresh_phases(created);
    return created;
}

Complex Complex::assemble(std::vector<Vec3> points, LargeVector<TetCorners> tets,
                          LargeVector<TetNeighbours> neighbours, std::span<const Label> labels,
                          Workers* workers) {
    constexpr std::size_t assembled_tets = 16384, assembled_stars = 2048;  // per block
    Complex c;
    c.vertices_.reserve(points.size());
    c.births_.reserve(points.size());
    for (const Vec3& p : points) {
        c.vertices_.push_back({p});
        c.births_.push_back(c.next_birth_++);
        c.box_.extend(p);
    }
    c.shapes_.assign(c.vertices_.size(), {none, 1});
    c.interface_slots_.assign(c.vertices_.size(), none);
    c.stars_.grow(c.vertices_.size());
    c.tets_.resize(tets.size());
    c.free_slots_.grow(tets.size());
    c.neighbours_ = std::move(neighbours);
    const std::size_t n = c.tets_.size();
    c.lists_.changed.reserve(n + n / 8);  // more may be made before the list is taken
    c.clock_ = c.shape_clock_ = c.reshaped_since_ = 1;
    for_blocks(workers, n, assembled_tets, [&c, &tets, labels](std::size_t begin, std::size_t end) {
        for (std::size_t t = begin; t < end; ++t) {
            const TetCorners& v = tets[t];
            const double quality = geometry::tet_quality(c.position(v[0]), c.position(v[1]),
                                                         c.position(v[2]), c.position(v[3]));
            c.tets_[t] = {v, static_cast<float>(quality), 0, 1, labels[t]};
        }
    });
    release(tets);
    for (TetId t = 0; t < n; ++t) {
        const auto& v = c.tets_[t].v;
        for (unsigned f = 0; f < 4; ++f) {
            c.shapes_[v[f]].seed = t;
            if (c.neighbours_[t][f] != none) continue;
            for (const auto i : face_vertices[f]) c.vertices_[v[i]].on_box = 1;
        }
        c.touch(t);
    }
    // Vertices with one label in their star need no change; only vertices of interface faces are
    // tested.
    std::vector<char> candidate(c.vertices_.size(), 0);
    for (TetId t = 0; t < n; ++t) {
        for (unsigned f = 0; f < 4; ++f) {
            if (!c.interface_face(t, f)) continue;
            for (const auto i : face_vertices[f]) candidate[c.tets_[t].v[i]] = 1;
        }
    }
    std::vector<VertexId> ends;
    for (VertexId v = 0; v < c.vertices_.size(); ++v) {
        if (candidate[v] != 0) ends.push_back(v);
    }
    std::vector<std::uint8_t> phases(ends.size(), 0);
    for_blocks(workers, ends.size(), assembled_stars, [&](std::size_t begin, std::size_t end) {
        TetIndex places;
        std::vector<TetId> around;
        for (std::size_t i = begin; i < end; ++i) {
            c.star(ends[i], around, places);
            phases[i] = static_cast<std::uint8_t>(c.count_phases(ends[i], around));
        }
    });
    for (std::size_t i = 0; i < ends.size(); ++i) c.set_phases(ends[i], phases[i]);
    return c;
}

TetMesh Complex::to_mesh(std::vector<VertexId>* ids) const {
    std::vector<VertexId> order;
    order.reserve(vertex_count());
    for (VertexId v = 0; v < vertices_.size(); ++v) {
        if (vertex_alive(v)) order.push_back(v);
    }
    std::sort(order.begin(), order.end(),
              [this](VertexId a, VertexId b) { return birth(a) < birth(b); });
    std::vector<std::uint32_t> index(vertices_.size(), none);
    TetMesh mesh;
    mesh.points.reserve(order.size());
    for (std::size_t i = 0; i < order.size(); ++i) {
        index[order[i]] = static_cast<std::uint32_t>(i);
        mesh.points.push_back(position(order[i]));
    }
    struct Row {
        std::array<std::uint32_t, 4> v;
        Label label;
    };
    std::vector<Row> rows;
    rows.reserve(tet_count());
    for (TetId t = 0; t < tets_.size(); ++t) {
        if (!tet_alive(t)) continue;
        std::array<std::uint32_t, 4> v{};
        for (unsigned i = 0; i < 4; ++i) v[i] = index[tets_[t].v[i]];
        // Sorts; an odd number of exchanges inverts the tet, and exchanging the last two corrects
        // this.
        bool odd = false;
        for (unsigned i = 1; i < 4; ++i) {
            for (unsigned j = i; j > 0 && v[j] < v[j - 1]; --j) {
                std::swap(v[j], v[j - 1]);
                odd = !odd;
            }
        }
        if (odd) std::swap(v[2], v[3]);
        rows.push_back({v, tets_[t].label});
    }
    std::sort(rows.begin(), rows.end(), [](const Row& a, const Row& b) {
        auto x = a.v, y = b.v;
        if (x[3] < x[2]) std::swap(x[2], x[3]);
        if (y[3] < y[2]) std::swap(y[2], y[3]);
        return x < y;
    });
    mesh.tets.reserve(rows.size());
    mesh.labels.reserve(rows.size());
    for (const Row& row : rows) {
        mesh.tets.push_back(row.v);
        mesh.labels.push_back(row.label);
    }
    if (ids != nullptr) *ids = std::move(order);
    return mesh;
}

}  // namespace dsc::mesh
