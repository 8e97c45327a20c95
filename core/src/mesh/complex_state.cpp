// Saves and loads a complex.
#include <dsc/base/error.hpp>
#include <dsc/base/state.hpp>
#include <dsc/mesh/complex.hpp>

namespace dsc::mesh {

void Complex::save(StateWriter& out) const {
    LargeVector<Vertex> unmarked = vertices_;
    for (Vertex& vertex : unmarked) vertex.mark = 0;
    out.list(unmarked);
    out.list(shapes_);
    out.list(births_);
    out.list(interface_slots_);
    out.list(tets_);
    out.list(neighbours_);
    out.list(free_vertices_);
    out.list(free_tets_);
    out.list(interface_);
    out.list(lists_.changed);
    out.value(taken_clock_);
    out.value(clock_);
    out.value(next_birth_);
    out.value(box_.low);
    out.value(box_.high);
}

Complex Complex::load(StateReader& in) {
    Complex c;
    in.list(c.vertices_);
    in.list(c.shapes_);
    in.list(c.births_);
    in.list(c.interface_slots_);
    c.stars_.grow(c.vertices_.size());
    in.list(c.tets_);
    in.list(c.neighbours_);
    if (c.neighbours_.size() != c.tets_.size() || c.shapes_.size() != c.vertices_.size() ||
        c.births_.size() != c.vertices_.size() || c.interface_slots_.size() != c.vertices_.size())
        throw IoError(
            "state.damaged", "saved complex", "",
            "its lists have different lengths, so it is damaged or is not a saved complex",
            "start the run again");
    in.list(c.free_vertices_);
    in.list(c.free_tets_);
    c.free_slots_.grow(c.tets_.size());
    for (const TetId t : c.free_tets_) {
        if (t < c.tets_.size()) c.free_slots_.insert(t);
    }
    in.list(c.interface_);
    in.list(c.lists_.changed);
    in.value(c.taken_clock_);
    in.value(c.clock_);
    c.reshaped_since_ = c.shape_clock_ = c.clock_;
    in.value(c.next_birth_);
    in.value(c.box_.low);
    in.value(c.box_.high);
    return c;
}

}  // namespace dsc::mesh
