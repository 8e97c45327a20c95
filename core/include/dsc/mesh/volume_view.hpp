#pragma once
// The labelled volume as observers and refinements read it: tets, labels, positions, neighbours and
// quality, without a copy.

#include <array>
#include <cstddef>
#include <vector>

#include <dsc/mesh/complex.hpp>

namespace dsc::mesh {

/// The ids of all tets, or of all vertices, of a complex for a loop, ascending.
template <bool Tets>
class LiveIds {
public:
    class Iterator {
    public:
        Iterator(const Complex* complex, std::uint32_t id) : complex_(complex), id_(id) { skip(); }
        std::uint32_t operator*() const { return id_; }
        Iterator& operator++() {
            ++id_;
            skip();
            return *this;
        }
        bool operator==(const Iterator& other) const { return id_ == other.id_; }
        bool operator!=(const Iterator& other) const { return id_ != other.id_; }

    private:
        void skip() {
            while (id_ < slots(*complex_) && !alive(*complex_, id_)) ++id_;
        }
        const Complex* complex_;
        std::uint32_t id_;
    };

    explicit LiveIds(const Complex* complex) : complex_(complex) {}
    Iterator begin() const { return {complex_, 0}; }
    Iterator end() const { return {complex_, slots(*complex_)}; }

private:
    static std::uint32_t slots(const Complex& c) {
        return static_cast<std::uint32_t>(Tets ? c.tet_slots() : c.vertex_slots());
    }
    static bool alive(const Complex& c, std::uint32_t id) {
        return Tets ? c.tet_alive(id) : c.vertex_alive(id);
    }
    const Complex* complex_;
};

/// A read-only view of the labelled tets, without a copy. Tet ids are those of
/// SurfaceView::face_tets and RefinementRequests::relabel; vertex ids are those of
/// SurfaceView::vertex_ids. Ids have gaps, and a later tet or vertex may get a free id, so ids are
/// valid only during the call that gets the view. All methods may be called from several threads at
/// once.
class VolumeView {
public:
    /// The complex must outlive the view. [setup]
    explicit VolumeView(const Complex& complex) : complex_(&complex) {}

    /// Ids of all tets, ascending, for a loop: `for (const mesh::TetId t : volume.tets())`. The
    /// order is the same for any number of threads and in a resumed run. [-; id] [parallel]
    LiveIds<true> tets() const { return LiveIds<true>(complex_); }
    /// Ids of all vertices, ascending, for a loop like that of tets(). [-; id] [parallel]
    LiveIds<false> vertices() const { return LiveIds<false>(complex_); }
    /// Number of tets, inside and outside. [1; -] [parallel]
    std::size_t tet_count() const { return complex_->tet_count(); }
    /// Number of vertices, inside, outside and on the interface. [1; -] [parallel]
    std::size_t vertex_count() const { return complex_->vertex_count(); }
    /// All tet ids are below this number, which is the size of a table by tet id. [1; id]
    /// [parallel]
    std::size_t tet_id_bound() const { return complex_->tet_slots(); }
    /// All vertex ids are below this number. [1; id] [parallel]
    std::size_t vertex_id_bound() const { return complex_->vertex_slots(); }

    /// The vertices of a tet; orient3d() of their positions is 1. [4; id] [parallel]
    const std::array<VertexId, 4>& vertices_of(TetId tet) const { return complex_->tet(tet).v; }
    /// Label of a tet: 0 outside, above 0 inside. [1; label] [parallel]
    Label label(TetId tet) const { return complex_->label(tet); }
    /// Volume-length quality of a tet in (0, 1]; 1 for a regular tet. [1; -] [parallel]
    double quality(TetId tet) const { return static_cast<double>(complex_->quality(tet)); }
    /// Volume of a tet, above 0. [1; n^3] [parallel]
    double volume(TetId tet) const { return complex_->volume(tet); }
    /// Mean of the positions of a tet's vertices. [3; n] [parallel]
    Vec3 centroid(TetId tet) const {
        const auto& [a, b, c, d] = vertices_of(tet);
        return 0.25 * (position(a) + position(b) + position(c) + position(d));
    }
    /// The tet across face i, 0 to 3, which is opposite vertex i; mesh::none on the box. [1; id]
    /// [parallel]
    TetId neighbour(TetId tet, unsigned face) const {
        const std::uint32_t code = complex_->across(tet, face);
        return code == none ? none : neighbour_tet(code);
    }
    /// Label of the tet across face i; 0 on the box. [1; label] [parallel]
    Label label_across(TetId tet, unsigned face) const { return complex_->label_across(tet, face); }
    /// Whether face i belongs to the interface: the labels on its two sides differ. [1; -]
    /// [parallel]
    bool interface_face(TetId tet, unsigned face) const {
        return complex_->interface_face(tet, face);
    }
    /// Whether a vertex of the tet lies on the box; such a tet cannot be relabelled. [1; -]
    /// [parallel]
    bool touches_box(TetId tet) const {
        const auto& [a, b, c, d] = vertices_of(tet);
        return complex_->on_box(a) || complex_->on_box(b) || complex_->on_box(c) ||
               complex_->on_box(d);
    }

    /// Position of a vertex. [3; n] [parallel]
    const Vec3& position(VertexId vertex) const { return complex_->position(vertex); }
    /// Birth id of a vertex; see SurfaceView::births. [1; id] [parallel]
    std::uint32_t birth(VertexId vertex) const { return complex_->birth(vertex); }
    /// Whether a vertex lies on the box. [1; -] [parallel]
    bool on_box(VertexId vertex) const { return complex_->on_box(vertex); }
    /// Whether a vertex lies on the interface, so that the surface view contains it. [1; -]
    /// [parallel]
    bool on_interface(VertexId vertex) const { return complex_->on_interface(vertex); }
    /// Writes the tets round a vertex to `out`, in an order that depends only on the complex.
    /// `places` is memory that the walk uses; each thread needs its own object. [number of these
    /// tets; id] [parallel]
    void tets_round(VertexId vertex, std::vector<TetId>& out, TetIndex& places) const {
        complex_->star(vertex, out, places);
    }

private:
    const Complex* complex_;
};

}  // namespace dsc::mesh
